//! Exact numbers: the rational scalar users see, and the integers the series are computed with.

mod bernoulli;
mod coefficients;
mod divisor;
mod field;
mod words;

pub(crate) use bernoulli::BernoulliWeights;
pub(crate) use coefficients::Coefficients;
pub(crate) use divisor::{bits, lcm};
pub(crate) use field::{Field, Residue, reconstruct};
pub(crate) use words::{Sum, Words};

/// An exact rational number, always in lowest terms with a positive denominator.
pub type Rational = num_rational::BigRational;

/// The rational `numerator / denominator`.
///
/// Meant for literals; a zero denominator gives zero rather than a panic.
#[must_use]
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    if denominator == 0 {
        return Rational::from_integer(0.into());
    }
    Rational::new(numerator.into(), denominator.into())
}

/// The nearest `f64`; NaN beyond the largest.
#[must_use]
pub fn nearest_float(value: &Rational) -> f64 {
    num_traits::ToPrimitive::to_f64(value).unwrap_or(f64::NAN)
}

/// The rational with the value of an integer.
#[must_use]
pub fn integer(value: i64) -> Rational {
    Rational::from_integer(value.into())
}
