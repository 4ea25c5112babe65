//! Direct products of groups: of two, of many copies of one, and of a number known at run time.

#[cfg(feature = "alloc")]
mod direct;
mod pair;
mod power;

#[cfg(feature = "alloc")]
pub use direct::DirectProduct;
pub use pair::Product;
pub use power::Power;

use nalgebra::{SMatrix, SVector};

use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// The coordinates `start..start + dim` of x.
#[inline(always)]
fn part<T: Scalar, V: Coordinates<T>, const N: usize>(
    x: &SVector<T, N>,
    start: usize,
    dim: usize,
) -> V {
    V::from_entries(dim, |i| x[start + i])
}

/// Writes `values` to the coordinates from `start`.
#[inline(always)]
fn place<T: Scalar, V: Coordinates<T>, const N: usize>(
    values: &V,
    start: usize,
    x: &mut SVector<T, N>,
) {
    for i in 0..values.dim() {
        x[start + i] = values[i];
    }
}

/// Writes a diagonal block from (`start`, `start`).
#[inline(always)]
fn place_block<T: Scalar, V: Coordinates<T>, const N: usize>(
    block: &V::Matrix,
    start: usize,
    dim: usize,
    matrix: &mut SMatrix<T, N, N>,
) {
    for i in 0..dim {
        for j in 0..dim {
            matrix[(start + i, start + j)] = block[(i, j)];
        }
    }
}
