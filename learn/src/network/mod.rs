//! Dense networks: evaluation in plain Rust, training behind the feature `neural`.

mod activation;
mod dense;
#[cfg(feature = "neural")]
mod latent;
#[cfg(feature = "neural")]
mod objective;
#[cfg(feature = "neural")]
mod train;
#[cfg(feature = "neural")]
mod type_two;

pub use activation::Activation;
pub use dense::{DenseNetwork, Layer};
#[cfg(feature = "neural")]
pub use latent::{LatentFit, LatentOptions, MomentumModel, fit_latent};
#[cfg(feature = "neural")]
pub use train::{Progress, TrainingOptions, fit_network, fit_network_to_gradients};
#[cfg(feature = "neural")]
pub use type_two::{TypeTwo, canonical_pairs, fit_type_two};
