//! Bernoulli numbers, the coefficients of the inverse of d exp.

use super::{Rational, integer};
use num_traits::{One, Zero};

/// B_k / k! for k = 0..=`last`, with B_1 = -1/2.
///
/// These are the Taylor coefficients of z / (e^z - 1), so they follow from
/// (e^z - 1)/z times the series being one: Σ_{j≤k} b_j / (k - j + 1)! = 0 for k ≥ 1.
pub(crate) fn bernoulli_over_factorial(last: usize) -> Vec<Rational> {
    let mut inverse_factorial = vec![Rational::one()];
    for k in 1..=last + 1 {
        let next = &inverse_factorial[k - 1] / integer(k as i64);
        inverse_factorial.push(next);
    }
    let mut series = vec![Rational::one()];
    for k in 1..=last {
        let mut sum = Rational::zero();
        if k == 1 || k % 2 == 0 {
            for (j, b) in series.iter().enumerate() {
                sum -= b * &inverse_factorial[k - j + 1];
            }
        }
        series.push(sum);
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;

    #[test]
    fn first_values() {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, table 23.2.
        let b = bernoulli_over_factorial(8);
        let expected = [
            (1, 1),
            (-1, 2),
            (1, 12),
            (0, 1),
            (-1, 720),
            (0, 1),
            (1, 30240),
            (0, 1),
            (-1, 1209600),
        ];
        for (value, (n, d)) in b.iter().zip(expected) {
            assert_eq!(*value, ratio(n, d));
        }
    }
}
