//! Coefficients of any size: a number of doubled precision times a power of two.

use num_bigint::{BigInt, Sign};
use num_traits::{Signed, ToPrimitive};

use super::DoubleDouble;
use crate::number::Rational;

/// m·2^e with ½ ≤ |m| < 1, or 0: coefficients of S, h^k and powers of a momentum's size leave the range of
/// doubles long before their product does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wide {
    mantissa: DoubleDouble,
    exponent: i64,
}

impl Wide {
    /// A double, exactly; not finite ones stay so.
    pub(super) fn of(value: f64) -> Self {
        Self { mantissa: value.into(), exponent: 0 }.normal()
    }

    /// A rational, to 106 bits.
    pub(super) fn rational(value: &Rational) -> Self {
        let (numerator, denominator) = (value.numer().abs(), value.denom());
        let shift = 120 + denominator.bits() as i64 - numerator.bits() as i64;
        let quotient = if shift >= 0 {
            (numerator << shift as u64) / denominator
        } else {
            numerator / (denominator << shift.unsigned_abs())
        };
        let hi = quotient.to_f64().unwrap_or(f64::NAN);
        let rest = quotient - BigInt::from(hi as u128);
        let magnitude = DoubleDouble::new(hi, rest.to_f64().unwrap_or(f64::NAN));
        let negative = value.numer().sign() == Sign::Minus;
        let mantissa = if negative { -magnitude } else { magnitude };
        Self { mantissa, exponent: -shift }.normal()
    }

    fn normal(self) -> Self {
        let size = self.mantissa.to_f64();
        if size == 0.0 || !size.is_finite() {
            return self;
        }
        let by = exponent_of(size);
        Self { mantissa: self.mantissa.scaled(-by), exponent: self.exponent + by }
    }

    pub(super) fn times(self, other: Self) -> Self {
        let mantissa = self.mantissa * other.mantissa;
        Self { mantissa, exponent: self.exponent + other.exponent }.normal()
    }

    pub(super) fn power(self, exponent: u32) -> Self {
        (0..exponent).fold(Self::of(1.0), |product, _| product.times(self))
    }

    /// The product with 2^exponent as a number of doubled precision: 0 or infinite where out of range.
    pub(super) fn scaled(self, exponent: i64) -> DoubleDouble {
        self.mantissa.scaled(self.exponent.saturating_add(exponent))
    }
}

/// e with 2^(e−1) ≤ |value| < 2^e, for finite values other than 0.
pub(super) fn exponent_of(value: f64) -> i64 {
    let bits = |value: f64| ((value.to_bits() >> 52) & 0x7ff) as i64;
    match bits(value) {
        0 => bits(value * 2_f64.powi(200)) - 200 - 1022,
        biased => biased - 1022,
    }
}
