//! Hybrid models: a polynomial by least squares, a network for what it leaves.

use crate::data::ReducedData;
use crate::error::LearnError;
use crate::function::MomentumFunction;
use crate::model::Model;
use crate::network::{Progress, TrainingOptions, fit_network};
use crate::polynomial::fit_polynomial;

/// Fits a polynomial of total degree `degree`, then a network to the normalised residual.
///
/// # Errors
/// As [`fit_polynomial`] and [`fit_network`].
pub fn fit_hybrid(
    data: &ReducedData,
    degree: usize,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Model, Vec<f64>), LearnError> {
    let polynomial = fit_polynomial(data, degree, 0.0)?;
    let mut rest = data.clone();
    let mut slope = vec![0.0; data.dim()];
    for i in 0..data.len() {
        polynomial.gradient(data.p.column(i).as_slice(), &mut slope);
        for (j, s) in slope.iter().enumerate() {
            rest.x[(j, i)] -= s;
        }
    }
    let (network, history) = fit_network(&rest, options, progress)?;
    Ok((Model::Hybrid { polynomial, network }, history))
}
