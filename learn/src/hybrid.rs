//! Hybrid models: a polynomial by least squares and a network fitted to its residual.

use nalgebra::DMatrix;

use crate::error::LearnError;
use crate::function::MomentumFunction;
use crate::model::Model;
use crate::network::{Progress, TrainingOptions, fit_network};
use crate::polynomial::fit_gradients;

/// Fits a polynomial of total degree `degree` to the gradients of a function at points, a sample per column, then a
/// network to the normalised residual; also returns the network's loss after every evaluation.
///
/// # Errors
/// As [`fit_gradients`] and [`fit_network`].
pub fn fit_hybrid(
    points: &DMatrix<f64>,
    gradients: &DMatrix<f64>,
    degree: usize,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Model, Vec<f64>), LearnError> {
    let polynomial = fit_gradients(points, gradients, degree, 0.0)?;
    let mut rest = gradients.clone();
    let mut slope = vec![0.0; points.nrows()];
    for i in 0..points.ncols() {
        polynomial.gradient(points.column(i).as_slice(), &mut slope);
        for (j, s) in slope.iter().enumerate() {
            rest[(j, i)] -= s;
        }
    }
    let (network, history) = fit_network(points, &rest, None, options, progress)?;
    Ok((Model::Hybrid { polynomial, network }, history))
}
