//! A Gaussian process on S, conditioned on its gradients.

mod fit;
mod kernel;
mod model;

pub use fit::fit_gaussian_process;
pub use model::GaussianProcess;
