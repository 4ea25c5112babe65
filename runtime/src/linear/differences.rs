//! Derivatives by differences.

use super::coordinates::Coordinates;
use crate::number::Scalar;

/// The third root of rounding, at which the two errors of a central difference balance.
pub(crate) fn spacing<T: Scalar>() -> T {
    T::epsilon().simd_cbrt()
}

/// The derivative of `f` at a point by central differences: entry (i, j) is that of coordinate i of f by coordinate j.
/// `spacing` is taken of each coordinate.
pub(crate) fn central<T: Scalar, V: Coordinates<T>>(
    at: &V,
    spacing: impl Fn(T) -> T,
    f: impl Fn(&V) -> V,
) -> V::Matrix {
    let dim = at.dim();
    let mut derivative = V::zero_matrix(dim);
    let mut point = at.clone();
    for j in 0..dim {
        let by = spacing(at[j]);
        let [ahead, behind] = [at[j] + by, at[j] - by];
        point[j] = ahead;
        let right = f(&point);
        point[j] = behind;
        let left = f(&point);
        point[j] = at[j];
        let factor = T::of(1.0) / (ahead - behind);
        for i in 0..dim {
            derivative[(i, j)] = (right[i] - left[i]) * factor;
        }
    }
    derivative
}

/// The derivative of `f` at a point by one-sided differences; entries as those of [`central`].
pub(crate) fn forward<T: Scalar, V: Coordinates<T>>(
    at: &V,
    spacing: T,
    f: impl Fn(&V) -> V,
) -> V::Matrix {
    let (dim, here, factor) = (at.dim(), f(at), T::of(1.0) / spacing);
    let mut derivative = V::zero_matrix(dim);
    let mut point = at.clone();
    for j in 0..dim {
        point[j] = at[j] + spacing;
        let there = f(&point);
        point[j] = at[j];
        for i in 0..dim {
            derivative[(i, j)] = (there[i] - here[i]) * factor;
        }
    }
    derivative
}
