//! How text and numbers are set on the page.

use coadjoint_draw::escaped;

/// What is written in ASCII in tables and files, and how it is set on the page.
const SET: [(&str, &str); 8] = [
    ("J_L", "J<sub>L</sub>"),
    ("mu''", "μ″"),
    ("mu'", "μ′"),
    ("g'^-1", "g′⁻¹"),
    ("alpha''", "α″"),
    ("g''", "g″"),
    ("^3", "³"),
    ("dt ", "Δt "),
];

/// Text of a page in which numbers such as 1e-8 are written out.
pub fn prose(text: &str) -> String {
    let mut text = escaped(text);
    for (plain, set) in SET {
        text = text.replace(plain, set);
    }
    let mut out = String::with_capacity(text.len());
    for (i, word) in text.split(' ').enumerate() {
        if i > 0 {
            out.push(' ');
        }
        let start = word.find(|c: char| c.is_ascii_digit()).unwrap_or(0);
        let end = word.rfind(|c: char| c.is_ascii_digit()).map_or(0, |at| at + 1);
        if start < end {
            out.push_str(&word[..start]);
            out.push_str(&number(&word[start..end]));
            out.push_str(&word[end..]);
        } else {
            out.push_str(word);
        }
    }
    out
}

/// A number such as 1.2e-8 with its power of ten written out; anything else as it is.
pub fn number(text: &str) -> String {
    let Some((digits, exponent)) = text.split_once('e') else { return minus(text) };
    let plain = |part: &str| {
        let part = part.strip_prefix('-').unwrap_or(part);
        !part.is_empty() && part.chars().all(|c| c.is_ascii_digit() || c == '.')
    };
    if !plain(digits) || !plain(exponent) {
        return text.to_owned();
    }
    let exponent = minus(exponent);
    match digits {
        "1" => format!("10<sup>{exponent}</sup>"),
        digits => format!("{}·10<sup>{exponent}</sup>", minus(digits)),
    }
}

fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => format!("−{rest}"),
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::{number, prose};

    #[test]
    fn powers_of_ten_are_written_out() {
        assert_eq!(number("1.20e-8"), "1.20·10<sup>−8</sup>");
        assert_eq!(number("1e-12"), "10<sup>−12</sup>");
        assert_eq!(number("-0.5"), "−0.5");
        assert_eq!(prose("at most 1e-12, so"), "at most 10<sup>−12</sup>, so");
        assert_eq!(prose("type II < x"), "type II &lt; x");
        assert_eq!(prose("degree_2e"), "degree_2e");
    }
}
