//! SO4: rotations of four-dimensional space.
//!
//! Written by the test `catalogue` of coadjoint-tests; do not edit.

use crate::table::{BasisEntry, CasimirTerm, StaticAlgebra, StaticMatrixGroup, StructureConstant};
use crate::table::CayleyAlgebra;

/// The group SO4: rotations of four-dimensional space.
///
/// Basis e1, e2, …: E_ba − E_ab for a < b, in lexicographic order.
///
/// Brackets (all others are zero):
/// - \[e1, e2\] = e4
/// - \[e1, e3\] = e5
/// - \[e1, e4\] = −e2
/// - \[e1, e5\] = −e3
/// - \[e2, e3\] = e6
/// - \[e2, e4\] = e1
/// - \[e2, e6\] = −e3
/// - \[e3, e5\] = e1
/// - \[e3, e6\] = e2
/// - \[e4, e5\] = e6
/// - \[e4, e6\] = −e5
/// - \[e5, e6\] = e4
///
/// Casimirs:
/// - μ1^2 + μ2^2 + μ3^2 + μ4^2 + μ5^2 + μ6^2
/// - μ1 μ6 − μ2 μ5 + μ3 μ4
///
/// Both charts.
pub type SO4<T = f64> = StaticMatrixGroup<SO4Algebra, 6, 4, T>;

/// The Lie algebra of [`SO4`] as tables.
#[derive(Clone, Copy, Debug)]
pub struct SO4Algebra;

impl StaticAlgebra for SO4Algebra {
    const DIM: usize = 6;
    const MATRIX_SIZE: usize = 4;
    const STRUCTURE: &'static [StructureConstant] = &[
        (0, 1, 3, 1.0),
        (0, 2, 4, 1.0),
        (0, 3, 1, -1.0),
        (0, 4, 2, -1.0),
        (1, 0, 3, -1.0),
        (1, 2, 5, 1.0),
        (1, 3, 0, 1.0),
        (1, 5, 2, -1.0),
        (2, 0, 4, -1.0),
        (2, 1, 5, -1.0),
        (2, 4, 0, 1.0),
        (2, 5, 1, 1.0),
        (3, 0, 1, 1.0),
        (3, 1, 0, -1.0),
        (3, 4, 5, 1.0),
        (3, 5, 4, -1.0),
        (4, 0, 2, 1.0),
        (4, 2, 0, -1.0),
        (4, 3, 5, -1.0),
        (4, 5, 3, 1.0),
        (5, 1, 2, 1.0),
        (5, 2, 1, -1.0),
        (5, 3, 4, 1.0),
        (5, 4, 3, -1.0),
    ];
    const BASIS: Option<&'static [BasisEntry]> = Some(&[
        (0, 0, 1, -1.0),
        (0, 1, 0, 1.0),
        (1, 0, 2, -1.0),
        (1, 2, 0, 1.0),
        (2, 0, 3, -1.0),
        (2, 3, 0, 1.0),
        (3, 1, 2, -1.0),
        (3, 2, 1, 1.0),
        (4, 1, 3, -1.0),
        (4, 3, 1, 1.0),
        (5, 2, 3, -1.0),
        (5, 3, 2, 1.0),
    ]);
    const CASIMIRS: &'static [&'static [CasimirTerm]] = &[
        &[
            (1.0, &[(0, 2)]),
            (1.0, &[(1, 2)]),
            (1.0, &[(2, 2)]),
            (1.0, &[(3, 2)]),
            (1.0, &[(4, 2)]),
            (1.0, &[(5, 2)]),
        ],
        &[
            (1.0, &[(0, 1), (5, 1)]),
            (-1.0, &[(1, 1), (4, 1)]),
            (1.0, &[(2, 1), (3, 1)]),
        ],
    ];
}

impl CayleyAlgebra for SO4Algebra {}
