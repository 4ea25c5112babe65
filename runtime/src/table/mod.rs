//! Matrix groups given by tables: structure constants, and a matrix basis where one is known.

mod algebra;
mod catalogue;
mod domain;
#[cfg(feature = "alloc")]
mod dynamic;
mod fixed;
mod group;
mod tables;

pub use algebra::{BasisEntry, CasimirTerm, StructureConstant};
pub use catalogue::{
    Aff1, Aff1Algebra, Heisenberg, HeisenbergAlgebra, Rotations, SL2, SL2Algebra, SO4, SO5, SU3,
    SpecialUnitary,
};
#[cfg(feature = "alloc")]
pub use dynamic::{CayleyMatrixGroup, MatrixGroup, TableError};
pub use fixed::{CayleyAlgebra, StaticAlgebra, StaticMatrixGroup};
pub use group::TableGroup;
