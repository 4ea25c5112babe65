//! The generating function of the flow as a power series in time, and its inverse.
//!
//! S = Σ t^k S_k(p) solves S_t = H(J_R(∂S/∂p, p)); see Vaquero, Cortés and Martín de Diego,
//! *Symmetry Preservation in Hamiltonian Systems*. The sign is that of the forward flow.

mod chart;
mod error;
mod online;
mod predict;
mod recurrence;

pub use error::{DeriveError, TermLimit};
pub(crate) use predict::PredictorRows;
pub use predict::predictor;
pub use recurrence::{GeneratingSeries, derive};

#[cfg(test)]
mod tests;
