//! Integrators for Hamiltonian systems on Lie groups that conserve momentum and Casimirs exactly.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "alloc")]
extern crate alloc;

mod chart;
mod compensated;
mod coordinates;
mod element_error;
#[cfg(feature = "ensemble")]
pub mod ensemble;
mod error;
mod generating_function;
mod group;
mod lanes;
mod phase;
#[doc(hidden)]
pub mod plumbing;
mod reconstruct;
mod scalar;
mod se3;
mod so3;
mod solve;
mod table;

pub use nalgebra;

pub use chart::{Cayley, Chart, Exponential};
pub use compensated::{CompensatedGroup, CompensatedPhase, advance_compensated};
pub use coordinates::Coordinates;
pub use element_error::ElementError;
pub use error::StepError;
pub use generating_function::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
pub use group::{CayleyGroup, LieGroup};
pub use lanes::{F64x4, F64x8, LaneGroup, Lanes};
pub use phase::Phase;
pub use reconstruct::{StepReport, advance, poisson_map};
pub use scalar::Scalar;
pub use se3::SE3;
pub use so3::SO3;
pub use solve::{MAX_ITERATIONS, Solution, solve};
pub use table::{
    BasisEntry, CasimirTerm, CayleyAlgebra, CayleyTables, StaticAlgebra, StaticMatrixGroup,
    StaticTables, StructureConstant, TableGroup, Tables,
};
#[cfg(feature = "alloc")]
pub use table::{CayleyMatrixGroup, DynamicTables, MatrixGroup, TableError, Terms};
