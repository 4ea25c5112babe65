//! All groups: closed forms, products, and groups given by tables; and what a group of one's own implements.
//!
//! | group | elements | dimension |
//! |---|---|---|
//! | [`SO3`], [`SU2`] | unit quaternions | 3 |
//! | [`SE2`], [`SE3`] | rotation and translation | 3, 6 |
//! | [`SO4`], [`SO5`], [`SU3`], [`SL2`], [`Aff1`], [`Heisenberg`] | matrices | 2 to 10 |
//! | [`Product`], [`Power`], `DirectProduct` | those of the factors | the sum |
//! | [`StaticMatrixGroup`], `MatrixGroup` | matrices of any algebra you give | any |

pub use crate::chart::{Cayley, Chart, Exponential};
pub use crate::group::element_error::ElementError;
#[cfg(feature = "alloc")]
pub use crate::group::product::DirectProduct;
pub use crate::group::product::{Power, Product};
pub use crate::group::so3::{Quaternions, SO3, SU2};
pub use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
pub use crate::group::{se2::SE2, se3::SE3};
pub use crate::linear::coordinates::Coordinates;
pub use crate::table::{
    Aff1, Aff1Algebra, BasisEntry, CasimirTerm, CayleyAlgebra, Heisenberg, HeisenbergAlgebra,
    Rotations, SL2, SL2Algebra, SO4, SO5, SU3, SpecialUnitary, StaticAlgebra, StaticMatrixGroup,
    StructureConstant, TableGroup,
};
#[cfg(feature = "alloc")]
pub use crate::table::{CayleyMatrixGroup, MatrixGroup, TableError};
