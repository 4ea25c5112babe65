//! Groups in closed form: the formulas of `geometry`, whose arrays are vectors, rows of nodes and elements of nalgebra here.

use core::fmt::Debug;
use core::marker::PhantomData;

use coadjoint_geometry::angle::Length;
use coadjoint_geometry::group::Group;
use coadjoint_geometry::row::Tuple;
use nalgebra::SVector;

use crate::group::element_error::{ElementError, finite};
use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
use crate::number::Scalar;

/// The formulas of a group of N coordinates, the M numbers of whose elements are kept as a type of nalgebra.
pub trait Formulas<const N: usize, const M: usize>: Group<N, M> + Copy + Debug {
    /// An element g.
    type Element<T: Scalar>: Clone + Debug;

    /// The number of rows of the matrices.
    const ROWS: usize;

    /// The number of Casimirs.
    const CASIMIRS: usize;

    /// The numbers of an element.
    fn numbers<T: Scalar>(g: &Self::Element<T>) -> [T; M];

    /// The element of these numbers.
    fn element<T: Scalar>(numbers: [T; M]) -> Self::Element<T>;

    /// An increment as an element.
    fn of_increment<T: Scalar>(h: Self::Increment<T>) -> Self::Element<T>;

    /// g·h, pulled back onto the group to first order, so that rounding does not accumulate over many steps.
    fn compose<T: Scalar>(g: &Self::Element<T>, h: &Self::Element<T>) -> Self::Element<T>;

    /// g⁻¹
    fn inverse<T: Scalar>(g: &Self::Element<T>) -> Self::Element<T>;

    /// [`LieGroup::log`]
    fn log<T: Scalar>(g: &Self::Element<T>) -> Option<[T; N]>;

    /// [`CayleyGroup::cayley_inverse`]
    fn cayley_inverse<T: Scalar>(g: &Self::Element<T>) -> Option<[T; N]>;

    /// Ad\*_g μ
    fn coadjoint_by<T: Scalar>(g: &Self::Element<T>, mu: [T; N]) -> [T; N] {
        Self::coadjoint(Self::numbers(g), mu)
    }

    /// [`LieGroup::element_defect`]
    fn defect_of<T: Scalar>(g: &Self::Element<T>) -> T {
        Self::defect(Self::numbers(g))
    }

    /// [`LieGroup::casimir`]
    fn casimir<T: Scalar>(index: usize, mu: [T; N]) -> T;

    /// [`LieGroup::matrix_entry`]
    fn entry<T: Scalar>(g: &Self::Element<T>, row: usize, column: usize) -> T;

    /// The element whose matrix has these finite entries.
    fn from_matrix<T: Scalar>(
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element<T>, ElementError>;
}

/// A group by its [`Formulas`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Closed<F, T, const N: usize, const M: usize>(PhantomData<(F, T)>);

impl<F, T, const N: usize, const M: usize> Closed<F, T, N, M> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// Not derived: that would ask for `T: Default`, which lanes need not have.
impl<F, T, const N: usize, const M: usize> Default for Closed<F, T, N, M> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F, T, const N: usize, const M: usize> FixedDimension for Closed<F, T, N, M> {
    const DIM: usize = N;
}

/// The entries of a vector.
#[inline(always)]
fn array<T: Scalar, const N: usize>(x: &SVector<T, N>) -> [T; N] {
    x.data.0[0]
}

/// Rows as numbers.
#[inline(always)]
fn nodes<T: Scalar, const M: usize, const N: usize>(x: &[[T; M]; N]) -> [Tuple<T, M>; N] {
    let mut numbers = [Tuple([T::of(0.0); M]); N];
    for i in 0..N {
        numbers[i] = Tuple(x[i]);
    }
    numbers
}

/// The rows of numbers.
#[inline(always)]
fn rows<T: Scalar, const M: usize, const N: usize>(x: [Tuple<T, M>; N]) -> [[T; M]; N] {
    let mut rows = [[T::of(0.0); M]; N];
    for i in 0..N {
        rows[i] = x[i].0;
    }
    rows
}

impl<F, T, const N: usize, const E: usize> LieGroup for Closed<F, T, N, E>
where
    F: Formulas<N, E>,
    T: Scalar,
{
    type Scalar = T;
    type Vector = SVector<T, N>;
    type Element = F::Element<T>;

    fn dim(&self) -> usize {
        N
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        F::compose(g, h)
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        F::inverse(g)
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        F::of_increment(F::exp(array(x), Length::Any))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        F::log(g).map(Into::into)
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        F::ad_star(array(x), array(mu)).into()
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        F::coadjoint_by(g, array(mu)).into()
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let increment = F::exp(array(x), Length::Any);
        (F::of_increment(increment), F::back(increment, array(mu)).into())
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        F::pull_back(array(x), array(mu), Length::Any).into()
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        F::extent(array(x), core::f64::consts::PI)
    }

    #[inline(always)]
    fn node_momenta<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        degree: usize,
    ) -> Rows<Self, M> {
        rows(F::momentum(nodes(x), nodes(p), degree))
    }

    #[inline(always)]
    fn node_rates<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        omega: &Rows<Self, M>,
        degree: usize,
    ) -> [Rows<Self, M>; 2] {
        F::rates(nodes(x), nodes(p), nodes(omega), degree).map(rows)
    }

    #[inline(always)]
    fn ad_stars<const M: usize>(&self, x: &Rows<Self, M>, mu: &Rows<Self, M>) -> Rows<Self, M> {
        rows(F::ad_star(nodes(x), nodes(mu)))
    }

    #[inline(always)]
    fn brackets<const M: usize>(&self, x: &Rows<Self, M>, y: &Rows<Self, M>) -> Rows<Self, M> {
        rows(F::bracket(nodes(x), nodes(y)))
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        F::defect_of(g)
    }

    fn casimir_count(&self) -> usize {
        F::CASIMIRS
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        F::casimir(index, array(mu))
    }

    fn matrix_size(&self) -> usize {
        F::ROWS
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        F::entry(g, row, column)
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(F::ROWS, &entry)?;
        F::from_matrix(entry)
    }
}

impl<F: Formulas<N, E>, T: Scalar, const N: usize, const E: usize> CayleyGroup
    for Closed<F, T, N, E>
{
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        F::of_increment(F::cayley(array(x)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        F::extent(array(x), F::CAYLEY_LIMIT)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        F::cayley_inverse(g).map(Into::into)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        F::cayley_pull_back(array(x), array(mu)).into()
    }
}
