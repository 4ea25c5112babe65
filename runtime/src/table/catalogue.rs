//! Groups known by name that have no closed forms here. Their bases are given; the brackets follow from them at
//! compile time. A test compares all with codegen's exact catalogue.

use super::algebra::{BasisEntry, CasimirTerm, StructureConstant};
use super::fixed::{CayleyAlgebra, StaticAlgebra, StaticMatrixGroup};

/// The group SO4: rotations of four-dimensional space, as [`Rotations`]. Both charts.
pub type SO4<T = f64> = StaticMatrixGroup<Rotations<4>, 6, 4, T>;
/// The group SO5: rotations of five-dimensional space, as [`Rotations`]. Both charts.
pub type SO5<T = f64> = StaticMatrixGroup<Rotations<5>, 10, 5, T>;
/// The special unitary group of ℂ³, as [`SpecialUnitary`]. The exponential chart only: xξx leaves the algebra.
pub type SU3<T = f64> = StaticMatrixGroup<SpecialUnitary<3>, 8, 6, T>;
/// The group SL2: real 2×2 matrices of determinant 1. Basis: E_11 − E_22, E_12, E_21. Both charts.
pub type SL2<T = f64> = StaticMatrixGroup<SL2Algebra, 3, 2, T>;
/// The group SE_2(3) of extended poses: a turn, a velocity and a place, as 5×5 matrices ((R, v, p), (0, 1)). Basis: the
/// rotations about the axes, the velocities, the places. Both charts.
pub type SE23<T = f64> = StaticMatrixGroup<SE23Algebra, 9, 5, T>;
/// The group Sp(4, ℝ): real 4×4 matrices that keep the symplectic form of (q, p). Basis: of ((A, B), (C, −Aᵀ)) the four
/// entries of A, then those of the symmetric B and C with a ≤ b. Both charts.
pub type Sp4<T = f64> = StaticMatrixGroup<Sp4Algebra, 10, 4, T>;
/// The group Aff1: affine maps of the line, as 2×2 matrices. Basis: the scaling E_11 and the translation E_12. Both
/// charts; it has no polynomial Casimir.
pub type Aff1<T = f64> = StaticMatrixGroup<Aff1Algebra, 2, 2, T>;
/// The Heisenberg group: upper 3×3 matrices with diagonal 1. Basis: E_12, E_23 and their bracket E_13, the centre. Both
/// charts, which agree, since cubes of the basis' matrices vanish.
pub type Heisenberg<T = f64> = StaticMatrixGroup<HeisenbergAlgebra, 3, 3, T>;

/// 𝔰𝔬(`D`). Basis: E_ba − E_ab for a < b, in lexicographic order.
#[derive(Clone, Copy, Debug)]
pub struct Rotations<const D: usize>;

/// 𝔰𝔲(`N`), as real matrices ((A, −B), (B, A)) of A + iB. Basis: E_ab − E_ba and i(E_ab + E_ba) for a < b in
/// lexicographic order; then i(E_kk − E_k+1,k+1).
#[derive(Clone, Copy, Debug)]
pub struct SpecialUnitary<const N: usize>;

/// The Lie algebra of [`SL2`].
#[derive(Clone, Copy, Debug)]
pub struct SL2Algebra;

/// The Lie algebra of [`SE23`].
#[derive(Clone, Copy, Debug)]
pub struct SE23Algebra;

/// The Lie algebra of [`Sp4`].
#[derive(Clone, Copy, Debug)]
pub struct Sp4Algebra;

/// The Lie algebra of [`Aff1`].
#[derive(Clone, Copy, Debug)]
pub struct Aff1Algebra;

/// The Lie algebra of [`Heisenberg`].
#[derive(Clone, Copy, Debug)]
pub struct HeisenbergAlgebra;

impl<const D: usize> StaticAlgebra for Rotations<D> {
    const DIM: usize = D * (D - 1) / 2;
    const MATRIX_SIZE: usize = D;
    const STRUCTURE: &'static [StructureConstant] = const { &brackets(&rotations(D)) }.entries();
    const BASIS: Option<&'static [BasisEntry]> = Some(const { &rotations(D) }.entries());
    const CASIMIRS: &'static [&'static [CasimirTerm]] = match D {
        4 => &[SQUARES.split_at(6).0, PFAFFIAN],
        _ => &[SQUARES.split_at(Self::DIM).0],
    };
}

impl<const N: usize> StaticAlgebra for SpecialUnitary<N> {
    const DIM: usize = N * N - 1;
    const MATRIX_SIZE: usize = 2 * N;
    const STRUCTURE: &'static [StructureConstant] =
        const { &brackets(&special_unitary(N)) }.entries();
    const BASIS: Option<&'static [BasisEntry]> = Some(const { &special_unitary(N) }.entries());
    const CASIMIRS: &'static [&'static [CasimirTerm]] = match N {
        3 => &[SU3_SQUARES, SU3_CUBES],
        _ => &[],
    };
}

