//! Gaussian elimination with pivots that are blocks of three.
//!
//! A block is inverted by cofactors, with one division: a third of the divisions, and of the waiting
//! for them, that elimination entry by entry takes. For n = 3 this is Cramer's rule.

use core::ops::{Index, IndexMut};

use crate::number::scalar::Scalar;

/// The side of a pivot.
const SIDE: usize = 3;

/// Replaces the matrix by its factors: on the diagonal the inverses of the pivots, below the blocks
/// that eliminate, above what is left of the matrix. The last pivot is kept as its adjugate, and the
/// inverse of its determinant returned: so the solve need not wait for that division.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn factor<T: Scalar, M>(n: usize, a: &mut M) -> T
where
    M: IndexMut<(usize, usize), Output = T>,
{
    let mut last = T::of(1.0);
    for k in (0..n).step_by(SIDE) {
        let end = n.min(k + SIDE);
        let (adjugate, determinant) = adjugate(a, k, end - k);
        let inverse = T::of(1.0) / determinant;
        for i in 0..end - k {
            for j in 0..end - k {
                let entry = adjugate[i][j];
                a[(k + i, k + j)] = if end < n { entry * inverse } else { entry };
            }
        }
        last = inverse;
        for i in end..n {
            let row = [a[(i, k)], entry(a, i, k + 1, end), entry(a, i, k + 2, end)];
            for j in k..end {
                let mut sum = row[0] * a[(k, j)];
                for l in k + 1..end {
                    sum = row[l - k].times_plus(a[(l, j)], sum);
                }
                a[(i, j)] = sum;
            }
        }
        for j in end..n {
            for i in end..n {
                let mut rest = a[(i, j)];
                for l in k..end {
                    rest = (-a[(i, l)]).times_plus(a[(l, j)], rest);
                }
                a[(i, j)] = rest;
            }
        }
    }
    last
}

/// Solves by the factors and what [`factor`] returned, in place.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn solve<T: Scalar, M, V>(n: usize, a: &M, last: T, b: &mut V)
where
    M: Index<(usize, usize), Output = T>,
    V: IndexMut<usize, Output = T>,
{
    for i in SIDE..n {
        let mut rest = b[i];
        for l in 0..i / SIDE * SIDE {
            rest = (-a[(i, l)]).times_plus(b[l], rest);
        }
        b[i] = rest;
    }
    for k in (0..n).step_by(SIDE).rev() {
        let end = n.min(k + SIDE);
        let mut rest = [T::of(0.0); SIDE];
        for i in k..end {
            let mut sum = b[i];
            for j in end..n {
                sum = (-a[(i, j)]).times_plus(b[j], sum);
            }
            rest[i - k] = sum;
        }
        for i in k..end {
            let mut sum = a[(i, k)] * rest[0];
            for l in k + 1..end {
                sum = a[(i, l)].times_plus(rest[l - k], sum);
            }
            b[i] = if end < n { sum } else { sum * last };
        }
    }
}

/// The entry, or 0 beyond the last column of a block.
#[inline(always)]
fn entry<T: Scalar, M>(a: &M, i: usize, j: usize, end: usize) -> T
where
    M: Index<(usize, usize), Output = T>,
{
    if j < end { a[(i, j)] } else { T::of(0.0) }
}

/// The adjugate and the determinant of the diagonal block that begins at `k`, of side 1, 2 or 3.
#[inline(always)]
fn adjugate<T: Scalar, M>(m: &M, k: usize, side: usize) -> ([[T; SIDE]; SIDE], T)
where
    M: Index<(usize, usize), Output = T>,
{
    let zero = T::of(0.0);
    match side {
        1 => ([[T::of(1.0), zero, zero], [zero; SIDE], [zero; SIDE]], m[(k, k)]),
        2 => {
            let (a, b) = (m[(k, k)], m[(k, k + 1)]);
            let (c, d) = (m[(k + 1, k)], m[(k + 1, k + 1)]);
            ([[d, -b, zero], [-c, a, zero], [zero; SIDE]], a * d - b * c)
        }
        _ => {
            let rows = [row(m, k, 0), row(m, k, 1), row(m, k, 2)];
            let a = cross(&rows[1], &rows[2]);
            let b = cross(&rows[2], &rows[0]);
            let c = cross(&rows[0], &rows[1]);
            let determinant = rows[0][0] * a[0] + rows[0][1] * a[1] + rows[0][2] * a[2];
            ([[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]], determinant)
        }
    }
}

// Functions, not closures: in wide lanes the compiler leaves closures as calls.

/// Row k + i of the diagonal block that begins at `k`.
#[inline(always)]
fn row<T: Scalar, M>(m: &M, k: usize, i: usize) -> [T; SIDE]
where
    M: Index<(usize, usize), Output = T>,
{
    [m[(k + i, k)], m[(k + i, k + 1)], m[(k + i, k + 2)]]
}

/// a × b.
#[inline(always)]
fn cross<T: Scalar>(a: &[T; SIDE], b: &[T; SIDE]) -> [T; SIDE] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{SMatrix, SVector};

    fn residual<const N: usize>() -> f64 {
        let a = SMatrix::<f64, N, N>::from_fn(|i, j| {
            let near = if i == j { 1.0 } else { 0.0 };
            near + 0.3 * (1.0 + (7 * i + 3 * j) as f64).sin()
        });
        let y = SVector::<f64, N>::from_fn(|i, _| (i as f64 - 1.5).cos());
        let mut b = a * y;
        let mut factors = a;
        let last = factor(N, &mut factors);
        solve(N, &factors, last, &mut b);
        (b - y).amax()
    }

    #[test]
    fn every_remainder_of_the_dimension_by_three_is_solved() {
        let worst = [residual::<1>(), residual::<2>(), residual::<3>(), residual::<4>()];
        let larger = [residual::<5>(), residual::<6>(), residual::<8>(), residual::<10>()];
        for residual in worst.into_iter().chain(larger) {
            assert!(residual < 1e-13, "{residual:e}");
        }
    }
}
