#![doc = include_str!("../README.md")]

mod accuracy;
mod asked;
mod backend;
pub mod check;
mod derivations;
mod derivative;
pub mod emit;
mod engine;
pub mod ensemble;
mod error;
mod grid;
mod inputs;
pub mod lattice;
mod load;
pub mod number;
mod resolution;
pub mod series;
pub mod simulate;
mod velocity;
pub mod verify;

use sha2::{Digest, Sha256};

pub use accuracy::meet_tolerance;
pub use asked::Accuracy;
pub use backend::{Backend, Used};
pub use derivations::Derivations;
pub use derivative::{Adjoint, Changes, Derivatives};
pub use engine::STEEP;
pub use error::RunError;
pub use grid::Grid;
pub use inputs::{inputs_files, inputs_hash};
pub use load::{Derived, System, learned, polynomial, read_given, read_group, read_varying};
pub use velocity::{Instant, velocities};

/// The SHA-256 of a text in hexadecimal digits.
pub fn text_hash(text: &str) -> String {
    format!("{:x}", Sha256::digest(text))
}
