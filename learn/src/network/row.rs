//! Rows of numbers as vectors.
//!
//! Long rows are cut into blocks which threads share. The cuts and the order of additions are part of
//! the result, so they are fixed: the bits do not depend on how many threads there are.

use multiversion::multiversion;
use rayon::prelude::*;

/// Entries of a block: enough work to be worth handing to a thread.
const BLOCK: usize = 1 << 13;

/// Sums kept side by side in a block's product, so that additions need not wait for each other.
const SUMS: usize = 8;

/// a·b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    if a.len() <= BLOCK {
        return dot_of_block(a, b);
    }
    let blocks = a.par_chunks(BLOCK).zip(b.par_chunks(BLOCK));
    in_order(blocks.map(|(a, b)| dot_of_block(a, b)))
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2"))]
fn dot_of_block(a: &[f64], b: &[f64]) -> f64 {
    products(a, b)
}

fn in_order(sums: impl IndexedParallelIterator<Item = f64>) -> f64 {
    sums.collect::<Vec<f64>>().iter().sum()
}

#[inline(always)]
fn products(a: &[f64], b: &[f64]) -> f64 {
    let (a, a_rest) = a.as_chunks::<SUMS>();
    let (b, b_rest) = b.as_chunks::<SUMS>();
    let mut sums = [0.0; SUMS];
    for (a, b) in a.iter().zip(b) {
        for i in 0..SUMS {
            sums[i] += a[i] * b[i];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// |a|.
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// target ← scale·target + factor·other; returns target·with. One walk through memory, which is
/// what costs.
pub(super) fn add_and_dot(
    target: &mut [f64],
    scale: f64,
    factor: f64,
    other: &[f64],
    with: &[f64],
) -> f64 {
    let blocks = target.par_chunks_mut(BLOCK).zip(other.par_chunks(BLOCK));
    in_order(
        blocks.zip(with.par_chunks(BLOCK)).map(|((target, other), with)| {
            add_and_dot_of_block(target, scale, factor, other, with)
        }),
    )
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2"))]
fn add_and_dot_of_block(
    target: &mut [f64],
    scale: f64,
    factor: f64,
    other: &[f64],
    with: &[f64],
) -> f64 {
    target.iter_mut().zip(other).for_each(|(t, o)| *t = scale * *t + factor * o);
    products(target, with)
}

/// f of the entries of N rows of one length.
pub(super) fn map<const N: usize>(
    rows: [&[f64]; N],
    f: impl Fn([f64; N]) -> f64 + Sync,
) -> Vec<f64> {
    let mut result = vec![0.0; rows.first().map_or(0, |row| row.len())];
    result.par_chunks_mut(BLOCK).enumerate().for_each(|(number, result)| {
        let rows = rows.map(|row| &row[number * BLOCK..][..result.len()]);
        for (i, entry) in result.iter_mut().enumerate() {
            *entry = f(rows.map(|row| row[i]));
        }
    });
    result
}

/// factor·Σ rows, added in their order.
pub(super) fn sum(rows: &[&[f64]], factor: f64, len: usize) -> Vec<f64> {
    let mut sum = vec![0.0; len];
    sum.par_chunks_mut(BLOCK).enumerate().for_each(|(number, sum)| {
        let from = number * BLOCK;
        for row in rows {
            sum.iter_mut().zip(&row[from..]).for_each(|(s, entry)| *s += entry);
        }
        sum.iter_mut().for_each(|s| *s *= factor);
    });
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_counts_once() {
        for count in [0, 1, 7, 8, 9, 33, 8_192, 8_193, 40_000] {
            let a: Vec<f64> = (1..=count).map(f64::from).collect();
            let n = f64::from(count);
            // Whole numbers below 2⁵³, so exact in any order.
            assert_eq!(dot(&a, &a), n * (n + 1.0) * (2.0 * n + 1.0) / 6.0);
            let mut target = a.clone();
            assert_eq!(add_and_dot(&mut target, 2.0, 1.0, &a, &a), 3.0 * dot(&a, &a));
            assert!(target.iter().zip(&a).all(|(t, a)| *t == 3.0 * a));
            let double = map([&a, &target], |[a, t]| t - a);
            assert!(double.iter().zip(&a).all(|(d, a)| *d == 2.0 * a));
            assert_eq!(sum(&[&a, &target], 0.5, a.len()), double);
        }
    }
}
