//! Aff1: affine maps of the line, as 2×2 matrices.
//!
//! Written by the test `catalogue` of coadjoint-tests; do not edit.

use crate::table::{BasisEntry, CasimirTerm, StaticAlgebra, StaticMatrixGroup, StructureConstant};
use crate::table::CayleyAlgebra;

/// The group Aff1: affine maps of the line, as 2×2 matrices.
///
/// Basis e1, e2, …: the scaling E_11 and the translation E_12.
///
/// Brackets (all others are zero):
/// - \[e1, e2\] = e2
///
/// It has no polynomial Casimir.
///
/// Both charts.
pub type Aff1<T = f64> = StaticMatrixGroup<Aff1Algebra, 2, 2, T>;

/// The Lie algebra of [`Aff1`] as tables.
#[derive(Clone, Copy, Debug)]
pub struct Aff1Algebra;

impl StaticAlgebra for Aff1Algebra {
    const DIM: usize = 2;
    const MATRIX_SIZE: usize = 2;
    const STRUCTURE: &'static [StructureConstant] = &[
        (0, 1, 1, 1.0),
        (1, 0, 1, -1.0),
    ];
    const BASIS: Option<&'static [BasisEntry]> = Some(&[
        (0, 0, 0, 1.0),
        (1, 0, 1, 1.0),
    ]);
    const CASIMIRS: &'static [&'static [CasimirTerm]] = &[
    ];
}

impl CayleyAlgebra for Aff1Algebra {}
