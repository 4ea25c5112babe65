//! Integrators for Hamiltonian systems on Lie groups that conserve momentum and Casimirs exactly.
#![cfg_attr(not(feature = "std"), no_std)]

mod chart;
mod coordinates;
mod error;
mod generating_function;
mod group;
mod phase;
mod reconstruct;
mod scalar;
mod so3;
mod solve;

pub use chart::{Cayley, Chart, Exponential};
pub use coordinates::Coordinates;
pub use error::StepError;
pub use generating_function::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
pub use group::{CayleyGroup, LieGroup};
pub use phase::Phase;
pub use reconstruct::{StepReport, advance, poisson_map};
pub use scalar::Scalar;
pub use so3::SO3;
pub use solve::{MAX_ITERATIONS, Solution, solve};
