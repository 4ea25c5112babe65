//! Dense networks: their evaluation and their training.

mod activation;
mod checkpoint;
mod dense;
mod descent;
mod slope;
mod train;

pub use activation::Activation;
pub use dense::{DenseNetwork, Layer};
pub use train::{Progress, TrainingOptions, fit_network};
