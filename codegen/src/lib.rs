//! Exact Hamilton–Jacobi series of Lie–Poisson systems, lowered to Rust.
//!
//! Most people use this crate through the attribute `coadjoint::lie_poisson`, or in a build script,
//! where [`Build`] writes the integrator of a system file as a module:
//!
//! ```toml
//! [dependencies]
//! coadjoint = "0.1"
//!
//! [build-dependencies]
//! coadjoint-codegen = "0.1"
//! ```
//!
//! # Features
//!
//! `system` (default): reading system files in TOML, with [`Build`] and the module [`system`]. With
//! `default-features = false` neither is there, unless the dependency says `features = ["system"]`.

pub mod comoving;
pub mod diagnostic;
pub mod emit;
pub mod expr;
pub mod graph;
pub mod hamilton_jacobi;
pub mod integrator;
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
