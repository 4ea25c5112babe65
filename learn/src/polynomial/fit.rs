//! Fitting a polynomial to its gradients by linear least squares.

use coadjoint_codegen::cancel;
use nalgebra::{DMatrix, DVector};

use super::basis::{Basis, Scaling};
use super::model::PolynomialModel;
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::least_squares::Reduced;

/// The least-squares problem of fitting ∂S/∂p(pᵢ) = xᵢ with S in `model`'s basis.
///
/// Row order: all coordinates of sample 0, then of sample 1, …
pub(crate) fn gradient_problem(
    model: &PolynomialModel,
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
) -> Reduced {
    let (dim, samples) = points.shape();
    let terms = model.basis().len();
    let mut matrix = DMatrix::zeros(dim * samples, terms);
    let mut row = vec![0.0; terms * dim];
    for (i, point) in points.column_iter().enumerate() {
        cancel::check();
        model.basis_gradients(point.as_slice(), &mut row);
        for k in 0..terms {
            for j in 0..dim {
                matrix[(i * dim + j, k)] = row[k * dim + j];
            }
        }
    }
    Reduced::new(matrix, DVector::from_column_slice(gradients.as_slice()))
}

/// The polynomial f of total degree `degree` with the least Σ|∂f/∂p(pᵢ) − xᵢ|² + ridge·s²|c|².
///
/// `points` and `gradients` hold a sample per column; `ridge` is relative to the mean squared
/// norm s² of a column of the design matrix (0: plain least squares).
///
/// # Errors
/// [`LearnError::NotDetermined`] when the samples do not determine the coefficients, and
/// [`LearnError::InvalidOption`] for a degree with too many of them.
pub fn fit_gradients(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    degree: usize,
    ridge: f64,
) -> Result<PolynomialModel, LearnError> {
    let (dim, samples) = points.shape();
    Basis::check_fit(dim, degree, samples)?;
    let model = PolynomialModel::zero(Basis::new(dim, degree), Scaling::of(points));
    let terms = model.basis().len();
    let coefficients = gradient_problem(&model, points, gradients)
        .solve(ridge)
        .ok_or(LearnError::NotDetermined { degree, terms, samples, ridge })?;
    Ok(model.with_coefficients(coefficients.as_slice()))
}

/// Fits S to reduced data, min Σ|xᵢ − ∂S/∂p(pᵢ)|²: the paper's optimisation problem, linear here.
///
/// # Errors
/// As [`fit_gradients`].
pub fn fit_polynomial(
    data: &ReducedData,
    degree: usize,
    ridge: f64,
) -> Result<PolynomialModel, LearnError> {
    fit_gradients(&data.p, &data.x, degree, ridge)
}
