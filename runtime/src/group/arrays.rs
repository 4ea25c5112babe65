//! Vectors and rows of nodes as the arrays that formulas compute with.

use coadjoint_geometry::row::Row;
use nalgebra::SVector;

use crate::number::Scalar;

/// A vector of space at each of M nodes, coordinate by coordinate.
pub(super) type Rows3<T, const M: usize> = [[T; M]; 3];
/// Coordinates of a motion at each of M nodes.
pub(super) type Rows6<T, const M: usize> = [[T; M]; 6];

/// The entries of a vector.
#[inline(always)]
pub(super) fn array<T: Scalar, const N: usize>(x: &SVector<T, N>) -> [T; N] {
    x.data.0[0]
}

/// Rows as numbers.
#[inline(always)]
pub(super) fn nodes<T: Scalar, const M: usize, const N: usize>(x: &[[T; M]; N]) -> [Row<T, M>; N] {
    let mut numbers = [Row([T::of(0.0); M]); N];
    for i in 0..N {
        numbers[i] = Row(x[i]);
    }
    numbers
}

/// The rows of numbers.
#[inline(always)]
pub(super) fn rows<T: Scalar, const M: usize, const N: usize>(x: [Row<T, M>; N]) -> [[T; M]; N] {
    let mut rows = [[T::of(0.0); M]; N];
    for i in 0..N {
        rows[i] = x[i].0;
    }
    rows
}
