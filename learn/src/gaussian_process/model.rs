//! The fitted process as a function of momenta.

use serde::{Deserialize, Serialize};

use super::kernel::Kernel;
use crate::function::MomentumFunction;
use crate::polynomial::{PolynomialModel, Scaling};

/// S = polynomial + a Gaussian process with the squared-exponential kernel
/// σ² exp(−|u − u′|²/2ℓ²) in normalised momenta u, conditioned on gradients.
///
/// The covariance of the observed gradients is the mixed second derivative of the kernel
/// (Rasmussen and Williams, *Gaussian Processes for Machine Learning*, section 9.4).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct GaussianProcess {
    pub(super) stored: Stored,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Stored {
    pub(super) mean: PolynomialModel,
    pub(super) scaling: Scaling,
    pub(super) length: f64,
    pub(super) deviation: f64,
    pub(super) noise: f64,
    /// Normalised points, n numbers per sample.
    pub(super) points: Vec<f64>,
    /// (K + noise)⁻¹ y for unit σ, n numbers per sample.
    pub(super) weights: Vec<f64>,
}

impl From<GaussianProcess> for Stored {
    fn from(process: GaussianProcess) -> Self {
        process.stored
    }
}

impl TryFrom<Stored> for GaussianProcess {
    type Error = String;

    fn try_from(stored: Stored) -> Result<Self, String> {
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

    /// Of a sum over all weights, which cancel: it grows with the root of their number.
    fn rounding(&self) -> f64 {
        (self.stored.weights.len() as f64).sqrt().max(1.0)
    }
}
