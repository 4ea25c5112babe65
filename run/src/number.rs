//! Numbers as text and their maxima.

/// From here on decimals have an exponent.
const LARGE: f64 = 1e16;
/// Below this decimals have an exponent where that is shorter.
const SMALL: f64 = 1e-3;

/// The shortest decimal that reads back as the same number, with an exponent where that is shorter:
/// `0.1`, `100`, `5e-17`, `-1.25e-51`.
pub fn shortest(value: f64) -> String {
    let plain = value.to_string();
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (SMALL..LARGE).contains(&size) {
        return plain;
    }
    let scientific = format!("{value:e}");
    if scientific.len() < plain.len() { scientific } else { plain }
}

/// Five digits of a number.
pub(crate) fn brief(value: f64) -> String {
    shortest(format!("{value:.4e}").parse().unwrap_or(value))
}

/// The larger of two numbers; NaN where one of them is, unlike `f64::max`.
pub(crate) fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_short_and_exact() {
        for (value, text) in [
            (0.1, "0.1"),
            (100.0, "100"),
            (-0.0, "-0"),
            (5.551115123125783e-17, "5.551115123125783e-17"),
            (-1e-51, "-1e-51"),
            (1e300, "1e300"),
            (0.30000000000000004, "0.30000000000000004"),
        ] {
            assert_eq!(shortest(value), text);
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
    }

    #[test]
    fn maxima_keep_nan() {
        assert!(maximum(f64::NAN, 1.0).is_nan() && maximum(1.0, f64::NAN).is_nan());
        assert_eq!(maximum(1.0, 3.0), 3.0);
    }
}
