//! Exact numbers: the rational scalar users see, and the integers the series are computed with.

mod coefficients;

pub(crate) use coefficients::{Fractions, bits, lcm};

/// An exact rational number, always in lowest terms with a positive denominator.
pub type Rational = num_rational::BigRational;

/// The rational `numerator / denominator`.
///
/// Meant for literals; a zero denominator gives zero rather than a panic.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    if denominator == 0 {
        return Rational::from_integer(0.into());
    }
    Rational::new(numerator.into(), denominator.into())
}

/// The nearest `f64`; NaN beyond the largest.
pub fn nearest_float(value: &Rational) -> f64 {
    num_traits::ToPrimitive::to_f64(value).unwrap_or(f64::NAN)
}

/// The rational with the value of an integer.
pub fn integer(value: i64) -> Rational {
    Rational::from_integer(value.into())
}

/// The numbers (−1)^k B_k / k!, computed as they are asked for: 1, 1/2, 1/12, 0, −1/720, ….
///
/// With B_1 = −1/2 the B_k / k! are the Taylor coefficients b_k of z / (e^z − 1), so they follow
/// from (e^z − 1)/z times that series being one: Σ_{j≤k} b_j / (k − j + 1)! = 0 for k ≥ 1. The
/// sign changes only b_1, all other odd ones being zero.
#[derive(Clone, Debug, Default)]
pub(crate) struct BernoulliWeights {
    series: Vec<Rational>,
    inverse_factorial: Vec<Rational>,
}

impl BernoulliWeights {
    /// (−1)^k B_k / k! for k = `index`.
    pub(crate) fn get(&mut self, index: usize) -> Rational {
        while self.inverse_factorial.len() < index + 2 {
            let next = match self.inverse_factorial.last() {
                None => integer(1),
                Some(last) => last / integer(self.inverse_factorial.len() as i64),
            };
            self.inverse_factorial.push(next);
        }
        while self.series.len() <= index {
            let k = self.series.len();
            let mut sum = if k == 0 { integer(1) } else { integer(0) };
            if k == 1 || k.is_multiple_of(2) {
                for (j, b) in self.series.iter().enumerate() {
                    sum -= b * &self.inverse_factorial[k - j + 1];
                }
            }
            self.series.push(sum);
        }
        if index == 1 { -&self.series[1] } else { self.series[index].clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;

    #[test]
    fn first_values() {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, table 23.2.
        let mut weights = BernoulliWeights::default();
        let expected =
            [(1, 1), (1, 2), (1, 12), (0, 1), (-1, 720), (0, 1), (1, 30240), (0, 1), (-1, 1209600)];
        for (k, (n, d)) in expected.into_iter().enumerate().rev() {
            assert_eq!(weights.get(k), ratio(n, d));
        }
    }
}
