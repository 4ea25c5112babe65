//! Residues modulo a prime of half a machine word: products of three of them and their sums fit 128 bits.

use super::Rational;
use num_bigint::BigInt;
use num_traits::ToPrimitive;

/// The Mersenne prime 2^31 − 1.
pub(crate) const PRIME: i128 = (1 << 31) - 1;

/// The residue of a rational, from 0; 1 where the prime divides the denominator, which has no inverse then.
pub(crate) fn residue(value: &Rational) -> i128 {
    let of = |integer: &BigInt| (integer % PRIME).to_i128().unwrap_or(0).rem_euclid(PRIME);
    let denominator = of(value.denom());
    if denominator == 0 {
        return 1;
    }
    // Fermat: a^(p−2).
    let (mut result, mut power, mut exponent) = (of(value.numer()), denominator, PRIME - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * power % PRIME;
        }
        power = power * power % PRIME;
        exponent >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;

    #[test]
    fn residues_follow_the_rationals() {
        let values = [ratio(0, 1), ratio(-7, 3), ratio(5, 12), ratio(i64::MAX, 1 << 50)];
        for a in &values {
            for b in &values {
                assert_eq!(residue(&(a * b)), residue(a) * residue(b) % PRIME);
                assert_eq!(residue(&(a + b)), (residue(a) + residue(b)) % PRIME);
            }
        }
        assert_eq!(residue(&Rational::new(1.into(), PRIME.into())), 1);
    }
}
