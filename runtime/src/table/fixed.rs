//! Tables in the program text: the group is a zero-sized type and nothing is allocated.

use core::fmt::{self, Debug};
use core::marker::PhantomData;

use nalgebra::SVector;

use super::algebra::{BasisEntry, CasimirTerm, StructureConstant, Tables, monomial};
use super::domain;
use super::group::TableGroup;
use crate::group::FixedDimension;
use crate::number::scalar::Scalar;

/// A Lie algebra written down in the program, for [`StaticMatrixGroup`]. Generated code implements
/// it for a marker type.
pub trait StaticAlgebra: 'static {
    /// n, the dimension.
    const DIM: usize;
    /// d, the size of the matrices; n where [`StaticAlgebra::BASIS`] is `None`.
    const MATRIX_SIZE: usize;
    /// Every non-zero structure constant (i, j, k, c): [eᵢ, eⱼ] contains c·eₖ.
    const STRUCTURE: &'static [StructureConstant];
    /// The non-zero entries (i, row, column, value) of the basis matrices; `None` where only the
    /// brackets are known, and the group is then that of adjoint matrices.
    const BASIS: Option<&'static [BasisEntry]>;
    /// The Casimirs, each a list of terms.
    const CASIMIRS: &'static [&'static [CasimirTerm]];
}

/// States that x, ξ ∈ 𝔤 implies xξx ∈ 𝔤, so that the Cayley map stays in the group. Whoever
/// implements it has checked that (codegen does, exactly).
pub trait CayleyAlgebra: StaticAlgebra {}

/// The tables of a [`StaticAlgebra`] of dimension `N` with matrices of size `D`.
pub struct StaticTables<A, const N: usize, const D: usize, T = f64>(PhantomData<(A, T)>);

/// The group of a [`StaticAlgebra`] of dimension `N` with matrices of size `D`; no allocation,
/// any [`Scalar`].
///
/// ```
/// use coadjoint::{LieGroup, groups::StaticAlgebra, groups::StaticMatrixGroup};
/// use nalgebra::Vector2;
///
/// /// The affine group of the line: [a, b] = b.
/// struct Affine;
/// impl StaticAlgebra for Affine {
///     const DIM: usize = 2;
///     const MATRIX_SIZE: usize = 2;
///     const STRUCTURE: &'static [(usize, usize, usize, f64)] = &[(0, 1, 1, 1.0), (1, 0, 1, -1.0)];
///     const BASIS: Option<&'static [(usize, usize, usize, f64)]> =
///         Some(&[(0, 0, 0, 1.0), (1, 0, 1, 1.0)]);
///     const CASIMIRS: &'static [&'static [(f64, &'static [(usize, u32)])]] = &[];
/// }
///
/// let group = StaticMatrixGroup::<Affine, 2, 2>::new();
/// let g = group.exp(&Vector2::new(0.0, 3.0));
/// assert_eq!(g[(0, 1)], 3.0);
/// ```
pub type StaticMatrixGroup<A, const N: usize, const D: usize, T = f64> =
    TableGroup<StaticTables<A, N, D, T>>;

impl<A, const N: usize, const D: usize, T> Clone for StaticTables<A, N, D, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A, const N: usize, const D: usize, T> Copy for StaticTables<A, N, D, T> {}

impl<A, const N: usize, const D: usize, T> Debug for StaticTables<A, N, D, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("StaticTables")
    }
}

/// Facts that follow from a matrix basis and are costly: evaluated by the compiler.
struct Derived<const N: usize> {
    gram_inverse: [[f64; N]; N],
    diagonal: bool,
    faithful: bool,
    orthogonal: bool,
    traceless: bool,
    /// Quadratic forms that bound eigenvalues: see `domain`.
    elliptic: [[f64; N]; N],
    cayley: [[f64; N]; N],
}

impl<A: StaticAlgebra, const N: usize, const D: usize, T> StaticTables<A, N, D, T> {
    const SIZES_AGREE: () = {
        assert!(A::DIM == N, "N must be the dimension of the algebra");
        assert!(A::MATRIX_SIZE == D, "D must be the size of the matrices");
        assert!(A::BASIS.is_some() || N == D, "adjoint matrices are as large as the algebra");
    };

    const DERIVED: Derived<N> = derive::<N, D>(A::BASIS, A::STRUCTURE);

    pub(super) const fn new() -> Self {
        const { Self::SIZES_AGREE };
        Self(PhantomData)
    }
}

/// Entry number `index` of the matrices in use: of the basis, or adjoint, (ad_i)ₖⱼ = cᵢⱼᵏ.
const fn entry(
    basis: Option<&[BasisEntry]>,
    structure: &[StructureConstant],
    index: usize,
) -> Option<BasisEntry> {
    match basis {
        Some(entries) if index < entries.len() => Some(entries[index]),
        None if index < structure.len() => {
            let (i, j, k, c) = structure[index];
            Some((i, k, j, c))
        }
        _ => None,
    }
}

