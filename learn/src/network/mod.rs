//! Dense networks: evaluation in plain Rust, training behind the feature `neural`.

mod activation;
#[cfg(any(feature = "neural", test))]
mod adam;
#[cfg(feature = "neural")]
mod architecture;
#[cfg(any(feature = "neural", test))]
mod checkpoint;
mod dense;
#[cfg(feature = "neural")]
mod latent;
#[cfg(any(feature = "neural", test))]
mod lbfgs;
#[cfg(any(feature = "neural", test))]
mod line_search;
#[cfg(any(feature = "neural", test))]
mod minimise;
#[cfg(feature = "neural")]
mod objective;
#[cfg(any(feature = "neural", test))]
mod options;
#[cfg(feature = "neural")]
mod train;

pub use activation::Activation;
pub use dense::{DenseNetwork, Layer};
#[cfg(feature = "neural")]
pub use latent::{LatentFit, LatentOptions, MomentumModel, fit_latent};
#[cfg(feature = "neural")]
pub use options::{Progress, TrainingOptions};
#[cfg(feature = "neural")]
pub use train::{fit_network, fit_network_to_gradients};
