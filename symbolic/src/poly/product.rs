//! Sums of products, the operation everything else is made of.

use super::accumulate::accumulate;
use super::monomial::{Factors, Key};
use super::plan::{LargePlan, Product, SmallPlan};
use super::polynomial::{Keys, Polynomial};
use crate::number::{Coefficients, Sum, Words};
use num_bigint::BigInt;
use num_traits::Zero;

/// Why a sum was not computed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SumError {
    /// The sum has more terms than the limit allows; this many were counted.
    Terms(usize),
    /// A degree does not fit into 32 bits.
    Degree,
}

/// The sum of products, if it has no more than `limit` terms.
///
/// All products are collected in one table over one common denominator. With machine integers
/// the largest possible sum is bounded beforehand; big integers are used where it might not fit.
pub(crate) fn sum_of_products(
    variables: usize,
    products: &[Product<'_>],
    limit: usize,
) -> Result<Polynomial, SumError> {
    let used: Vec<&Product<'_>> = products
        .iter()
        .filter(|p| !p.left.is_zero() && !p.right.is_zero() && !p.factor.is_zero())
        .collect();
    let mut bound = 0;
    for product in &used {
        let degree = product.left.bound.checked_add(product.right.bound);
        bound = degree.ok_or(SumError::Degree)?.max(bound);
    }
    let packed = Polynomial::packing(variables, bound).is_some();
    let mut keys = Vec::with_capacity(used.len());
    for product in &used {
        keys.push((product.left.keys_for(packed), product.right.keys_for(packed)));
    }
    let small = SmallPlan::new(&used);
    if packed {
        let lists: Vec<(&[u128], &[u128])> =
            keys.iter().map(|(a, b)| (a.packed(), b.packed())).collect();
        let (keys, values) = run(&used, small, &lists, limit).map_err(SumError::Terms)?;
        Ok(Polynomial::assemble(variables, bound, Keys::Packed(keys), values))
    } else {
        let lists: Vec<(&[Factors], &[Factors])> =
            keys.iter().map(|(a, b)| (a.sparse(), b.sparse())).collect();
        let (keys, values) = run(&used, small, &lists, limit).map_err(SumError::Terms)?;
        Ok(Polynomial::assemble(variables, bound, Keys::Sparse(keys), values))
    }
}

fn run<K: Key>(
    products: &[&Product<'_>],
    small: Option<SmallPlan>,
    keys: &[(&[K], &[K])],
    limit: usize,
) -> Result<(Vec<K>, Coefficients), usize> {
    if let Some(plan) = small {
        let lists: Vec<(i128, &[i128], &[i128])> = products
            .iter()
            .zip(&plan.factors)
            .filter_map(|(p, factor)| match (&p.left.values, &p.right.values) {
                (
                    Coefficients::Small { numerators: a, .. },
                    Coefficients::Small { numerators: b, .. },
                ) => Some((*factor, a.as_slice(), b.as_slice())),
                _ => None,
            })
            .collect();
        let (keys, values) = accumulate::<K, i128>(keys, &lists, limit)?;
        return Ok((keys, Coefficients::small(values, plan.denominator)));
    }
    let plan = LargePlan::new(products);
    let (keys, values) = match plan.bits {
        0..=255 => wide::<K, 4>(products, &plan, keys, limit)?,
        256..=383 => wide::<K, 6>(products, &plan, keys, limit)?,
        384..=511 => wide::<K, 8>(products, &plan, keys, limit)?,
        512..=1023 => wide::<K, 16>(products, &plan, keys, limit)?,
        _ => {
            let operands: Vec<(Vec<BigInt>, Vec<BigInt>)> = products
                .iter()
                .map(|p| (p.left.values.numerators(), p.right.values.numerators()))
                .collect();
            let lists: Vec<(BigInt, &[BigInt], &[BigInt])> = operands
                .iter()
                .zip(&plan.factors)
                .map(|((a, b), factor)| (factor.clone(), a.as_slice(), b.as_slice()))
                .collect();
            accumulate::<K, BigInt>(keys, &lists, limit)?
        }
    };
    Ok((keys, Coefficients::big(values, plan.denominator)))
}

/// The sum in integers of N words, which the plan says suffice.
fn wide<K: Key, const N: usize>(
    products: &[&Product<'_>],
    plan: &LargePlan,
    keys: &[(&[K], &[K])],
    limit: usize,
) -> Result<(Vec<K>, Vec<BigInt>), usize> {
    let words = |values: &Coefficients| -> Vec<Words<N>> {
        match values {
            Coefficients::Small { numerators, .. } => {
                numerators.iter().map(|&n| Words::from_small(n)).collect()
            }
            Coefficients::Big { numerators, .. } => numerators.iter().map(Words::new).collect(),
        }
    };
    let operands: Vec<(Vec<Words<N>>, Vec<Words<N>>)> =
        products.iter().map(|p| (words(&p.left.values), words(&p.right.values))).collect();
    let lists: Vec<(Words<N>, &[Words<N>], &[Words<N>])> = operands
        .iter()
        .zip(&plan.factors)
        .map(|((a, b), factor)| (Words::new(factor), a.as_slice(), b.as_slice()))
        .collect();
    let (keys, sums) = accumulate::<K, Words<N>>(keys, &lists, limit)?;
    Ok((keys, sums.into_iter().map(Sum::to_integer).collect()))
}
