//! Dense networks: their evaluation and their training.

mod activation;
mod checkpoint;
mod dense;
mod descent;
mod layers;
mod options;
mod slope;
mod train;

pub use activation::Activation;
pub use dense::DenseNetwork;
pub use options::{Progress, TrainingOptions};
pub use train::fit_network;