const fn derive<const N: usize, const D: usize>(
    basis: Option<&[BasisEntry]>,
    structure: &[StructureConstant],
) -> Derived<N> {
    let mut gram = [[0.0; N]; N];
    let (mut orthogonal, mut traceless) = (true, true);
    let mut i = 0;
    while i < N {
        let mut dense = [[0.0; D]; D];
        let mut at = 0;
        while let Some((index, row, column, value)) = entry(basis, structure, at) {
            if index == i {
                dense[row][column] += value;
            }
            at += 1;
        }
        at = 0;
        while let Some((index, row, column, value)) = entry(basis, structure, at) {
            gram[i][index] += dense[row][column] * value;
            at += 1;
        }
        let mut trace = 0.0;
        let mut row = 0;
        while row < D {
            trace += dense[row][row];
            let mut column = 0;
            while column < D {
                orthogonal = orthogonal && dense[row][column] == -dense[column][row];
                column += 1;
            }
            row += 1;
        }
        traceless = traceless && trace == 0.0;
        i += 1;
    }
    let mut diagonal = true;
    let mut j = 0;
    while j < N * N {
        diagonal = diagonal && (j / N == j % N || gram[j / N][j % N] == 0.0);
        j += 1;
    }
    let (gram_inverse, faithful) = invert(gram);
    let mut ad = [[[0.0; N]; N]; N];
    let (mut elliptic, mut cayley) = ([[0.0; N]; N], [[0.0; N]; N]);
    let flat = ad.as_flattened_mut().as_flattened_mut();
    let ideal = domain::elliptic_form(N, structure, flat, elliptic.as_flattened_mut());
    if let Some(entries) = basis {
        domain::cayley_form(N, entries, orthogonal, ideal, cayley.as_flattened_mut());
    } else {
        // The adjoint matrices themselves.
        cayley = elliptic;
    }
    Derived { gram_inverse, diagonal, faithful, orthogonal, traceless, elliptic, cayley }
}

/// The inverse of a Gram matrix, and whether there is one. A Gram matrix needs no pivoting.
const fn invert<const N: usize>(mut a: [[f64; N]; N]) -> ([[f64; N]; N], bool) {
    let mut b = [[0.0; N]; N];
    let mut k = 0;
    while k < N {
        b[k][k] = 1.0;
        k += 1;
    }
    k = 0;
    while k < N {
        // Entries are of order one: a pivot this small is zero up to rounding.
        if a[k][k] < 1e-12 {
            return (b, false);
        }
        let inverse = 1.0 / a[k][k];
        let mut j = 0;
        while j < N {
            a[k][j] *= inverse;
            b[k][j] *= inverse;
            j += 1;
        }
        let mut i = 0;
        while i < N {
            let factor = a[i][k];
            if i != k && factor != 0.0 {
                j = 0;
                while j < N {
                    a[i][j] -= factor * a[k][j];
                    b[i][j] -= factor * b[k][j];
                    j += 1;
                }
            }
            i += 1;
        }
        k += 1;
    }
    (b, true)
}

impl<A: StaticAlgebra, const N: usize, const D: usize, T: Scalar> Tables
    for StaticTables<A, N, D, T>
{
    type Scalar = T;
    type Vector = SVector<T, N>;
    type Column = SVector<T, D>;

    #[inline(always)]
    fn dim(&self) -> usize {
        N
    }

    #[inline(always)]
    fn matrix_size(&self) -> usize {
        D
    }

    #[inline(always)]
    fn structure(&self) -> &[StructureConstant] {
        A::STRUCTURE
    }

    #[inline(always)]
    fn basis(&self) -> Option<&[BasisEntry]> {
        A::BASIS
    }

    #[inline(always)]
    fn gram_inverse(&self, i: usize, j: usize) -> f64 {
        let derived: &'static Derived<N> = &Self::DERIVED;
        derived.gram_inverse[i][j]
    }

    #[inline(always)]
    fn gram_is_diagonal(&self) -> bool {
        Self::DERIVED.diagonal
    }

    #[inline(always)]
    fn is_faithful(&self) -> bool {
        Self::DERIVED.faithful
    }

    #[inline(always)]
    fn is_orthogonal(&self) -> bool {
        Self::DERIVED.orthogonal
    }

    #[inline(always)]
    fn is_traceless(&self) -> bool {
        Self::DERIVED.traceless
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        let derived: &'static Derived<N> = &Self::DERIVED;
        domain::exp_extent(derived.elliptic.as_flattened(), N, x)
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        let derived: &'static Derived<N> = &Self::DERIVED;
        domain::cayley_extent(derived.cayley.as_flattened(), N, x)
    }

    fn casimir_count(&self) -> usize {
        A::CASIMIRS.len()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let mut sum = T::of(0.0);
        for &(c, factors) in A::CASIMIRS.get(index).copied().unwrap_or_default() {
            sum += monomial(c, factors, mu);
        }
        sum
    }
}

impl<A: CayleyAlgebra, const N: usize, const D: usize, T: Scalar> super::cayley::CayleyTables
    for StaticTables<A, N, D, T>
{
}

impl<A, const N: usize, const D: usize, T> Default for StaticTables<A, N, D, T>
where
    A: StaticAlgebra,
{
    fn default() -> Self {
        Self::new()
    }
}

impl<A: StaticAlgebra, const N: usize, const D: usize, T> TableGroup<StaticTables<A, N, D, T>> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self { tables: StaticTables::new() }
    }
}

impl<A, const N: usize, const D: usize, T> FixedDimension for TableGroup<StaticTables<A, N, D, T>> {
    const DIM: usize = N;
}
