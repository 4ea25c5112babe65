//! Small dense square matrices, of fixed or run-time size, with lane-uniform control flow.

use core::ops::IndexMut;

use crate::number::Scalar;

/// The operations of a square matrix that the functions below need.
pub(crate) trait Square<T>: Clone + IndexMut<(usize, usize), Output = T> {}
impl<T, M: Clone + IndexMut<(usize, usize), Output = T>> Square<T> for M {}

/// Sets every entry of an n×n matrix to `entry(row, column)`.
#[inline(always)]
pub(crate) fn fill<T: Scalar, M: Square<T>>(
    n: usize,
    m: &mut M,
    mut entry: impl FnMut(usize, usize) -> T,
) {
    for j in 0..n {
        for i in 0..n {
            m[(i, j)] = entry(i, j);
        }
    }
}

/// The identity, of the size and type of `like`.
pub(crate) fn identity<T: Scalar, M: Square<T>>(n: usize, like: &M) -> M {
    let mut result = like.clone();
    fill(n, &mut result, |i, j| T::of(if i == j { 1.0 } else { 0.0 }));
    result
}

/// a·b
#[inline(always)]
pub(crate) fn multiply<T: Scalar, M: Square<T>>(n: usize, a: &M, b: &M) -> M {
    let mut result = a.clone();
    fill(n, &mut result, |i, j| dot(n, |k| (a[(i, k)], b[(k, j)])));
    result
}

/// aᵀ·b
#[inline(always)]
pub(crate) fn transpose_multiply<T: Scalar, M: Square<T>>(n: usize, a: &M, b: &M) -> M {
    let mut result = a.clone();
    fill(n, &mut result, |i, j| dot(n, |k| (a[(k, i)], b[(k, j)])));
    result
}

/// a·bᵀ
#[inline(always)]
pub(crate) fn multiply_transpose<T: Scalar, M: Square<T>>(n: usize, a: &M, b: &M) -> M {
    let mut result = a.clone();
    fill(n, &mut result, |i, j| dot(n, |k| (a[(i, k)], b[(j, k)])));
    result
}

#[inline(always)]
fn dot<T: Scalar>(n: usize, pair: impl Fn(usize) -> (T, T)) -> T {
    let (a, b) = pair(0);
    let mut sum = a * b;
    for k in 1..n {
        let (a, b) = pair(k);
        sum = a.times_plus(b, sum);
    }
    sum
}

/// aᵀ
pub(crate) fn transpose<T: Scalar, M: Square<T>>(n: usize, a: &M) -> M {
    let mut result = a.clone();
    fill(n, &mut result, |i, j| a[(j, i)]);
    result
}

/// a + s·b
pub(crate) fn plus_scaled<T: Scalar, M: Square<T>>(n: usize, a: &M, s: T, b: &M) -> M {
    let mut result = a.clone();
    fill(n, &mut result, |i, j| b[(i, j)].times_plus(s, a[(i, j)]));
    result
}

/// s·a
pub(crate) fn scale<T: Scalar, M: Square<T>>(n: usize, a: &M, s: T) -> M {
    let mut result = a.clone();
    fill(n, &mut result, |i, j| a[(i, j)] * s);
    result
}

/// The largest absolute entry, per lane.
pub(crate) fn largest_entry<T: Scalar, M: Square<T>>(n: usize, a: &M) -> T {
    let mut largest = T::of(0.0);
    for j in 0..n {
        for i in 0..n {
            largest = largest.simd_max(a[(i, j)].simd_abs());
        }
    }
    largest
}

/// The largest row sum of absolute entries, per lane; NaN where an entry is NaN.
pub(crate) fn row_sum_norm<T: Scalar, M: Square<T>>(n: usize, a: &M) -> T {
    let mut largest = T::of(0.0);
    let mut poison = T::of(0.0);
    for i in 0..n {
        let mut sum = a[(i, 0)].simd_abs();
        for j in 1..n {
            sum += a[(i, j)].simd_abs();
        }
        largest = largest.simd_max(sum);
        poison += sum * T::of(0.0);
    }
    largest + poison
}

/// a⁻¹ and det a, by Gauss–Jordan elimination with partial pivoting, each lane choosing its own pivots by masked row
/// exchange. The inverse of a singular matrix has entries that are not finite.
pub(crate) fn invert<T: Scalar, M: Square<T>>(n: usize, a: &M) -> (M, T) {
    let (zero, one) = (T::of(0.0), T::of(1.0));
    let mut left = a.clone();
    let mut right = identity(n, a);
    let (mut determinant, mut poison) = (one, zero);
    for k in 0..n {
        for i in k + 1..n {
            let better = left[(i, k)].simd_abs().simd_gt(left[(k, k)].simd_abs());
            determinant = (-determinant).select(better, determinant);
            for m in [&mut left, &mut right] {
                for j in 0..n {
                    let (upper, lower) = (m[(k, j)], m[(i, j)]);
                    m[(k, j)] = lower.select(better, upper);
                    m[(i, j)] = upper.select(better, lower);
                }
            }
        }
        let pivot = left[(k, k)];
        determinant *= pivot;
        // NaN for a pivot that is zero; dividing by one instead keeps the determinant zero.
        poison += zero / pivot;
        let inverse = one / one.select(pivot.simd_eq(zero), pivot);
        for j in 0..n {
            left[(k, j)] *= inverse;
            right[(k, j)] *= inverse;
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = left[(i, k)];
            for j in 0..n {
                let (l, r) = (left[(k, j)], right[(k, j)]);
                left[(i, j)] -= factor * l;
                right[(i, j)] -= factor * r;
            }
        }
    }
    let regular = right.clone();
    fill(n, &mut right, |i, j| regular[(i, j)] + poison);
    (right, determinant)
}

/// The number of times a matrix or vector field of this norm is halved to come below `limit`, taken
/// over all lanes; `None` where the norm is not finite.
pub(crate) fn halvings<T: Scalar>(norm: T, limit: f64) -> Option<u32> {
    let mut norm = norm.largest_lane();
    if !norm.is_finite() {
        return None;
    }
    let mut count = 0;
    while norm > limit {
        norm *= 0.5;
        count += 1;
    }
    Some(count)
}

/// 2⁻ᵏ
pub(crate) fn half_power<T: Scalar>(k: u32) -> T {
    let half = T::of(0.5);
    let mut result = T::of(1.0);
    for _ in 0..k {
        result *= half;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    #[test]
    fn matrices_are_inverted_and_singular_ones_are_told() {
        for n in [1, 2, 3, 6, 10] {
            let a = DMatrix::<f64>::from_fn(n, n, |i, j| {
                let near = if (i + 1) % n == j { 1.0 } else { 0.0 };
                near + 0.3 * (1.0 + (7 * i + 3 * j) as f64).sin()
            });
            let (inverse, determinant) = invert(n, &a);
            let off = (&a * inverse - DMatrix::identity(n, n)).amax();
            assert!(off < 1e-12, "{off:e}");
            assert!((determinant - a.determinant()).abs() < 1e-12);
        }
        let singular = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]);
        let (inverse, determinant) = invert(2, &singular);
        assert!(determinant == 0.0 && inverse.iter().all(|entry: &f64| entry.is_nan()));
    }
}
