//! Derives the generating functions of Lie–Poisson systems in exact rational arithmetic, and writes integrators
//! in Rust.
//!
//! The exact half, from arithmetic to the programs of a step, is `coadjoint-symbolic`, whose modules are here under the same
//! names. A front end reads a system: [`parse`] from text or from the tokens of a Rust function, `system` from a file. It
//! becomes a [`problem::Problem`], from which [`integrator`] builds programs and a table of coefficients, [`emit`]
//! writes Rust, and [`graph`] interprets. Most crates do this with the attribute of the crate `coadjoint`, or in a build
//! script, where [`Build`] writes the integrator of a system file as a module:
//!
//! ```toml
//! [dependencies]
//! coadjoint = "0.2"
//!
//! [build-dependencies]
//! coadjoint-codegen = "0.2"
//! ```
//!
//! # Limits
//!
//! A Hamiltonian with a series is a polynomial in the momentum with rational coefficients or opaque symbols; others become
//! programs ([`smooth::Smooth`]), as [`parse::rust::hamiltonian`] reads them. A derivation
//! that would exceed its [`hamilton_jacobi::TermLimit`] stops with an error.
//!
//! # Features
//!
//! `system` (default): reading system files in TOML, with [`Build`] and the module [`system`]. With
//! `default-features = false` neither is there, unless the dependency says `features = ["system"]`.

pub mod diagnostic;
pub mod emit;
pub mod expr;
#[cfg(feature = "system")]
pub mod file;
pub mod parse;
mod pass;
#[cfg(feature = "system")]
pub mod system;

#[cfg(feature = "system")]
mod build_script;
#[cfg(feature = "system")]
pub use build_script::{Build, BuildError};

pub use pass::in_other_frame;

/// Steps judged in doubled precision, independently of the runtime.
#[cfg(feature = "judge")]
pub use coadjoint_symbolic::judge;
pub use coadjoint_symbolic::{
    cancel, comoving, drive, graph, hamilton_jacobi, integrator, lie, number, poly, potential,
    problem, signal, smooth, step, tolerance,
};