/// The squares of these coordinates.
macro_rules! squares {
    ($($i:literal)*) => { &[$((1.0, &[($i, 2)])),*] };
}

/// The tables of an algebra of fixed size, and that xξx stays in it.
macro_rules! small {
    ($algebra:ident, $dim:literal, $size:literal, $basis:ident, $casimirs:expr) => {
        impl StaticAlgebra for $algebra {
            const DIM: usize = $dim;
            const MATRIX_SIZE: usize = $size;
            const STRUCTURE: &'static [StructureConstant] = const { &brackets(&$basis) }.entries();
            const BASIS: Option<&'static [BasisEntry]> = Some($basis.entries());
            const CASIMIRS: &'static [&'static [CasimirTerm]] = $casimirs;
        }

        impl CayleyAlgebra for $algebra {}
    };
}

small!(SL2Algebra, 3, 2, SL2_BASIS, &[&[(1.0, &[(0, 2)]), (4.0, &[(1, 1), (2, 1)])]]);
small!(SE23Algebra, 9, 5, SE23_BASIS, &[squares!(3 4 5), GRAM, squares!(6 7 8)]);
small!(Sp4Algebra, 10, 4, SP4_BASIS, &[SP4_SQUARES]);
small!(Aff1Algebra, 2, 2, AFF1_BASIS, &[]);
small!(HeisenbergAlgebra, 3, 3, HEISENBERG_BASIS, &[&[(1.0, &[(2, 1)])]]);

impl<const D: usize> CayleyAlgebra for Rotations<D> {}

static SL2_BASIS: Entries =
    Entries::EMPTY.with(0, 0, 0, 1.0).with(0, 1, 1, -1.0).with(1, 0, 1, 1.0).with(2, 1, 0, 1.0);

static SE23_BASIS: Entries = Entries::EMPTY
    .with(0, 2, 1, 1.0)
    .with(0, 1, 2, -1.0)
    .with(1, 0, 2, 1.0)
    .with(1, 2, 0, -1.0)
    .with(2, 1, 0, 1.0)
    .with(2, 0, 1, -1.0)
    .with(3, 0, 3, 1.0)
    .with(4, 1, 3, 1.0)
    .with(5, 2, 3, 1.0)
    .with(6, 0, 4, 1.0)
    .with(7, 1, 4, 1.0)
    .with(8, 2, 4, 1.0);

static SP4_BASIS: Entries = Entries::EMPTY
    .with(0, 0, 0, 1.0)
    .with(0, 2, 2, -1.0)
    .with(1, 0, 1, 1.0)
    .with(1, 3, 2, -1.0)
    .with(2, 1, 0, 1.0)
    .with(2, 2, 3, -1.0)
    .with(3, 1, 1, 1.0)
    .with(3, 3, 3, -1.0)
    .with(4, 0, 2, 1.0)
    .with(5, 0, 3, 1.0)
    .with(5, 1, 2, 1.0)
    .with(6, 1, 3, 1.0)
    .with(7, 2, 0, 1.0)
    .with(8, 2, 1, 1.0)
    .with(8, 3, 0, 1.0)
    .with(9, 3, 1, 1.0);

static AFF1_BASIS: Entries = Entries::EMPTY.with(0, 0, 0, 1.0).with(1, 0, 1, 1.0);

static HEISENBERG_BASIS: Entries =
    Entries::EMPTY.with(0, 0, 1, 1.0).with(1, 1, 2, 1.0).with(2, 0, 2, 1.0);

/// Room for the structure constants of any table here; a larger one does not compile.
const CAPACITY: usize = 96;
/// Room for the matrices of SU3.
const MAX_SIZE: usize = 6;

struct Entries {
    all: [(usize, usize, usize, f64); CAPACITY],
    len: usize,
}

impl Entries {
    const EMPTY: Self = Self { all: [(0, 0, 0, 0.0); CAPACITY], len: 0 };

    const fn with(mut self, i: usize, j: usize, k: usize, value: f64) -> Self {
        self.all[self.len] = (i, j, k, value);
        self.len += 1;
        self
    }

    const fn entries(&self) -> &[(usize, usize, usize, f64)] {
        self.all.split_at(self.len).0
    }
}

const fn rotations(size: usize) -> Entries {
    let (mut basis, mut i, mut a) = (Entries::EMPTY, 0, 0);
    while a < size {
        let mut b = a + 1;
        while b < size {
            basis = basis.with(i, a, b, -1.0).with(i, b, a, 1.0);
            (i, b) = (i + 1, b + 1);
        }
        a += 1;
    }
    basis
}

