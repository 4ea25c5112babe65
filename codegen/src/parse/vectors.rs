//! Products of vectors in text: `dot(a, b)` and `dot(d, cross(a, b))`, of sites `a.x` … and of lists `d[0]` ….

use super::names::{Names, is_word};

/// The three components of a vector: a name, or `cross` of two vectors.
fn components(text: &str, names: &Names) -> Option<[String; 3]> {
    let text = text.trim();
    if let Some(inside) = text.strip_prefix("cross(").and_then(|text| text.strip_suffix(')')) {
        let [a, b] = pair(inside)?;
        let [a, b] = [components(a, names)?, components(b, names)?];
        let entry = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            format!("({}*{} - {}*{})", a[j], b[k], a[k], b[j])
        };
        return Some([0, 1, 2].map(entry));
    }
    if !is_word(text) {
        return None;
    }
    let list = [0, 1, 2].map(|i| format!("{text}[{i}]"));
    let known = list.iter().all(|name| names.get(name).is_some());
    (known && names.entries(text) == Some(3)).then_some(list)
}

/// Two arguments at the comma outside of parentheses.
fn pair(text: &str) -> Option<[&str; 2]> {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.checked_sub(1)?,
            ',' if depth == 0 => return Some([&text[..at], &text[at + 1..]]),
            _ => {}
        }
    }
    None
}

/// The sum that a product is, whose parenthesis opens at `open`, and where it ends.
///
/// # Errors
/// Where it ends, if it is no product of two vectors.
pub(super) fn dot(text: &str, open: usize, names: &Names) -> Result<(String, usize), usize> {
    let mut depth = 0_usize;
    let close = text[open..].find(|c| {
        depth = if c == '(' { depth + 1 } else { depth - usize::from(c == ')') };
        depth == 0
    });
    let close = open + close.ok_or(text.len())?;
    let inside = pair(&text[open + 1..close]);
    let both = inside.and_then(|[a, b]| Some([components(a, names)?, components(b, names)?]));
    let [a, b] = both.ok_or(close + 1)?;
    let products: Vec<String> = a.iter().zip(b).map(|(a, b)| format!("{a}*{b}")).collect();
    Ok((products.join(" + "), close + 1))
}
