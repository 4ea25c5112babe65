//! U2: the unitary group of ℂ², as real 4×4 matrices ((A, −B), (B, A)) of A + iB.
//!
//! Written by the test `catalogue` of coadjoint-tests; do not edit.

use crate::table::{BasisEntry, CasimirTerm, StaticAlgebra, StaticMatrixGroup, StructureConstant};
use crate::table::CayleyAlgebra;

/// The group U2: the unitary group of ℂ², as real 4×4 matrices ((A, −B), (B, A)) of A + iB.
///
/// Basis e1, e2, …: E_12 − E_21, i(E_12 + E_21), iE_11, iE_22.
///
/// Brackets (all others are zero):
/// - \[e1, e2\] = 2 e3 − 2 e4
/// - \[e1, e3\] = −e2
/// - \[e1, e4\] = e2
/// - \[e2, e3\] = e1
/// - \[e2, e4\] = −e1
///
/// Casimirs:
/// - μ3 + μ4
/// - μ1^2 + μ2^2 + 2 μ3^2 + 2 μ4^2
///
/// Both charts.
pub type U2<T = f64> = StaticMatrixGroup<U2Algebra, 4, 4, T>;

/// The Lie algebra of [`U2`] as tables.
#[derive(Clone, Copy, Debug)]
pub struct U2Algebra;

impl StaticAlgebra for U2Algebra {
    const DIM: usize = 4;
    const MATRIX_SIZE: usize = 4;
    const STRUCTURE: &'static [StructureConstant] = &[
        (0, 1, 2, 2.0),
        (0, 1, 3, -2.0),
        (0, 2, 1, -1.0),
        (0, 3, 1, 1.0),
        (1, 0, 2, -2.0),
        (1, 0, 3, 2.0),
        (1, 2, 0, 1.0),
        (1, 3, 0, -1.0),
        (2, 0, 1, 1.0),
        (2, 1, 0, -1.0),
        (3, 0, 1, -1.0),
        (3, 1, 0, 1.0),
    ];
    const BASIS: Option<&'static [BasisEntry]> = Some(&[
        (0, 0, 1, 1.0),
        (0, 1, 0, -1.0),
        (0, 2, 3, 1.0),
        (0, 3, 2, -1.0),
        (1, 0, 3, -1.0),
        (1, 1, 2, -1.0),
        (1, 2, 1, 1.0),
        (1, 3, 0, 1.0),
        (2, 0, 2, -1.0),
        (2, 2, 0, 1.0),
        (3, 1, 3, -1.0),
        (3, 3, 1, 1.0),
    ]);
    const CASIMIRS: &'static [&'static [CasimirTerm]] = &[
        &[
            (1.0, &[(2, 1)]),
            (1.0, &[(3, 1)]),
        ],
        &[
            (1.0, &[(0, 2)]),
            (1.0, &[(1, 2)]),
            (2.0, &[(2, 2)]),
            (2.0, &[(3, 2)]),
        ],
    ];
}

impl CayleyAlgebra for U2Algebra {}
