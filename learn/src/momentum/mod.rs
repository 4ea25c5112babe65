//! Learning Poisson maps from momenta alone, (μ′, μ″): section 5.3 of the paper.

mod eliminate;

pub use eliminate::{PoissonFit, PoissonOptions, fit_poisson};
