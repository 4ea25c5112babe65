//! SL2: real 2×2 matrices of determinant 1.
//!
//! Written by the test `catalogue` of coadjoint-tests; do not edit.

use crate::table::{BasisEntry, CasimirTerm, StaticAlgebra, StaticMatrixGroup, StructureConstant};
use crate::table::CayleyAlgebra;

/// The group SL2: real 2×2 matrices of determinant 1.
///
/// Basis e1, e2, …: E_11 − E_22, E_12, E_21.
///
/// Brackets (all others are zero):
/// - \[e1, e2\] = 2 e2
/// - \[e1, e3\] = −2 e3
/// - \[e2, e3\] = e1
///
/// Casimirs:
/// - μ1^2 + 4 μ2 μ3
///
/// Both charts.
pub type SL2<T = f64> = StaticMatrixGroup<SL2Algebra, 3, 2, T>;

/// The Lie algebra of [`SL2`] as tables.
#[derive(Clone, Copy, Debug)]
pub struct SL2Algebra;

impl StaticAlgebra for SL2Algebra {
    const DIM: usize = 3;
    const MATRIX_SIZE: usize = 2;
    const STRUCTURE: &'static [StructureConstant] = &[
        (0, 1, 1, 2.0),
        (0, 2, 2, -2.0),
        (1, 0, 1, -2.0),
        (1, 2, 0, 1.0),
        (2, 0, 2, 2.0),
        (2, 1, 0, -1.0),
    ];
    const BASIS: Option<&'static [BasisEntry]> = Some(&[
        (0, 0, 0, 1.0),
        (0, 1, 1, -1.0),
        (1, 0, 1, 1.0),
        (2, 1, 0, 1.0),
    ]);
    const CASIMIRS: &'static [&'static [CasimirTerm]] = &[
        &[
            (1.0, &[(0, 2)]),
            (4.0, &[(1, 1), (2, 1)]),
        ],
    ];
}

impl CayleyAlgebra for SL2Algebra {}
