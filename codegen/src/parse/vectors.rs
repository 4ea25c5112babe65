//! Vectors of three components in text: names of lists `d`, sites `a`, `cross(a, b)`, sums, multiples, and products `R*v` and `R'*v` with a
//! matrix, such as the attitude of a body, or its transpose; `dot(a, b)` and `norm(a)` are numbers made of them.

use super::names::{Names, is_word};

/// The scalar product of two vectors, by an operation on numbers named by its sign; `None` if they have no entries.
pub(super) fn dot<T>(a: &[T], b: &[T], of: &mut impl FnMut(char, &T, &T) -> T) -> Option<T> {
    let products: Vec<T> = a.iter().zip(b).map(|(a, b)| of('*', a, b)).collect();
    products.into_iter().reduce(|sum, product| of('+', &sum, &product))
}

/// The product a × b of vectors of three entries.
pub(super) fn cross<T>(a: &[T], b: &[T], of: &mut impl FnMut(char, &T, &T) -> T) -> [T; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(j, k)| {
        let products = [of('*', &a[j], &b[k]), of('*', &a[k], &b[j])];
        of('-', &products[0], &products[1])
    })
}

/// An operation on numbers as texts.
fn in_text(sign: char, a: &String, b: &String) -> String {
    format!("({a} {sign} {b})")
}

/// The three components of a vector, each a text.
pub(crate) fn components(text: &str, names: &Names) -> Option<[String; 3]> {
    let text = text.trim();
    let terms = split(text, &['+', '-']);
    if terms.len() > 1 || terms.first().is_some_and(|(sign, _)| *sign == Some('-')) {
        let mut sum = [const { String::new() }; 3];
        for (sign, term) in terms {
            let own = components(term, names)?;
            for (sum, own) in sum.iter_mut().zip(own) {
                sum.push(sign.unwrap_or('+'));
                sum.push_str(&format!("({own})"));
            }
        }
        // A text does not begin with a plus.
        return Some(sum.map(|sum| format!("(0 {sum})")));
    }
    let factors = split(text, &['*', '/']);
    if factors.len() > 1 {
        return product(&factors, names);
    }
    if let Some(inside) = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')) {
        return components(inside, names);
    }
    if let Some(inside) = text.strip_prefix("cross(").and_then(|text| text.strip_suffix(')')) {
        let [a, b] = pair(inside)?;
        let [a, b] = [components(a, names)?, components(b, names)?];
        return Some(cross(&a, &b, &mut in_text));
    }
    if !is_word(text) {
        return None;
    }
    let list = [0, 1, 2].map(|i| format!("{text}[{i}]"));
    let known = list.iter().all(|name| names.get(name).is_some());
    (known && names.entries(text) == Some(3)).then_some(list)
}

/// A product of numbers with one vector, and with matrices or their transposes just before it.
fn product(factors: &[(Option<char>, &str)], names: &Names) -> Option<[String; 3]> {
    let at = factors.iter().position(|(_, factor)| components(factor, names).is_some())?;
    let (sign, vector) = factors[at];
    if sign == Some('/') {
        return None;
    }
    let mut vector = components(vector, names)?;
    let is_matrix = |factor: &str| {
        let matrix = factor.trim_end_matches('\'');
        let entry = |at: &str| names.get(&format!("{matrix}{at}")).is_some();
        is_word(factor) && entry("[2][2]") && !entry("[3][0]") && !entry("[0][3]")
    };
    let matrices = factors[..at].iter().rev().take_while(|(_, factor)| is_matrix(factor)).count();
    for (_, matrix) in factors[at - matrices..at].iter().rev() {
        let entry = |i: usize, j: usize| match matrix.strip_suffix('\'') {
            Some(transposed) => format!("{transposed}[{j}][{i}]"),
            None => format!("{matrix}[{i}][{j}]"),
        };
        let row = |i: usize| dot(&[0, 1, 2].map(|j| entry(i, j)), &vector, &mut in_text);
        vector = [row(0)?, row(1)?, row(2)?];
    }
    let others = factors[..at - matrices].iter().chain(&factors[at + 1..]);
    let others: String =
        others.map(|(sign, factor)| format!("{}({factor})", sign.unwrap_or('*'))).collect();
    Some(vector.map(|entry| format!("({entry}{others})")))
}

/// The parts of a text between signs outside of parentheses and brackets, each with the sign before it.
fn split<'t>(text: &'t str, signs: &[char]) -> Vec<(Option<char>, &'t str)> {
    let (mut depth, mut from, mut sign, mut parts) = (0_i32, 0, None, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        let before = text[from..at].trim();
        // The sign of a factor, as in a*-b, is no sum, nor is that of the exponent in 1e-3.
        let word = before.rsplit(|c: char| !c.is_alphanumeric() && c != '.').next().unwrap_or("");
        let exponent = word.starts_with(|c: char| c.is_ascii_digit()) && word.ends_with(['e', 'E']);
        let unary = before.is_empty() || exponent || before.ends_with(['*', '/', '^']);
        let begins = before.is_empty() && sign.is_none() && c == '-';
        if depth == 0 && signs.contains(&c) && (!unary || begins) {
            if !before.is_empty() {
                parts.push((sign, before));
            }
            (from, sign) = (at + c.len_utf8(), Some(c));
        }
    }
    parts.push((sign, text[from..].trim()));
    parts
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

/// The number that `dot` or `norm` is, whose parenthesis opens at `open`, as a text, and where it ends.
///
/// # Errors
/// Where it ends, if it is not of vectors.
pub(super) fn number(
    name: &str,
    text: &str,
    open: usize,
    names: &Names,
) -> Result<(String, usize), usize> {
    let mut depth = 0_usize;
    let close = text[open..].find(|c| {
        depth = if c == '(' { depth + 1 } else { depth - usize::from(c == ')') };
        depth == 0
    });
    let close = open + close.ok_or(text.len())?;
    let inside = &text[open + 1..close];
    let of = if name == "norm" { Some([inside; 2]) } else { pair(inside) };
    let both = of.and_then(|[a, b]| Some([components(a, names)?, components(b, names)?]));
    let [a, b] = both.ok_or(close + 1)?;
    let sum = dot(&a, &b, &mut in_text).ok_or(close + 1)?;
    Ok((if name == "norm" { format!("sqrt({sum})") } else { sum }, close + 1))
}
