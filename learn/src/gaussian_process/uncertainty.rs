//! Predictive variance.

use nalgebra::{Cholesky, DMatrix, Dyn};

use super::kernel::covariance;
use super::model::{GaussianProcess, Stored};
use crate::error::LearnError;
use crate::function::MomentumFunction;

impl GaussianProcess {
    /// Prepares predictive variances: factors the covariance, N³n³/3 operations.
    ///
    /// # Errors
    /// [`LearnError::NotConverged`] if the stored covariance is not positive definite.
    pub fn uncertainty(&self) -> Result<Uncertainty<'_>, LearnError> {
        let Stored { points, length, noise, .. } = &self.stored;
        let matrix = covariance(points, self.dim(), *length, *noise);
        let factor = Cholesky::new(matrix).ok_or_else(|| LearnError::NotConverged {
            reason: "the stored covariance is not positive definite".into(),
        })?;
        Ok(Uncertainty { process: self, factor })
    }
}

/// Predictive variances of a Gaussian process.
#[derive(Debug)]
pub struct Uncertainty<'a> {
    process: &'a GaussianProcess,
    factor: Cholesky<f64, Dyn>,
}

impl Uncertainty<'_> {
    /// The predictive standard deviation of each coordinate of x = ∂S/∂p at p, without the noise.
    #[must_use]
    pub fn deviation(&self, p: &[f64]) -> Vec<f64> {
        let dim = self.process.dim();
        let Stored { length, deviation, scaling, .. } = &self.process.stored;
        let mut cross = DMatrix::zeros(self.process.stored.points.len(), dim);
        let mut row = 0;
        self.process.visit(p, |d, kernel, _| {
            for b in 0..dim {
                for a in 0..dim {
                    cross[(row + b, a)] = kernel.mixed(d, a, b);
                }
            }
            row += dim;
        });
        let prior = 1.0 / (length * length);
        self.factor.l_dirty().solve_lower_triangular_mut(&mut cross);
        (0..dim)
            .map(|a| {
                let variance = (prior - cross.column(a).norm_squared()).max(0.0);
                variance.sqrt() * deviation / scaling.half_width[a]
            })
            .collect()
    }
}
