//! Tables in the program text: the group is a zero-sized type and nothing is allocated.

use core::fmt::{self, Debug};
use core::marker::PhantomData;

use nalgebra::SVector;

use super::algebra::{Algebra, BasisEntry, CasimirTerm, Facts, StructureConstant, facts, invert};
use super::domain;
use super::group::TableGroup;
use super::tables::{Tables, monomial};
use crate::group::FixedDimension;
use crate::number::Scalar;

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

/// Costly consequences of the tables, evaluated by the compiler.
struct Derived<const N: usize> {
    facts: Facts,
    gram_inverse: [[f64; N]; N],
    elliptic: [[f64; N]; N],
    cayley: [[f64; N]; N],
}

impl<A: StaticAlgebra, const N: usize, const D: usize, T> StaticTables<A, N, D, T> {
    const SIZES_AGREE: () = {
        assert!(A::DIM == N, "N must be the dimension of the algebra");
        assert!(A::MATRIX_SIZE == D, "D must be the size of the matrices");
        assert!(A::BASIS.is_some() || N == D, "adjoint matrices are as large as the algebra");
    };

    const DERIVED: &'static Derived<N> = &derive::<N, D>(A::BASIS, A::STRUCTURE);

    pub(super) const fn new() -> Self {
        const { Self::SIZES_AGREE };
        Self(PhantomData)
    }
}

const fn derive<const N: usize, const D: usize>(
    basis: Option<&[BasisEntry]>,
    structure: &[StructureConstant],
) -> Derived<N> {
    let [mut gram, mut gram_inverse, mut elliptic, mut cayley] = [[[0.0; N]; N]; 4];
    let (mut dense, mut ad) = ([[0.0; D]; D], [[[0.0; N]; N]; N]);
    let ad = ad.as_flattened_mut().as_flattened_mut();
    let [gram, inverse, room] =
        [gram.as_flattened_mut(), gram_inverse.as_flattened_mut(), cayley.as_flattened_mut()];
    let ideal = domain::elliptic_form(N, structure, ad, room, elliptic.as_flattened_mut());
    let mut facts = facts(structure, basis, (N, D), gram, dense.as_flattened_mut());
    if let Some(entries) = basis {
        domain::cayley_form(N, entries, gram, facts.orthogonal, ideal, room);
    }
    facts.dependent = invert(N, gram, inverse);
    Derived { facts, gram_inverse, elliptic, cayley }
}

impl<A: StaticAlgebra, const N: usize, const D: usize, T: Scalar> Tables
    for StaticTables<A, N, D, T>
{
    type Scalar = T;
    type Vector = SVector<T, N>;
    type Column = SVector<T, D>;

    #[inline(always)]
    fn algebra(&self) -> Algebra<'_> {
        let Derived { facts, gram_inverse, elliptic, cayley } = Self::DERIVED;
        Algebra {
            dim: N,
            size: D,
            structure: A::STRUCTURE,
            basis: A::BASIS,
            facts: *facts,
            gram_inverse: gram_inverse.as_flattened(),
            elliptic: elliptic.as_flattened(),
            cayley: cayley.as_flattened(),
        }
    }

    fn casimir_count(&self) -> usize {
        A::CASIMIRS.len()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let terms = A::CASIMIRS.get(index).copied().unwrap_or_default();
        terms.iter().fold(T::of(0.0), |sum, &(c, factors)| sum + monomial(c, factors, mu))
    }
}

impl<A: CayleyAlgebra, const N: usize, const D: usize, T: Scalar> super::group::CayleyTables
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
