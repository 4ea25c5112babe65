//! Exact numbers from their text.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::number::Rational;

/// The most digits a number may have, and the largest power of ten.
const LONGEST: usize = 400;

/// The exact value of an unsigned decimal: `12`, `1.5` (= 3/2), `1e-3` (= 1/1000), `1_000`.
pub(crate) fn decimal(text: &str) -> Result<Rational, Mistake> {
    let wrong = || Mistake::Number(text.to_owned());
    let large = || Mistake::NumberSize(text.to_owned());
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], &text[at + 1..]),
        None => (text, "0"),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: String = whole.chars().chain(fraction.chars()).filter(|&c| c != '_').collect();
    let power = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    if [digits.as_str(), power]
        .iter()
        .any(|d| d.is_empty() || d.contains(|c: char| !c.is_ascii_digit()))
    {
        return Err(wrong());
    }
    let most = -(LONGEST as i64)..=LONGEST as i64;
    let power = exponent.parse().ok().filter(|power| most.contains(power)).ok_or_else(large)?;
    if digits.len() > LONGEST {
        return Err(large());
    }
    let power = power - fraction.chars().filter(|&c| c != '_').count() as i64;
    let value: BigInt = digits.parse().map_err(|_| wrong())?;
    if value.is_zero() {
        return Ok(Rational::zero());
    }
    let scale = BigInt::from(10).pow(power.unsigned_abs() as u32);
    Ok(if power < 0 { Rational::new(value, scale) } else { Rational::from_integer(value * scale) })
}

/// The exact value of a decimal or a fraction with an optional sign: `-0.1`, `2/3`, `-1/2`.
pub(crate) fn fraction(text: &str) -> Result<Rational, Mistake> {
    let unsigned = text.trim();
    let (negative, unsigned) = match unsigned.strip_prefix('-') {
        Some(rest) => (true, rest.trim_start()),
        None => (false, unsigned.strip_prefix('+').unwrap_or(unsigned).trim_start()),
    };
    let (numerator, denominator) = match unsigned.split_once('/') {
        Some((numerator, denominator)) => (numerator.trim_end(), decimal(denominator.trim_start())),
        None => (unsigned, Ok(Rational::one())),
    };
    // The mistake is one of the whole text.
    let whole = |mistake| match mistake {
        Mistake::NumberSize(_) => Mistake::NumberSize(text.to_owned()),
        _ => Mistake::Number(text.to_owned()),
    };
    let (numerator, denominator) =
        (decimal(numerator).map_err(whole)?, denominator.map_err(whole)?);
    if denominator.is_zero() {
        return Err(Mistake::Number(text.to_owned()));
    }
    let value = numerator / denominator;
    Ok(if negative { -value } else { value })
}

/// Rows of a matrix, all of one length; `None` where one of them is not, or is wrong.
pub(crate) fn rows(
    rows: impl Iterator<Item = Option<(Vec<Rational>, Span)>>,
    diagnostics: &Diagnostics,
) -> Option<Vec<Vec<Rational>>> {
    let mut result: Vec<Vec<Rational>> = Vec::new();
    for row in rows {
        let (row, place) = row?;
        let width = result.first().map_or(row.len(), Vec::len);
        if row.len() != width {
            let message = format!("this row has {} entries, the first one {width}", row.len());
            diagnostics.report_other(place, message, "give every row as many entries");
            return None;
        }
        result.push(row);
    }
    Some(result)
}

/// The exact value of a text such as `-0.1`, `2/3` or `1e-3`; `None` where it is no number.
#[must_use]
pub fn rational(text: &str) -> Option<Rational> {
    fraction(text).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;

    #[test]
    fn numbers_are_exact() {
        for (text, expected) in [
            ("1.5", ratio(3, 2)),
            ("1e-3", ratio(1, 1000)),
            ("0.1", ratio(1, 10)),
            (".5", ratio(1, 2)),
            ("2.", ratio(2, 1)),
            ("1_000.25E1", ratio(20005, 2)),
            ("0e400", ratio(0, 1)),
        ] {
            assert_eq!(decimal(text), Ok(expected));
        }
        for (text, expected) in
            [("2/3", ratio(2, 3)), (" - 1 / 2 ", ratio(-1, 2)), ("+1.5/3", ratio(1, 2))]
        {
            assert_eq!(fraction(text), Ok(expected));
        }
    }

    #[test]
    fn nonsense_and_giants_are_refused() {
        for text in ["", ".", "e5", "1e", "1.2.3", "0x10", "nan", "inf", "--1", "1e+-2"] {
            assert_eq!(decimal(text), Err(Mistake::Number(text.to_owned())));
        }
        assert_eq!(fraction("1/0"), Err(Mistake::Number("1/0".to_owned())));
        for text in ["1e999999999999", &"9".repeat(1000)] {
            assert_eq!(decimal(text), Err(Mistake::NumberSize(text.to_owned())));
        }
    }
}
