//! Dense networks: their evaluation and their training; the latent momenta of the paper's section
//! 5.3 behind the feature `neural`.

mod activation;
mod adam;
mod architecture;
mod back_propagation;
mod checkpoint;
mod dense;
mod exponential;
mod gradient;
#[cfg(feature = "neural")]
mod latent;
mod lbfgs;
mod line_search;
mod minimise;
#[cfg(feature = "neural")]
mod objective;
mod options;
mod pass;
mod row;
#[cfg(feature = "neural")]
mod tensors;
mod train;

pub use activation::Activation;
pub use dense::{DenseNetwork, Layer};
#[cfg(feature = "neural")]
pub use latent::{LatentFit, LatentOptions, MomentumModel, fit_latent};
pub use options::{Progress, TrainingOptions};
pub use train::{fit_network, fit_network_to_gradients};
