//! All groups: closed forms, products, and groups given by tables; and what a group of one's own implements.
//!
//! | group | elements | dimension |
//! |---|---|---|
//! | [`SO3`], [`SU2`] | unit quaternions | 3 |
//! | [`SE2`], [`SE3`] | rotation and translation | 3, 6 |
//! | [`SO4`], [`SO5`], [`SU3`], [`SL2`], [`Sp4`], [`SE23`], [`Aff1`], [`Heisenberg`] | matrices | 2 to 10 |
//! | [`Product`], [`Power`], `DirectProduct` | those of the factors | the sum |
//! | [`StaticMatrixGroup`], `MatrixGroup` | matrices of any algebra you give | any |

pub use crate::chart::{Cayley, Chart, Exponential};
#[cfg(feature = "alloc")]
pub use crate::group::product::row::DirectProduct;
pub use crate::group::{
    CayleyGroup, FixedDimension, LieGroup, Rows,
    closed::{Closed, Formulas},
    element_error::ElementError,
    product::{pair::Product, row::Power},
    se2::SE2,
    se3::SE3,
    so3::{SO3, SU2},
};
pub use crate::linear::coordinates::Coordinates;
#[cfg(feature = "alloc")]
pub use crate::table::dynamic::{CayleyMatrixGroup, MatrixGroup, TableError};
pub use crate::table::{
    algebra::{BasisEntry, CasimirTerm, StructureConstant},
    catalogue::{
        Aff1, Aff1Algebra, Heisenberg, HeisenbergAlgebra, Rotations, SE23, SE23Algebra, SL2,
        SL2Algebra, SO4, SO5, SU3, Sp4, Sp4Algebra, SpecialUnitary,
    },
    fixed::{CayleyAlgebra, StaticAlgebra, StaticMatrixGroup},
    group::TableGroup,
};
