//! Learning H_red itself, through the Lie–Poisson variational integrator of the paper's remark.

use crate::data::ReducedData;
use crate::error::LearnError;
use crate::polynomial::{PolynomialModel, fit_gradients};

/// Fits H_red to reduced data of the exponential chart: min Σ|ξᵢ − ∂H_red/∂μ(pᵢ)|² with
/// ξᵢ = Δt⁻¹ exp⁻¹(gᵢ) and pᵢ = (d^L exp_{Δtξᵢ})ᵀ μ″ᵢ.
///
/// The integrator behind it is of second order, so the H found is the true one up to O(Δt²) (and a
/// constant): exactly S/Δt.
///
/// # Errors
/// [`LearnError::InvalidOption`] for a step that is zero or not finite, else as
/// [`fit_gradients`].
pub fn fit_hamiltonian(
    data: &ReducedData,
    step: f64,
    degree: usize,
    ridge: f64,
) -> Result<PolynomialModel, LearnError> {
    if !(step.is_finite() && step != 0.0) {
        return Err(LearnError::InvalidOption {
            option: "dt",
            value: step.to_string(),
            requirement: "give the time between the two states of a pair".into(),
        });
    }
    fit_gradients(&data.p, &(&data.x / step), degree, ridge)
}
