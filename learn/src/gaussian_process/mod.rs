//! A Gaussian process on S, conditioned on its gradients, with predictive variance.

mod fit;
mod kernel;
mod model;
mod uncertainty;

pub use fit::{GaussianProcessOptions, fit_gaussian_process};
pub use model::GaussianProcess;
pub use uncertainty::Uncertainty;
