//! The loop that collects products of terms, for every kind of integer.

use super::monomial::Key;
use super::table::Table;
use crate::cancel;
use crate::number::{Sum, Words};
use num_bigint::BigInt;
use num_traits::Zero;

/// The arithmetic of one kind of integer.
pub(super) trait Number: Sized {
    type Sum;
    fn times(&self, other: &Self) -> Self;
    fn add_product(sum: &mut Self::Sum, left: &Self, right: &Self);
    fn vanishes(sum: &Self::Sum) -> bool;
    fn nothing() -> Self::Sum;
}

impl Number for i128 {
    type Sum = Self;
    // The plan bounds every sum, so wrapping operations never wrap.
    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        self.wrapping_mul(*other)
    }
    #[inline(always)]
    fn add_product(sum: &mut Self, left: &Self, right: &Self) {
        *sum = sum.wrapping_add(left.wrapping_mul(*right));
    }
    #[inline(always)]
    fn vanishes(sum: &Self) -> bool {
        *sum == 0
    }
    #[inline(always)]
    fn nothing() -> Self {
        0
    }
}

impl<const N: usize> Number for Words<N> {
    type Sum = Sum<N>;
    fn times(&self, other: &Self) -> Self {
        self.times(other)
    }
    #[inline(always)]
    fn add_product(sum: &mut Sum<N>, left: &Self, right: &Self) {
        sum.add_product(left, right);
    }
    fn vanishes(sum: &Sum<N>) -> bool {
        sum.vanishes()
    }
    fn nothing() -> Sum<N> {
        Sum::nothing()
    }
}

impl Number for BigInt {
    type Sum = Self;
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn add_product(sum: &mut Self, left: &Self, right: &Self) {
        *sum += left * right;
    }
    fn vanishes(sum: &Self) -> bool {
        sum.is_zero()
    }
    fn nothing() -> Self {
        Self::zero()
    }
}

/// The nonzero terms of Σ factor · left · right, sorted. Loops count by hand and index slices
/// because iterators are function calls in an unoptimised build.
pub(super) fn accumulate<K: Key, N: Number>(
    keys: &[(&[K], &[K])],
    numbers: &[(N, &[N], &[N])],
    limit: usize,
) -> Result<(Vec<K>, Vec<N::Sum>), usize> {
    let expected = keys.iter().map(|(a, b)| a.len() + b.len()).max().unwrap_or(0);
    let mut table = Table::new(expected);
    let mut sums: Vec<N::Sum> = Vec::with_capacity(expected);
    let mut index = 0;
    while index < keys.len() {
        let (left_keys, right_keys) = keys[index];
        let (factor, left, right) = &numbers[index];
        let mut i = 0;
        while i < left_keys.len() {
            cancel::check();
            let scaled = factor.times(&left[i]);
            let mut j = 0;
            while j < right_keys.len() {
                let place = table.place(left_keys[i].product(&right_keys[j]));
                if place == sums.len() {
                    sums.push(N::nothing());
                }
                N::add_product(&mut sums.as_mut_slice()[place], &scaled, &right[j]);
                j += 1;
            }
            // Checked once a row: cancellation may still bring the count down, but memory is
            // what the limit protects.
            if sums.len() > limit {
                return Err(sums.len());
            }
            i += 1;
        }
        index += 1;
    }
    Ok(sort::<K, N>(table.keys, sums))
}

/// Drops zeros and sorts keys descending.
fn sort<K: Key, N: Number>(keys: Vec<K>, sums: Vec<N::Sum>) -> (Vec<K>, Vec<N::Sum>) {
    let mut terms: Vec<(K, N::Sum)> = Vec::with_capacity(keys.len());
    for (key, sum) in keys.into_iter().zip(sums) {
        if !N::vanishes(&sum) {
            terms.push((key, sum));
        }
    }
    terms.sort_unstable_by(|a, b| b.0.cmp(&a.0));
    terms.into_iter().unzip()
}
