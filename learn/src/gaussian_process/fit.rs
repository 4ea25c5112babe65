//! Length and noise by the marginal likelihood, weights by one solve.

use coadjoint_codegen::cancel;
use nalgebra::{Cholesky, DVector};

use super::kernel::covariance;
use super::model::{GaussianProcess, Stored};
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::function::MomentumFunction;
use crate::polynomial::{Scaling, fit_polynomial};

/// The degree of the polynomial that is the prior mean.
const MEAN_DEGREE: usize = 2;
/// The maximum number of samples by which length and noise are chosen.
const LARGEST_FOR_CHOICE: usize = 120;

/// Minus twice the logarithm of the marginal likelihood with σ at its best, up to a constant; the
/// best σ² and the weights.
fn likelihood(
    points: &[f64],
    targets: &DVector<f64>,
    dim: usize,
    length: f64,
    noise: f64,
) -> Option<(f64, f64, DVector<f64>)> {
    cancel::check();
    let factor = Cholesky::new(covariance(points, dim, length, noise))?;
    let weights = factor.solve(targets);
    let count = targets.len() as f64;
    let variance = targets.dot(&weights) / count;
    let determinant: f64 = factor.l_dirty().diagonal().iter().map(|v| v.ln()).sum::<f64>() * 2.0;
    let score = count * variance.ln() + determinant;
    (score.is_finite() && variance > 0.0).then_some((score, variance, weights))
}

/// Fits a Gaussian process to reduced data; length and noise by the marginal likelihood on a grid. More samples than
/// `largest` are thinned evenly: the work grows with the cube of their number.
///
/// # Errors
/// [`LearnError::NotDetermined`] when the prior mean cannot be fitted,
/// [`LearnError::NotConverged`] when no covariance is positive definite.
pub fn fit_gaussian_process(
    data: &ReducedData,
    largest: usize,
) -> Result<GaussianProcess, LearnError> {
    let mean = fit_polynomial(data, MEAN_DEGREE, 0.0)
        .or_else(|_| fit_polynomial(data, MEAN_DEGREE, 1e-8))?;
    let scaling = Scaling::of(&data.p);
    let dim = data.dim();
    // Residual gradients in normalised momenta: ∂/∂u_j = w_j ∂/∂p_j.
    let thinned = |limit: usize| -> (Vec<f64>, DVector<f64>) {
        let stride = data.len().div_ceil(limit.max(1)).max(1);
        let (mut points, mut targets) = (Vec::new(), Vec::new());
        let mut slope = vec![0.0; dim];
        for i in (0..data.len()).step_by(stride) {
            let p = data.p.column(i);
            mean.gradient(p.as_slice(), &mut slope);
            for j in 0..dim {
                points.push(scaling.normalise(j, p[j]));
                targets.push((data.x[(j, i)] - slope[j]) * scaling.half_width[j]);
            }
        }
        (points, DVector::from_vec(targets))
    };
    let (points, targets) = thinned(LARGEST_FOR_CHOICE);
    let mut best: Option<(f64, f64, f64)> = None;
    for length in [0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0] {
        for noise in [1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0] {
            if let Some((score, ..)) = likelihood(&points, &targets, dim, length, noise)
                && best.is_none_or(|(least, ..)| score < least)
            {
                best = Some((score, length, noise));
            }
        }
    }
    let failed = || {
        let reason = "no covariance of the Gaussian process is positive definite";
        LearnError::NotConverged(reason.into())
    };
    let (_, length, mut noise) = best.ok_or_else(failed)?;
    let (points, targets) = thinned(largest);
    // More points can need a little more noise to stay positive definite.
    let (variance, weights) = loop {
        if let Some((_, variance, weights)) = likelihood(&points, &targets, dim, length, noise) {
            break (variance, weights);
        }
        noise *= 10.0;
        if noise > 1.0 {
            return Err(failed());
        }
    };
    let stored = Stored {
        mean,
        scaling,
        length,
        deviation: variance.sqrt(),
        noise,
        points,
        weights: weights.as_slice().to_vec(),
    };
    Ok(GaussianProcess { stored })
}
