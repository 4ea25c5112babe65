//! Coordinate vectors on 𝔤 and 𝔤\*, of fixed or run-time dimension.

use core::fmt::Debug;
use core::ops::{Index, IndexMut};

use nalgebra::{SMatrix, SVector};

use crate::scalar::Scalar;

/// Coordinates of an element of 𝔤 (in its basis) or of 𝔤\* (in the dual basis).
///
/// [`SVector`] for groups of fixed dimension (no allocation), `DVector` for groups known only at
/// run time (feature `alloc`).
pub trait Coordinates<T: Scalar>:
    Clone + Debug + PartialEq + Index<usize, Output = T> + IndexMut<usize>
{
    /// Square matrices of the same dimension, entries at `(row, column)`.
    type Matrix: Clone + Debug + Index<(usize, usize), Output = T> + IndexMut<(usize, usize)>;

    /// The zero vector; `dim` must be the fixed dimension where there is one.
    fn zeros(dim: usize) -> Self;

    /// The zero matrix; `dim` as in [`Coordinates::zeros`].
    fn zero_matrix(dim: usize) -> Self::Matrix;

    /// The number of coordinates.
    fn dim(&self) -> usize;

    /// The vector with entries `entry(0)`, `entry(1)`, …
    #[inline(always)]
    fn from_entries(dim: usize, mut entry: impl FnMut(usize) -> T) -> Self {
        let mut result = Self::zeros(dim);
        for i in 0..result.dim() {
            result[i] = entry(i);
        }
        result
    }

    /// The matrix with entries `entry(row, column)`.
    #[inline(always)]
    fn matrix_from_entries(dim: usize, mut entry: impl FnMut(usize, usize) -> T) -> Self::Matrix {
        let mut result = Self::zero_matrix(dim);
        for i in 0..dim {
            for j in 0..dim {
                result[(i, j)] = entry(i, j);
            }
        }
        result
    }

    /// The product of a matrix with this vector.
    #[inline(always)]
    fn left_multiply(&self, matrix: &Self::Matrix) -> Self {
        let dim = self.dim();
        Self::from_entries(dim, |i| {
            let mut sum = matrix[(i, 0)] * self[0];
            for j in 1..dim {
                sum = matrix[(i, j)].times_plus(self[j], sum);
            }
            sum
        })
    }

    /// The pairing ⟨self, other⟩ = Σ selfᵢ otherᵢ.
    #[inline(always)]
    fn pairing(&self, other: &Self) -> T {
        let mut sum = self[0] * other[0];
        for i in 1..self.dim() {
            sum = self[i].times_plus(other[i], sum);
        }
        sum
    }

    /// The largest absolute entry, per lane.
    #[inline(always)]
    fn largest_entry(&self) -> T {
        let mut largest = self[0].simd_abs();
        for i in 1..self.dim() {
            largest = largest.simd_max(self[i].simd_abs());
        }
        largest
    }

    /// Solves `matrix · y = right` for `y`.
    ///
    /// Elimination without pivoting (SIMD lanes cannot swap rows one by one): meant for matrices
    /// near the identity, as the solver's are. A singular matrix gives non-finite entries, which
    /// the caller must look for.
    fn solve(matrix: Self::Matrix, right: Self) -> Self;
}

impl<T: Scalar, const N: usize> Coordinates<T> for SVector<T, N> {
    type Matrix = SMatrix<T, N, N>;

    #[inline(always)]
    fn zeros(_dim: usize) -> Self {
        Self::repeat(T::of(0.0))
    }

    #[inline(always)]
    fn zero_matrix(_dim: usize) -> Self::Matrix {
        Self::Matrix::repeat(T::of(0.0))
    }

    #[inline(always)]
    fn dim(&self) -> usize {
        N
    }

    #[inline(always)]
    fn solve(matrix: Self::Matrix, right: Self) -> Self {
        if N == 3 { solve_by_cofactors(&matrix, &right) } else { eliminate(N, matrix, right) }
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Coordinates<T> for nalgebra::DVector<T> {
    type Matrix = nalgebra::DMatrix<T>;

    fn zeros(dim: usize) -> Self {
        Self::repeat(dim, T::of(0.0))
    }

    fn zero_matrix(dim: usize) -> Self::Matrix {
        Self::Matrix::repeat(dim, dim, T::of(0.0))
    }

    fn dim(&self) -> usize {
        self.len()
    }

    fn solve(matrix: Self::Matrix, right: Self) -> Self {
        eliminate(right.len(), matrix, right)
    }
}

/// Cramer's rule for three unknowns: shorter dependency chains than elimination.
#[inline(always)]
fn solve_by_cofactors<T: Scalar, V: Coordinates<T>>(a: &V::Matrix, b: &V) -> V {
    let cross = |r: usize, s: usize| {
        let minor = |i: usize, j: usize| a[(r, i)] * a[(s, j)] - a[(r, j)] * a[(s, i)];
        [minor(1, 2), minor(2, 0), minor(0, 1)]
    };
    let (c0, c1, c2) = (cross(1, 2), cross(2, 0), cross(0, 1));
    let determinant = a[(0, 0)] * c0[0] + a[(0, 1)] * c0[1] + a[(0, 2)] * c0[2];
    let inverse = T::of(1.0) / determinant;
    V::from_entries(3, |i| (c0[i] * b[0] + c1[i] * b[1] + c2[i] * b[2]) * inverse)
}

/// Gaussian elimination in place, no pivoting.
#[inline(always)]
fn eliminate<T: Scalar, V: Coordinates<T>>(n: usize, mut a: V::Matrix, mut b: V) -> V {
    for k in 0..n {
        let inverse = T::of(1.0) / a[(k, k)];
        for i in k + 1..n {
            let factor = a[(i, k)] * inverse;
            for j in k + 1..n {
                let product = factor * a[(k, j)];
                a[(i, j)] -= product;
            }
            let product = factor * b[k];
            b[i] -= product;
        }
        a[(k, k)] = inverse;
    }
    for k in (0..n).rev() {
        let mut sum = b[k];
        for j in k + 1..n {
            sum -= a[(k, j)] * b[j];
        }
        b[k] = sum * a[(k, k)];
    }
    b
}
