//! Lie algebras over ℚ and the charts of their groups.

mod algebra;
mod casimir;
pub mod catalogue;
mod chart;
mod elimination;
mod error;
mod factors;
mod field;
mod matrix;
mod nilpotent;
mod product;
mod span;

pub use algebra::{LieAlgebra, StructureConstant};
pub use casimir::{CasimirError, casimirs, watched_casimirs};
pub use chart::{Chart, ChartError};
pub use error::LieAlgebraError;
pub use matrix::RationalMatrix;

pub(crate) use chart::{CubicEntry, cubic};
pub(crate) use elimination::Echelon;
pub(crate) use product::symmetric_square;
pub(crate) use span::Span;
