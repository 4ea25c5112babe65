//! True flows to make data from: Hamiltonians, their exact flow to rounding, seeded samples.

mod flow;
mod hamiltonian;
mod one_step;
mod sample;

pub use flow::{exact_flow, exact_momentum_flow};
pub use hamiltonian::{Bump, Quadratic, Quartic, Relativistic};
pub use one_step::OneStep;
pub use sample::{MomentumBox, add_noise, momentum_pairs, phase_pairs};