const fn special_unitary(n: usize) -> Entries {
    let (mut basis, mut i, mut a) = (Entries::EMPTY, 0, 0);
    while a < n {
        let mut b = a + 1;
        while b < n {
            basis = basis.with(i, a, b, 1.0).with(i, b, a, -1.0);
            basis = basis.with(i, n + a, n + b, 1.0).with(i, n + b, n + a, -1.0);
            basis = basis.with(i + 1, a, n + b, -1.0).with(i + 1, b, n + a, -1.0);
            basis = basis.with(i + 1, n + a, b, 1.0).with(i + 1, n + b, a, 1.0);
            (i, b) = (i + 2, b + 1);
        }
        a += 1;
    }
    let mut k = 0;
    while k + 1 < n {
        basis = basis.with(i, k, n + k, -1.0).with(i, n + k, k, 1.0);
        basis = basis.with(i, k + 1, n + k + 1, 1.0).with(i, n + k + 1, k + 1, -1.0);
        (i, k) = (i + 1, k + 1);
    }
    basis
}

/// The structure constants of a basis in which the first entry of each matrix is zero in all that follow it.
const fn brackets(basis: &Entries) -> Entries {
    let dim = basis.all[basis.len - 1].0 + 1;
    let (mut structure, mut i) = (Entries::EMPTY, 0);
    while i < dim * dim {
        let (first, second) = (i / dim, i % dim);
        let (mut rest, mut a) = ([[0.0; MAX_SIZE]; MAX_SIZE], 0);
        while a < basis.len {
            let (index, row, inner, value) = basis.all[a];
            let mut b = if index == first { 0 } else { basis.len };
            while b < basis.len {
                let (index, other, column, factor) = basis.all[b];
                if index == second && inner == other {
                    rest[row][column] += value * factor;
                }
                if index == second && column == row {
                    rest[other][inner] -= factor * value;
                }
                b += 1;
            }
            a += 1;
        }
        let (mut coordinate, mut at) = (0.0, 0);
        while at < basis.len {
            let (k, row, column, value) = basis.all[at];
            if at == 0 || basis.all[at - 1].0 != k {
                coordinate = rest[row][column] / value;
                if coordinate != 0.0 {
                    structure = structure.with(first, second, k, coordinate);
                }
            }
            rest[row][column] -= coordinate * value;
            at += 1;
        }
        i += 1;
    }
    structure
}

/// The square of the momentum: of 𝔰𝔬(5), and its beginning of 𝔰𝔬(4).
const SQUARES: &[CasimirTerm] = squares!(0 1 2 3 4 5 6 7 8 9);

/// The second Casimir of 𝔰𝔬(4).
const PFAFFIAN: &[CasimirTerm] =
    &[(1.0, &[(0, 1), (5, 1)]), (-1.0, &[(1, 1), (4, 1)]), (1.0, &[(2, 1), (3, 1)])];

/// The inner product of the momenta of velocity and place.
const GRAM: &[CasimirTerm] =
    &[(1.0, &[(3, 1), (6, 1)]), (1.0, &[(4, 1), (7, 1)]), (1.0, &[(5, 1), (8, 1)])];

/// A_11² + A_22² + 2 A_12 A_21 + 4 B_11 C_11 + 2 B_12 C_12 + 4 B_22 C_22 of the momenta.
const SP4_SQUARES: &[CasimirTerm] = &[
    (1.0, &[(0, 2)]),
    (2.0, &[(1, 1), (2, 1)]),
    (1.0, &[(3, 2)]),
    (4.0, &[(4, 1), (7, 1)]),
    (2.0, &[(5, 1), (8, 1)]),
    (4.0, &[(6, 1), (9, 1)]),
];

const SU3_SQUARES: &[CasimirTerm] = &[
    (3.0, &[(0, 2)]),
    (3.0, &[(1, 2)]),
    (3.0, &[(2, 2)]),
    (3.0, &[(3, 2)]),
    (3.0, &[(4, 2)]),
    (3.0, &[(5, 2)]),
    (4.0, &[(6, 2)]),
    (4.0, &[(6, 1), (7, 1)]),
    (4.0, &[(7, 2)]),
];

const SU3_CUBES: &[CasimirTerm] = &[
    (9.0, &[(0, 2), (6, 1)]),
    (18.0, &[(0, 2), (7, 1)]),
    (27.0, &[(0, 1), (2, 1), (5, 1)]),
    (-27.0, &[(0, 1), (3, 1), (4, 1)]),
    (9.0, &[(1, 2), (6, 1)]),
    (18.0, &[(1, 2), (7, 1)]),
    (27.0, &[(1, 1), (2, 1), (4, 1)]),
    (27.0, &[(1, 1), (3, 1), (5, 1)]),
    (9.0, &[(2, 2), (6, 1)]),
    (-9.0, &[(2, 2), (7, 1)]),
    (9.0, &[(3, 2), (6, 1)]),
    (-9.0, &[(3, 2), (7, 1)]),
    (-18.0, &[(4, 2), (6, 1)]),
    (-9.0, &[(4, 2), (7, 1)]),
    (-18.0, &[(5, 2), (6, 1)]),
    (-9.0, &[(5, 2), (7, 1)]),
    (8.0, &[(6, 3)]),
    (12.0, &[(6, 2), (7, 1)]),
    (-12.0, &[(6, 1), (7, 2)]),
    (-8.0, &[(7, 3)]),
];
