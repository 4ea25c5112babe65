//! Lie algebras over ℚ and the charts of their groups.

mod algebra;
mod casimir;
pub mod catalogue;
mod chart;
mod elimination;
mod factors;
mod matrix;

pub use algebra::{LieAlgebra, LieAlgebraError, StructureConstant};
pub use casimir::{CasimirError, casimirs, watched_casimirs};
pub use chart::{Chart, ChartError};
pub use matrix::RationalMatrix;

pub(crate) use chart::{CubicEntry, cubic};
pub(crate) use elimination::{Echelon, Span, null_space};
pub(crate) use factors::symmetric_square;
