//! Matrix groups given by tables: structure constants, and a matrix basis where one is known.

mod action;
mod algebra;
mod cayley;
#[cfg(feature = "alloc")]
mod dynamic;
mod fixed;
mod group;
#[cfg(feature = "alloc")]
mod lanes;
mod linear;
mod logarithm;
mod membership;

pub use algebra::{BasisEntry, CasimirTerm, StructureConstant, Tables};
pub use cayley::CayleyTables;
#[cfg(feature = "alloc")]
pub use dynamic::{CayleyMatrixGroup, DynamicTables, MatrixGroup, TableError, Terms};
pub use fixed::{CayleyAlgebra, StaticAlgebra, StaticMatrixGroup, StaticTables};
pub use group::TableGroup;
#[cfg(feature = "alloc")]
pub use lanes::DynamicLaneTables;
