//! Exact Hamilton–Jacobi series of Lie–Poisson systems, lowered to Rust.

pub mod comoving;
pub mod diagnostic;
pub mod emit;
pub mod expr;
pub mod graph;
pub mod hamilton_jacobi;
pub mod integrator;
#[cfg(feature = "judge")]
pub mod judge;
pub mod lie;
pub mod number;
pub mod parse;
pub mod pass;
pub mod poly;
pub mod potential;
pub mod problem;
#[cfg(feature = "system")]
pub mod system;
pub mod tolerance;

#[cfg(feature = "system")]
mod build_script;
#[cfg(feature = "system")]
pub use build_script::{Build, BuildError};
