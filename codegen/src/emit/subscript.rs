//! Numbers in raised and lowered digits.

/// A number in subscript digits.
#[must_use]
pub(crate) fn subscript(number: usize) -> String {
    let digit = |c: char| c.to_digit(10).and_then(|d| char::from_u32(0x2080 + d)).unwrap_or(c);
    number.to_string().chars().map(digit).collect()
}

/// A number in superscript digits.
#[must_use]
pub(crate) fn superscript(number: usize) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or(c, |d| DIGITS[d as usize]);
    number.to_string().chars().map(digit).collect()
}
