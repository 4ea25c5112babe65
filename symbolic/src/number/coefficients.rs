//! Lists of rationals over one common denominator.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Float, One, Signed, ToPrimitive, Zero};

use crate::number::Rational;

/// Rationals with one common positive denominator, in lowest terms as a whole.
///
/// Machine integers are used exactly when everything fits, so equal lists are represented equally.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Fractions {
    /// Numerators of at most `bits` ≤ 127 bits.
    Small { numerators: Vec<i128>, denominator: i128, bits: u32 },
    /// Anything else.
    Big { numerators: Vec<BigInt>, denominator: BigInt },
}

impl Fractions {
    pub(crate) fn empty() -> Self {
        Self::Small { numerators: Vec::new(), denominator: 1, bits: 0 }
    }

    /// The list with these numerators over one denominator, which must be positive, reduced to lowest terms.
    pub(crate) fn small(mut numerators: Vec<i128>, mut denominator: i128) -> Self {
        if denominator != 1 {
            let mut divisor = denominator.unsigned_abs();
            let slice = numerators.as_slice();
            let mut i = 0;
            while i < slice.len() && divisor != 1 {
                divisor = gcd(divisor, slice[i].unsigned_abs() % divisor);
                i += 1;
            }
            if divisor != 1 {
                let divisor = divisor as i128;
                denominator /= divisor;
                let slice = numerators.as_mut_slice();
                let mut i = 0;
                while i < slice.len() {
                    slice[i] /= divisor;
                    i += 1;
                }
            }
        }
        let (slice, mut most, mut i) = (numerators.as_slice(), 0, 0);
        while i < slice.len() {
            let b = bits(slice[i]);
            if b > most {
                most = b;
            }
            i += 1;
        }
        if most > 127 {
            return Self::big(
                numerators.into_iter().map(BigInt::from).collect(),
                denominator.into(),
            );
        }
        Self::Small { numerators, denominator, bits: most }
    }

    /// The list with these numerators over one positive denominator, reduced to lowest terms, and to machine
    /// integers if they suffice.
    pub(crate) fn big(mut numerators: Vec<BigInt>, mut denominator: BigInt) -> Self {
        let mut divisor = denominator.clone();
        for numerator in &numerators {
            if divisor.is_one() {
                break;
            }
            // Once the divisor is found, one division confirms it for each further value.
            let rest = numerator % &divisor;
            if !rest.is_zero() {
                divisor = divisor.gcd(&rest);
            }
        }
        if !divisor.is_one() {
            denominator /= &divisor;
            for numerator in &mut numerators {
                *numerator /= &divisor;
            }
        }
        let most = numerators.iter().map(BigInt::bits).max().unwrap_or(0);
        if most <= 127
            && let Some(denominator) = denominator.to_i128()
        {
            let numerators = numerators.iter().filter_map(BigInt::to_i128).collect();
            return Self::Small { numerators, denominator, bits: most as u32 };
        }
        Self::Big { numerators, denominator }
    }

    /// The list of these values.
    pub(crate) fn from_rationals(values: &[Rational]) -> Self {
        let mut denominator = BigInt::one();
        for value in values {
            denominator = denominator.lcm(value.denom());
        }
        let numerators = values.iter().map(|v| v.numer() * (&denominator / v.denom())).collect();
        Self::big(numerators, denominator)
    }

    pub(crate) fn get(&self, index: usize) -> Rational {
        match self {
            Self::Small { numerators, denominator, .. } => {
                let divisor = gcd(numerators[index].unsigned_abs(), denominator.unsigned_abs());
                // Both are below 2^127, and so is the divisor of the positive denominator.
                let divisor = divisor as i128;
                Rational::new_raw(
                    (numerators[index] / divisor).into(),
                    (denominator / divisor).into(),
                )
            }
            Self::Big { numerators, denominator } => {
                Rational::new(numerators[index].clone(), denominator.clone())
            }
        }
    }

    /// The value at `index` in floating point, to within a unit in the last place.
    pub(crate) fn to_f64(&self, index: usize) -> f64 {
        const EXACT: u128 = 1 << f64::MANTISSA_DIGITS;
        if let Self::Small { numerators, denominator, .. } = self
            && numerators[index].unsigned_abs() <= EXACT
            && denominator.unsigned_abs() <= EXACT
        {
            return numerators[index] as f64 / *denominator as f64;
        }
        self.get(index).to_f64().unwrap_or(f64::NAN)
    }

    /// All values in floating point, to within a few units in the last place; none where one is out of its range.
    pub(crate) fn to_f64s(&self) -> Option<Vec<f64>> {
        let values: Vec<f64> = match self {
            Self::Small { numerators, denominator, .. } => {
                numerators.iter().map(|value| *value as f64 / *denominator as f64).collect()
            }
            Self::Big { numerators, denominator } => {
                let denominator = denominator.to_f64()?;
                numerators.iter().filter_map(|value| Some(value.to_f64()? / denominator)).collect()
            }
        };
        values.iter().all(|value| value.is_normal()).then_some(values)
    }

