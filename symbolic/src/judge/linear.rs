//! Matrices in double or doubled precision; a vector is a matrix of one column.

use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign, DMatrix, Scalar};
use num_traits::{One, Zero};
use std::ops::{Div, Neg};

use super::DoubleDouble;

/// The functions that all others are made of; not a number outside their domains.
pub(super) trait Functions: Sized {
    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn sin_cos(self) -> (Self, Self);
    /// The angle between −π/2 and π/2 with this tangent.
    fn atan(self) -> Self;
}

impl Functions for f64 {
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    fn exp(self) -> Self {
        self.exp()
    }
    fn ln(self) -> Self {
        self.ln()
    }
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
    fn atan(self) -> Self {
        self.atan()
    }
}

/// The arithmetic that the judge needs, in double or doubled precision.
pub(super) trait Real:
    Scalar
    + Copy
    + Zero
    + One
    + From<f64>
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + Neg<Output = Self>
    + Div<Output = Self>
    + Functions
{
    /// The number of doubled precision, rounded to this type.
    fn of(value: DoubleDouble) -> Self;

    /// The nearest double.
    fn double(self) -> f64;

    /// The product with 2^exponent.
    fn scaled(self, exponent: i64) -> Self;

    /// The solution of a linear system for each column of the right side; `None` where the matrix is singular, as far as
    /// double precision tells.
    fn solve(matrix: &DMatrix<Self>, right: &DMatrix<Self>) -> Option<DMatrix<Self>>;
}

impl Real for f64 {
    fn of(value: DoubleDouble) -> Self {
        value.to_f64()
    }

    fn double(self) -> f64 {
        self
    }

    fn scaled(self, exponent: i64) -> Self {
        DoubleDouble::from(self).scaled(exponent).to_f64()
    }

    fn solve(matrix: &DMatrix<Self>, right: &DMatrix<Self>) -> Option<DMatrix<Self>> {
        matrix.clone().lu().solve(right)
    }
}

impl Real for DoubleDouble {
    fn of(value: DoubleDouble) -> Self {
        value
    }

    fn double(self) -> f64 {
        self.to_f64()
    }

    fn scaled(self, exponent: i64) -> Self {
        Self::scaled(self, exponent)
    }

    /// Solves by factors in double precision; the solution is refined as far as its residual in doubled precision tells.
    fn solve(matrix: &DMatrix<Self>, right: &DMatrix<Self>) -> Option<DMatrix<Self>> {
        const ROUNDING: f64 = 1e-29;
        const ENOUGH: f64 = 1e-20;
        let factors = doubles(matrix).lu();
        let mut solution = DMatrix::zeros(right.nrows(), right.ncols());
        let mut last = f64::INFINITY;
        loop {
            let correction = factors.solve(&doubles(&(right - matrix * &solution)))?;
            let length = size(&correction);
            if !(length < 0.5 * last) {
                return (last <= ENOUGH * size(&solution)).then_some(solution);
            }
            solution += exact(&correction);
            last = length;
            if length <= ROUNDING * size(&solution) {
                return Some(solution);
            }
        }
    }
}

/// A column of these numbers.
pub(super) fn column<T: Scalar>(values: impl ExactSizeIterator<Item = T>) -> DMatrix<T> {
    DMatrix::from_iterator(values.len(), 1, values)
}

/// The matrix rounded to double precision.
pub(super) fn doubles<T: Real>(matrix: &DMatrix<T>) -> DMatrix<f64> {
    matrix.map(Real::double)
}

/// The matrix in doubled precision.
pub(super) fn exact(matrix: &DMatrix<f64>) -> DMatrix<DoubleDouble> {
    matrix.map(DoubleDouble::from)
}

/// The largest absolute value, in double precision; NaN where a value is.
pub(super) fn size<'a, T: Real>(values: impl IntoIterator<Item = &'a T>) -> f64 {
    values.into_iter().fold(0.0, |largest, value| maximum(largest, value.double().abs()))
}

/// The Euclidean norm, of a matrix Frobenius' one, without overflow; NaN where a value is.
pub(super) fn norm<'a, T: Real>(values: impl IntoIterator<Item = &'a T> + Copy) -> f64 {
    let largest = size(values);
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    let squares = values.into_iter().map(|x| (x.double() / largest).powi(2));
    largest * squares.sum::<f64>().sqrt()
}

/// A function's derivative at x by differences over this spacing, where it has the value `here`.
///
/// # Errors
/// Returns the errors of the function.
pub(super) fn derivative<E>(
    x: &DMatrix<f64>,
    here: &DMatrix<f64>,
    spacing: f64,
    function: impl Fn(&DMatrix<f64>) -> Result<DMatrix<f64>, E>,
) -> Result<DMatrix<f64>, E> {
    let mut derivative = DMatrix::zeros(here.nrows(), x.nrows());
    let mut beside = x.clone();
    for (i, mut column) in derivative.column_iter_mut().enumerate() {
        beside[i] = x[i] + spacing;
        let change = (function(&beside)? - here) / (beside[i] - x[i]);
        column.copy_from(&change.column(0));
        beside[i] = x[i];
    }
    Ok(derivative)
}

/// A bound on the spectral norm: the smaller of Frobenius' norm and the root of those by rows and by columns.
pub(super) fn spectral(matrix: &DMatrix<f64>) -> f64 {
    let sums = |matrix: &DMatrix<f64>| {
        matrix.row_iter().map(|row| row.iter().map(|entry| entry.abs()).sum()).fold(0.0, maximum)
    };
    let (sums, whole) = ((sums(matrix) * sums(&matrix.transpose())).sqrt(), norm(matrix));
    if sums < whole { sums } else { whole }
}

/// The spacing of differences, relative to what is varied: the root of rounding.
pub(super) const SPACING: f64 = 1.5e-8;

/// The larger of two numbers; NaN where one is, unlike `f64::max`.
pub(super) fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
