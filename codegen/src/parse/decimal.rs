//! Exact numbers from their text.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::number::Rational;

/// The most digits a number may have, and the largest power of ten.
const LONGEST: usize = 400;

/// Why a text is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberError {
    /// It does not look like one.
    Form,
    /// More digits, or a larger power of ten, than anybody means.
    Size,
}

/// The exact value of an unsigned decimal: `12`, `1.5` (= 3/2), `1e-3` (= 1/1000), `1_000`.
///
/// # Errors
/// If the text is no decimal, or too long.
pub fn decimal(text: &str) -> Result<Rational, NumberError> {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], Some(&text[at + 1..])),
        None => (text, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: String = whole.chars().chain(fraction.chars()).filter(|&c| c != '_').collect();
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(NumberError::Form);
    }
    let mut power = match exponent {
        None => 0,
        Some(exponent) => power_of_ten(exponent)?,
    };
    if digits.len() > LONGEST {
        return Err(NumberError::Size);
    }
    power -= fraction.chars().filter(|&c| c != '_').count() as i64;
    let value: BigInt = digits.parse().map_err(|_| NumberError::Form)?;
    if value.is_zero() {
        return Ok(Rational::zero());
    }
    let scale = BigInt::from(10).pow(power.unsigned_abs().min(2 * LONGEST as u64) as u32);
    Ok(if power < 0 { Rational::new(value, scale) } else { Rational::from_integer(value * scale) })
}

fn power_of_ten(text: &str) -> Result<i64, NumberError> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(NumberError::Form);
    }
    match text.parse::<i64>() {
        Ok(power) if power.unsigned_abs() <= LONGEST as u64 => Ok(power),
        _ => Err(NumberError::Size),
    }
}

/// The exact value of a decimal or a fraction with an optional sign: `-0.1`, `2/3`, `-1/2`.
///
/// # Errors
/// If the text is neither, or too long, or the denominator is zero.
pub fn rational(text: &str) -> Result<Rational, NumberError> {
    let text = text.trim();
    let (negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest.trim_start()),
        None => (false, text.strip_prefix('+').unwrap_or(text).trim_start()),
    };
    let (numerator, denominator) = match text.split_once('/') {
        Some((numerator, denominator)) => {
            (decimal(numerator.trim_end())?, decimal(denominator.trim_start())?)
        }
        None => (decimal(text)?, Rational::one()),
    };
    if denominator.is_zero() {
        return Err(NumberError::Form);
    }
    let value = numerator / denominator;
    Ok(if negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;

    #[test]
    fn decimals_are_exact() {
        assert_eq!(decimal("1.5"), Ok(ratio(3, 2)));
        assert_eq!(decimal("1e-3"), Ok(ratio(1, 1000)));
        assert_eq!(decimal("0.1"), Ok(ratio(1, 10)));
        assert_eq!(decimal(".5"), Ok(ratio(1, 2)));
        assert_eq!(decimal("2."), Ok(ratio(2, 1)));
        assert_eq!(decimal("1_000.25E1"), Ok(ratio(20005, 2)));
        assert_eq!(decimal("0e400"), Ok(ratio(0, 1)));
    }

    #[test]
    fn fractions_have_signs() {
        assert_eq!(rational("2/3"), Ok(ratio(2, 3)));
        assert_eq!(rational(" - 1 / 2 "), Ok(ratio(-1, 2)));
        assert_eq!(rational("+1.5/3"), Ok(ratio(1, 2)));
        assert_eq!(rational("1/0"), Err(NumberError::Form));
    }

    #[test]
    fn nonsense_and_giants_are_refused() {
        for text in ["", ".", "e5", "1e", "1.2.3", "0x10", "nan", "inf", "--1", "1e+-2"] {
            assert_eq!(decimal(text), Err(NumberError::Form), "{text}");
        }
        assert_eq!(decimal("1e999999999999"), Err(NumberError::Size));
        assert_eq!(decimal(&"9".repeat(1000)), Err(NumberError::Size));
    }
}