    /// The list of these values; none where one is not normal.
    pub(crate) fn of_f64s(values: &[f64]) -> Option<Self> {
        if values.iter().any(|value| !value.is_normal()) {
            return None;
        }
        let decoded: Vec<(u64, i16, i8)> =
            values.iter().map(|value| value.integer_decode()).collect();
        let lowest = |&(mantissa, exponent, _): &(u64, i16, i8)| {
            i32::from(exponent) + mantissa.trailing_zeros() as i32
        };
        let shift = -decoded.iter().map(lowest).min().unwrap_or(0).min(0);
        let numerator = |(mantissa, exponent, sign): (u64, i16, i8)| {
            let by = i32::from(exponent) + shift;
            let whole = BigInt::from(mantissa) * sign;
            if by < 0 { whole >> -by } else { whole << by }
        };
        let numerators = decoded.into_iter().map(numerator).collect();
        Some(Self::big(numerators, BigInt::one() << shift))
    }

    /// The numerators and the common denominator as big integers.
    pub(crate) fn widen(&self) -> (Vec<BigInt>, BigInt) {
        match self {
            Self::Small { numerators, denominator, .. } => {
                (numerators.iter().copied().map(BigInt::from).collect(), (*denominator).into())
            }
            Self::Big { numerators, denominator } => (numerators.clone(), denominator.clone()),
        }
    }

    pub(crate) fn numerators(&self) -> Vec<BigInt> {
        self.widen().0
    }

    pub(crate) fn denominator(&self) -> BigInt {
        match self {
            Self::Small { denominator, .. } => (*denominator).into(),
            Self::Big { denominator, .. } => denominator.clone(),
        }
    }

    /// The number of bits of the largest numerator.
    pub(crate) fn bits(&self) -> u64 {
        match self {
            Self::Small { bits, .. } => u64::from(*bits),
            Self::Big { numerators, .. } => numerators.iter().map(BigInt::bits).max().unwrap_or(0),
        }
    }

    /// The list with every value multiplied by one rational and, where `each` is given, by its own integer.
    pub(crate) fn scale(&self, factor: &Rational, each: Option<&[u32]>) -> Self {
        if let (Self::Small { numerators, denominator, bits: most }, Some(n), Some(d)) =
            (self, factor.numer().to_i128(), factor.denom().to_i128())
        {
            let largest = each.map_or(1, |e| e.iter().copied().max().unwrap_or(1));
            if most + bits(n) + bits(i128::from(largest)) <= 126
                && bits(*denominator) + bits(d) <= 126
            {
                let mut result = Vec::with_capacity(numerators.len());
                let source = numerators.as_slice();
                let mut i = 0;
                while i < source.len() {
                    let by = each.map_or(1, |e| i128::from(e[i]));
                    result.push(source[i].wrapping_mul(n).wrapping_mul(by));
                    i += 1;
                }
                return Self::small(result, denominator.wrapping_mul(d));
            }
        }
        let (mut numerators, denominator) = self.widen();
        for (i, numerator) in numerators.iter_mut().enumerate() {
            *numerator *= factor.numer();
            if let Some(each) = each {
                *numerator *= each[i];
            }
        }
        Self::big(numerators, denominator * factor.denom())
    }

    /// The greatest common divisor of the numerators over the denominator, with the sign of the
    /// first value; one for an empty list.
    pub(crate) fn content(&self) -> Rational {
        let (numerators, denominator) = self.widen();
        let mut divisor = BigInt::zero();
        for numerator in &numerators {
            divisor = divisor.gcd(numerator);
        }
        match numerators.first() {
            None => Rational::one(),
            Some(first) if first.is_negative() => Rational::new(-divisor, denominator),
            Some(_) => Rational::new(divisor, denominator),
        }
    }
}

/// The greatest common divisor; zero only if both are zero.
pub(crate) fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        // Division of 128-bit integers is slow, so the loop moves to 64 bits once both fit.
        if a <= u64::MAX as u128 && b <= u64::MAX as u128 {
            return gcd_word(a as u64, b as u64) as u128;
        }
        let rest = a % b;
        a = b;
        b = rest;
    }
    a
}

fn gcd_word(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        let rest = a % b;
        a = b;
        b = rest;
    }
    a
}

/// The least common multiple of two positive integers, if it is below 2^127.
pub(crate) fn lcm(a: i128, b: i128) -> Option<i128> {
    if a % b == 0 {
        return Some(a);
    }
    if b % a == 0 {
        return Some(b);
    }
    let divisor = gcd(a.unsigned_abs(), b.unsigned_abs());
    a.checked_mul(b / i128::try_from(divisor).ok()?)
}

/// The number of bits of the absolute value.
#[inline(always)]
pub(crate) fn bits(value: i128) -> u32 {
    128 - value.unsigned_abs().leading_zeros()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large() {
        assert_eq!(gcd(12, 18), 6);
        assert_eq!(gcd(0, 5), 5);
        assert_eq!(gcd(3 << 100, 5 << 90), 1 << 90);
        assert_eq!(lcm(4, 6), Some(12));
        assert_eq!(lcm((1 << 126) - 1, 1 << 126), None);
        assert_eq!(bits(-8), 4);
        assert_eq!(bits(0), 0);
        assert_eq!(bits(i128::MIN), 128);
    }
}
