//! Common denominators of sums of products, and bounds of their numerators.

use super::polynomial::Polynomial;
use crate::number::{Coefficients, Rational, bits, lcm};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

/// A summand factor · left · right.
pub(crate) struct Product<'a> {
    pub(crate) factor: Rational,
    pub(crate) left: &'a Polynomial,
    pub(crate) right: &'a Polynomial,
}

/// The common denominator and the integer factor of each product, if machine integers suffice.
pub(super) struct SmallPlan {
    pub(super) denominator: i128,
    pub(super) factors: Vec<i128>,
}

impl SmallPlan {
    pub(super) fn new(products: &[&Product<'_>]) -> Option<Self> {
        let mut denominator = 1_i128;
        let mut parts = Vec::with_capacity(products.len());
        for product in products {
            let (
                Coefficients::Small { denominator: a, .. },
                Coefficients::Small { denominator: b, .. },
            ) = (&product.left.values, &product.right.values)
            else {
                return None;
            };
            let part = a.checked_mul(*b)?.checked_mul(product.factor.denom().to_i128()?)?;
            denominator = lcm(denominator, part)?;
            parts.push(part);
        }
        let mut factors = Vec::with_capacity(products.len());
        let mut largest = 0_u128;
        for (product, part) in products.iter().zip(parts) {
            let factor = (denominator / part).checked_mul(product.factor.numer().to_i128()?)?;
            let (Coefficients::Small { bits: a, .. }, Coefficients::Small { bits: b, .. }) =
                (&product.left.values, &product.right.values)
            else {
                return None;
            };
            let size = bits(factor) + a + b;
            if size > 126 {
                return None;
            }
            // A monomial receives at most one contribution from each term of the shorter factor.
            let contributions = product.left.len().min(product.right.len()) as u128;
            largest = largest.checked_add(contributions.checked_mul(1 << size)?)?;
            factors.push(factor);
        }
        (largest <= i128::MAX as u128).then_some(Self { denominator, factors })
    }
}

/// As [`SmallPlan`], with big integers, and the bits of the largest possible sum.
pub(super) struct LargePlan {
    pub(super) denominator: BigInt,
    pub(super) factors: Vec<BigInt>,
    pub(super) bits: u64,
}

impl LargePlan {
    pub(super) fn new(products: &[&Product<'_>]) -> Self {
        let mut denominator = BigInt::one();
        let mut parts = Vec::with_capacity(products.len());
        for product in products {
            let part = product.left.values.denominator()
                * product.right.values.denominator()
                * product.factor.denom();
            if !(&denominator % &part).is_zero() {
                denominator = denominator.lcm(&part);
            }
            parts.push(part);
        }
        let mut factors = Vec::with_capacity(products.len());
        let (mut bits, mut contributions) = (0, 0);
        for (product, part) in products.iter().zip(parts) {
            let factor = product.factor.numer() * (&denominator / part);
            let size = factor.bits() + product.left.values.bits() + product.right.values.bits();
            bits = size.max(bits);
            contributions += product.left.len().min(product.right.len()) as u64;
            factors.push(factor);
        }
        bits += u64::from(u64::BITS - contributions.leading_zeros());
        Self { denominator, factors, bits }
    }
}
