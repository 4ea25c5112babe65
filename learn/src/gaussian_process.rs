//! A Gaussian process on S, conditioned on its gradients.

use coadjoint_codegen::cancel;
use nalgebra::{Cholesky, DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::data::ReducedData;
use crate::error::LearnError;
use crate::function::MomentumFunction;
use crate::polynomial::{PolynomialModel, Scaling, fit_polynomial};

/// The kernel's derivatives at the difference d = u − u′, for unit σ.
struct Kernel {
    inverse: f64,
    value: f64,
}

impl Kernel {
    fn at(d: &[f64], length: f64) -> Self {
        let inverse = 1.0 / (length * length);
        let square: f64 = d.iter().map(|v| v * v).sum();
        Self { inverse, value: (-0.5 * square * inverse).exp() }
    }

    /// ∂²k/∂u_a∂u′_b.
    fn mixed(&self, d: &[f64], a: usize, b: usize) -> f64 {
        let delta = if a == b { 1.0 } else { 0.0 };
        self.inverse * (delta - d[a] * d[b] * self.inverse) * self.value
    }

    /// ∂³k/∂u_a∂u_c∂u′_b.
    fn third(&self, d: &[f64], a: usize, b: usize, c: usize) -> f64 {
        let delta = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let product = delta(a, c) * d[b] + delta(b, c) * d[a] + delta(a, b) * d[c];
        let inner = d[a] * d[b] * d[c] * self.inverse - product;
        self.inverse * self.inverse * inner * self.value
    }
}

/// K + noise for unit σ: blocks of n×n per pair of points.
fn covariance(points: &[f64], dim: usize, length: f64, noise: f64) -> DMatrix<f64> {
    let size = points.len();
    let mut matrix = DMatrix::zeros(size, size);
    let mut d = vec![0.0; dim];
    for (i, u) in points.chunks_exact(dim).enumerate() {
        for (j, v) in points.chunks_exact(dim).enumerate().take(i + 1) {
            d.iter_mut().zip(u.iter().zip(v)).for_each(|(d, (u, v))| *d = u - v);
            let kernel = Kernel::at(&d, length);
            for a in 0..dim {
                for b in 0..dim {
                    let entry = kernel.mixed(&d, a, b);
                    matrix[(i * dim + a, j * dim + b)] = entry;
                    matrix[(j * dim + b, i * dim + a)] = entry;
                }
            }
        }
    }
    for k in 0..size {
        // The diagonal of K is 1/ℓ²; noise is relative to it.
        matrix[(k, k)] += noise / (length * length);
    }
    matrix
}

/// S = polynomial + a Gaussian process with the squared-exponential kernel
/// σ² exp(−|u − u′|²/2ℓ²) in normalised momenta u, conditioned on gradients.
///
/// The covariance of the observed gradients is the mixed second derivative of the kernel
/// (Rasmussen and Williams, *Gaussian Processes for Machine Learning*, section 9.4).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Posterior", into = "Posterior")]
pub struct GaussianProcess {
    stored: Posterior,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Posterior {
    mean: PolynomialModel,
    scaling: Scaling,
    length: f64,
    deviation: f64,
    noise: f64,
    /// Normalised points, n numbers per sample.
    points: Vec<f64>,
    /// (K + noise)⁻¹ y for unit σ, n numbers per sample.
    weights: Vec<f64>,
}

impl From<GaussianProcess> for Posterior {
    fn from(process: GaussianProcess) -> Self {
        process.stored
    }
}

impl TryFrom<Posterior> for GaussianProcess {
    type Error = String;

    fn try_from(stored: Posterior) -> Result<Self, String> {
        let dim = stored.mean.dim();
        let Scaling { centre, half_width } = &stored.scaling;
        if centre.len() != dim || half_width.len() != dim {
            return Err(format!("the scaling must have {dim} centres and half widths"));
        }
        if stored.points.len() != stored.weights.len() || !stored.points.len().is_multiple_of(dim) {
            return Err("points and weights must have the same length, a multiple of n".into());
        }
        let positive = [stored.length, stored.deviation, stored.noise];
        if !positive.iter().chain(half_width).all(|v| v.is_finite() && *v > 0.0)
            || !stored.points.iter().chain(&stored.weights).chain(centre).all(|v| v.is_finite())
        {
            return Err("numbers must be finite, lengths and deviations positive".into());
        }
        Ok(Self { stored })
    }
}

impl GaussianProcess {
    /// Calls `visit` with every point's difference, kernel and weights.
    fn visit(&self, p: &[f64], mut visit: impl FnMut(&[f64], &Kernel, &[f64])) {
        let dim = self.dim();
        let scaling = &self.stored.scaling;
        let u: Vec<f64> = p.iter().enumerate().map(|(i, &v)| scaling.normalise(i, v)).collect();
        let mut d = vec![0.0; dim];
        let points = self.stored.points.chunks_exact(dim);
        for (point, weights) in points.zip(self.stored.weights.chunks_exact(dim)) {
            d.iter_mut().zip(u.iter().zip(point)).for_each(|(d, (u, v))| *d = u - v);
            visit(&d, &Kernel::at(&d, self.stored.length), weights);
        }
    }
}

impl MomentumFunction for GaussianProcess {
    fn dim(&self) -> usize {
        self.stored.mean.dim()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.visit(p, |d, kernel, weights| {
            let along: f64 = d.iter().zip(weights).map(|(d, w)| d * w).sum();
            sum += along * kernel.inverse * kernel.value;
        });
        self.stored.mean.value(p) + sum
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        self.stored.mean.gradient(p, gradient);
        let width = &self.stored.scaling.half_width;
        self.visit(p, |d, kernel, weights| {
            let along: f64 = d.iter().zip(weights).map(|(d, w)| d * w).sum();
            for (a, entry) in gradient.iter_mut().enumerate() {
                let inner = weights[a] - d[a] * along * kernel.inverse;
                *entry += inner * kernel.inverse * kernel.value / width[a];
            }
        });
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let dim = self.dim();
        let mut slope = vec![0.0; dim];
        self.stored.mean.gradient_and_hessian(p, &mut slope, hessian);
        let width = &self.stored.scaling.half_width;
        self.visit(p, |d, kernel, weights| {
            for a in 0..dim {
                for c in 0..dim {
                    let sum: f64 = (0..dim).map(|b| weights[b] * kernel.third(d, a, b, c)).sum();
                    hessian[a * dim + c] += sum / (width[a] * width[c]);
                }
            }
        });
    }

    /// The rounding of a sum over all weights, which cancel, grows with the root of their number.
    fn rounding(&self) -> f64 {
        (self.stored.weights.len() as f64).sqrt().max(1.0)
    }
}

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
    let dim = data.p.nrows();
    // Residual gradients in normalised momenta: ∂/∂u_j = w_j ∂/∂p_j.
    let thinned = |limit: usize| -> (Vec<f64>, DVector<f64>) {
        let stride = data.count().div_ceil(limit.max(1)).max(1);
        let (mut points, mut targets) = (Vec::new(), Vec::new());
        let mut slope = vec![0.0; dim];
        for i in (0..data.count()).step_by(stride) {
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
    let stored = Posterior {
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
