//! The kinds of models, as one type that can be saved.

use serde::{Deserialize, Serialize};

use crate::function::MomentumFunction;
use crate::gaussian_process::GaussianProcess;
use crate::network::DenseNetwork;
use crate::polynomial::PolynomialModel;

/// A learned S, of any kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Model {
    /// A polynomial in the Chebyshev basis.
    Polynomial(PolynomialModel),
    /// A Gaussian process conditioned on gradients.
    GaussianProcess(GaussianProcess),
    /// A dense network.
    Network(DenseNetwork),
    /// A polynomial and a network fitted to its residual.
    Hybrid {
        /// The polynomial.
        polynomial: PolynomialModel,
        /// The network, fitted to the residual.
        network: DenseNetwork,
    },
}

impl Model {
    /// The name users write: `polynomial`, `gp`, `network`, `hybrid`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Polynomial(_) => "polynomial",
            Self::GaussianProcess(_) => "gp",
            Self::Network(_) => "network",
            Self::Hybrid { .. } => "hybrid",
        }
    }

    /// The function itself, or the two of which it is the sum.
    fn parts(&self) -> (&dyn MomentumFunction, Option<&dyn MomentumFunction>) {
        match self {
            Self::Polynomial(polynomial) => (polynomial, None),
            Self::GaussianProcess(process) => (process, None),
            Self::Network(network) => (network, None),
            Self::Hybrid { polynomial, network } => (polynomial, Some(network)),
        }
    }
}

impl MomentumFunction for Model {
    fn dim(&self) -> usize {
        self.parts().0.dim()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let (first, second) = self.parts();
        first.value(p) + second.map_or(0.0, |second| second.value(p))
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let (first, second) = self.parts();
        first.gradient(p, gradient);
        if let Some(second) = second {
            let mut rest = vec![0.0; gradient.len()];
            second.gradient(p, &mut rest);
            gradient.iter_mut().zip(&rest).for_each(|(a, b)| *a += b);
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        let (first, second) = self.parts();
        first.gradient_and_hessian(p, gradient, hessian);
        if let Some(second) = second {
            let mut rest = (vec![0.0; gradient.len()], vec![0.0; hessian.len()]);
            second.gradient_and_hessian(p, &mut rest.0, &mut rest.1);
            gradient.iter_mut().zip(&rest.0).for_each(|(a, b)| *a += b);
            hessian.iter_mut().zip(&rest.1).for_each(|(a, b)| *a += b);
        }
    }

    fn rounding(&self) -> f64 {
        let (first, second) = self.parts();
        second.map_or(1.0, MomentumFunction::rounding).max(first.rounding())
    }
}
