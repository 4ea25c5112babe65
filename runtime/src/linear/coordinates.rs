//! Coordinate vectors on 𝔤 and 𝔤\*, of fixed or run-time dimension.

use core::fmt::Debug;
use core::ops::{Index, IndexMut};

use nalgebra::{SMatrix, SVector};

use crate::linear::square;
use crate::number::Scalar;

/// Coordinates of an element of 𝔤 (in its basis) or of 𝔤\* (in the dual basis).
///
/// [`SVector`] for groups of fixed dimension (no allocation), `DVector` for groups known only at
/// run time (feature `alloc`).
pub trait Coordinates<T: Scalar>:
    Clone + Debug + PartialEq + Index<usize, Output = T> + IndexMut<usize>
{
    /// Square matrices of the same dimension, entries at `(row, column)`.
    type Matrix: Clone + Debug + Index<(usize, usize), Output = T> + IndexMut<(usize, usize)>;

    /// Vectors at `M` nodes, coordinate by coordinate: the numbers of all nodes stand side by side.
    type Rows<const M: usize>: Clone + Debug + Index<usize, Output = [T; M]> + IndexMut<usize>;

    /// Zero vectors at all nodes; `dim` as in [`Coordinates::zeros`].
    fn zero_rows<const M: usize>(dim: usize) -> Self::Rows<M>;

    /// The vector at a node.
    #[inline(always)]
    fn at<const M: usize>(dim: usize, rows: &Self::Rows<M>, node: usize) -> Self {
        Self::from_entries(dim, |i| rows[i][node])
    }

    /// Makes vectors node by node.
    #[inline(always)]
    fn by_node<const M: usize>(dim: usize, mut vector: impl FnMut(usize) -> Self) -> Self::Rows<M> {
        let mut rows = Self::zero_rows::<M>(dim);
        for node in 0..M {
            let v = vector(node);
            for i in 0..v.dim() {
                rows[i][node] = v[i];
            }
        }
        rows
    }

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

    /// The vector whose coordinate `at` is one, and all others zero.
    fn unit(dim: usize, at: usize) -> Self {
        Self::from_entries(dim, |i| T::of(if i == at { 1.0 } else { 0.0 }))
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

    // Loops, not closures, from here on: in wide lanes the compiler leaves closures as calls.

    /// self − other.
    #[inline(always)]
    #[must_use]
    fn minus(mut self, other: &Self) -> Self {
        for i in 0..self.dim() {
            self[i] -= other[i];
        }
        self
    }

    /// In each lane this vector where `mask` holds, else the other.
    #[inline(always)]
    #[must_use]
    fn select(mut self, mask: T::SimdBool, other: &Self) -> Self {
        for i in 0..self.dim() {
            self[i] = self[i].select(mask, other[i]);
        }
        self
    }

    /// 1 − a·b.
    #[inline(always)]
    fn one_minus_product(dim: usize, a: &Self::Matrix, b: &Self::Matrix) -> Self::Matrix {
        Self::matrix_from_entries(dim, |i, j| {
            let mut sum = a[(i, 0)] * b[(0, j)];
            for k in 1..dim {
                sum = a[(i, k)].times_plus(b[(k, j)], sum);
            }
            if i == j { T::of(1.0) - sum } else { -sum }
        })
    }

    /// The product of a matrix with this vector.
    #[inline(always)]
    fn left_multiply(&self, matrix: &Self::Matrix) -> Self {
        let dim = self.dim();
        let mut result = Self::zeros(dim);
        for i in 0..dim {
            let mut sum = matrix[(i, 0)] * self[0];
            for j in 1..dim {
                sum = matrix[(i, j)].times_plus(self[j], sum);
            }
            result[i] = sum;
        }
        result
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

    /// Solves `matrix · y = right` for `y`; entries are not finite where the matrix is singular.
    fn solve(matrix: &Self::Matrix, right: &Self) -> Self {
        right.left_multiply(&square::invert(right.dim(), matrix).0)
    }
}

impl<T: Scalar, const N: usize> Coordinates<T> for SVector<T, N> {
    type Matrix = SMatrix<T, N, N>;
    type Rows<const M: usize> = [[T; M]; N];

    #[inline(always)]
    fn zero_rows<const M: usize>(_dim: usize) -> Self::Rows<M> {
        [[T::of(0.0); M]; N]
    }

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
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Coordinates<T> for nalgebra::DVector<T> {
    type Matrix = nalgebra::DMatrix<T>;
    type Rows<const M: usize> = alloc::vec::Vec<[T; M]>;

    fn zero_rows<const M: usize>(dim: usize) -> Self::Rows<M> {
        alloc::vec![[T::of(0.0); M]; dim]
    }

    fn zeros(dim: usize) -> Self {
        Self::repeat(dim, T::of(0.0))
    }

    fn zero_matrix(dim: usize) -> Self::Matrix {
        Self::Matrix::repeat(dim, dim, T::of(0.0))
    }

    fn dim(&self) -> usize {
        self.len()
    }
}
