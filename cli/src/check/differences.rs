//! Derivatives by central differences of order six.

use nalgebra::{DMatrix, DVector};

/// Offsets in units of the spacing, and weights.
const STENCIL: [(f64, f64); 6] = [
    (1.0, 0.75),
    (-1.0, -0.75),
    (2.0, -0.15),
    (-2.0, 0.15),
    (3.0, 1.0 / 60.0),
    (-3.0, -1.0 / 60.0),
];

/// The matrix ∂f/∂x at x = 0, column by column, for f from `columns` variables; `f(i, x)` is the
/// value with only xᵢ = x other than zero. `spacing` balances rounding and truncation.
pub fn jacobian<E>(
    rows: usize,
    columns: usize,
    spacing: impl Fn(usize) -> f64,
    mut f: impl FnMut(usize, f64) -> Result<DVector<f64>, E>,
) -> Result<DMatrix<f64>, E> {
    let mut result = DMatrix::zeros(rows, columns);
    for i in 0..columns {
        let delta = spacing(i);
        let mut derivative = DVector::zeros(rows);
        for (offset, weight) in STENCIL {
            derivative += f(i, offset * delta)? * (weight / delta);
        }
        result.set_column(i, &derivative);
    }
    Ok(result)
}
