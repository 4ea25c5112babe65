//! Fields for linear algebra: the rationals, and residues modulo a prime as a fast stand-in.

use super::Rational;
use num_bigint::{BigInt, BigUint};
use num_traits::{One, ToPrimitive, Zero};

/// The operations that Gaussian elimination needs.
pub(crate) trait Field: Clone {
    fn zero() -> Self;
    fn one() -> Self;
    fn is_zero(&self) -> bool;
    fn minus_product(&mut self, a: &Self, b: &Self);
    fn negated(&self) -> Self;
    fn times(&self, other: &Self) -> Self;
    /// The inverse of a nonzero element.
    fn inverse(&self) -> Self;
    /// The image of a rational; `None` where its denominator vanishes in the field.
    fn from_rational(value: &Rational) -> Option<Self>;
}

impl Field for Rational {
    fn zero() -> Self {
        Zero::zero()
    }
    fn one() -> Self {
        One::one()
    }
    fn is_zero(&self) -> bool {
        Zero::is_zero(self)
    }
    fn minus_product(&mut self, a: &Self, b: &Self) {
        *self -= a * b;
    }
    fn negated(&self) -> Self {
        -self
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn inverse(&self) -> Self {
        self.recip()
    }
    fn from_rational(value: &Rational) -> Option<Self> {
        Some(value.clone())
    }
}

/// The Mersenne prime 2^61 − 1.
const PRIME: u64 = (1 << 61) - 1;

/// An integer modulo 2^61 − 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Residue(u64);

impl Residue {
    fn reduce(value: u128) -> Self {
        let folded = (value & u128::from(PRIME)) as u64 + (value >> 61) as u64;
        // The sum of two residues and a carry is below 2 · PRIME + 2.
        let folded = (folded & PRIME) + (folded >> 61);
        Self(if folded >= PRIME { folded - PRIME } else { folded })
    }

    fn from_integer(value: &BigInt) -> Self {
        let rest = value.magnitude() % BigUint::from(PRIME);
        let residue = Self(rest.to_u64().unwrap_or(0));
        if value.sign() == num_bigint::Sign::Minus { residue.negated() } else { residue }
    }
}

impl Field for Residue {
    fn zero() -> Self {
        Self(0)
    }
    fn one() -> Self {
        Self(1)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
    fn minus_product(&mut self, a: &Self, b: &Self) {
        let negative = PRIME - self.0;
        let sum = Self::reduce(u128::from(a.0) * u128::from(b.0) + u128::from(negative));
        *self = sum.negated();
    }
    fn negated(&self) -> Self {
        Self(if self.0 == 0 { 0 } else { PRIME - self.0 })
    }
    fn times(&self, other: &Self) -> Self {
        Self::reduce(u128::from(self.0) * u128::from(other.0))
    }
    fn inverse(&self) -> Self {
        // Fermat: a^(p−2).
        let (mut result, mut power, mut exponent) = (Self(1), *self, PRIME - 2);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result.times(&power);
            }
            power = power.times(&power);
            exponent >>= 1;
        }
        result
    }
    fn from_rational(value: &Rational) -> Option<Self> {
        let denominator = Self::from_integer(value.denom());
        if denominator.is_zero() {
            return None;
        }
        Some(Self::from_integer(value.numer()).times(&denominator.inverse()))
    }
}

/// The rational with small numerator and denominator of this residue, if there is one
/// (Wang's algorithm; von zur Gathen and Gerhard, *Modern Computer Algebra*, section 5.10).
pub(crate) fn reconstruct(residue: Residue) -> Option<Rational> {
    const BOUND: i128 = 1 << 30;
    let (mut a, mut b) = (i128::from(PRIME), i128::from(residue.0));
    let (mut s, mut t) = (0_i128, 1_i128);
    while b >= BOUND {
        let quotient = a / b;
        (a, b) = (b, a - quotient * b);
        (s, t) = (t, s - quotient * t);
    }
    if t == 0 || t.abs() >= BOUND {
        return None;
    }
    Some(Rational::new(b.into(), t.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;

    #[test]
    fn residues_follow_the_rationals() {
        let values = [ratio(0, 1), ratio(1, 1), ratio(-7, 3), ratio(5, 12), ratio(-1, 1 << 29)];
        for a in &values {
            let x = Residue::from_rational(a).unwrap();
            assert_eq!(reconstruct(x).unwrap(), *a);
            assert_eq!(reconstruct(x.negated()).unwrap(), -a);
            for b in values.iter().filter(|b| b.denom() < &BigInt::from(100)) {
                let y = Residue::from_rational(b).unwrap();
                let mut z = x;
                z.minus_product(&y, &y);
                assert_eq!(z, Residue::from_rational(&(a - b * b)).unwrap());
                if !Zero::is_zero(b) {
                    assert_eq!(x.times(&y.inverse()), Residue::from_rational(&(a / b)).unwrap());
                }
            }
        }
        assert_eq!(Residue::from_rational(&Rational::new(1.into(), PRIME.into())), None);
    }
}
