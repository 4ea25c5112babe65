//! Products of any number of groups of one type: powers, known to the compiler, and rows known at run time. Spin
//! chains, clusters of bodies.

use core::fmt::Debug;
use core::marker::PhantomData;

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use nalgebra::SVector;

use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// Groups in a row, and how coordinates and elements of their product are stored.
pub trait Row: Clone + Debug {
    /// The type of a factor.
    type Group: LieGroup;
    /// Coordinates of the product.
    type Vector: Coordinates<<Self::Group as LieGroup>::Scalar>;
    /// Elements of the product: those of the factors.
    type Element: Clone + Debug + AsRef<[<Self::Group as LieGroup>::Element]>;

    /// The factors, in order.
    fn groups(&self) -> impl AsRef<[Self::Group]>;

    /// The element with these in the factors.
    fn element(
        &self,
        make: impl FnMut(usize) -> <Self::Group as LieGroup>::Element,
    ) -> Self::Element;
}

/// A factor, its number, and its first coordinate.
struct Factor<'a, G> {
    group: &'a G,
    at: usize,
    start: usize,
}

fn factors<G: LieGroup>(groups: &[G]) -> impl Iterator<Item = Factor<'_, G>> {
    let mut start = 0;
    groups.iter().enumerate().map(move |(at, group)| {
        let factor = Factor { group, at, start };
        start += group.dim();
        factor
    })
}

impl<G: LieGroup> Factor<'_, G> {
    /// Its own of the coordinates of the product.
    fn of(&self, x: &impl Coordinates<G::Scalar>) -> G::Vector {
        G::Vector::from_entries(self.group.dim(), |i| x[self.start + i])
    }

    /// Puts its own among the coordinates of the product.
    fn put(&self, x: &mut impl Coordinates<G::Scalar>, part: &G::Vector) {
        for i in 0..part.dim() {
            x[self.start + i] = part[i];
        }
    }
}

/// The direct product of groups in a row.
///
/// Coordinates are those of the factors in order; matrices are block diagonal; Casimirs are those of the first factor,
/// then of the second, and so on. Both charts where the factors have them. All work but that for n×n matrices is linear
/// in the number of factors.
#[derive(Clone, Copy, Debug)]
pub struct RowProduct<R>(R);

/// The power G^COPIES of a group of fixed dimension, `N` = COPIES · dim G (checked by the compiler); elements are arrays.
///
/// ```
/// use coadjoint::{LieGroup, groups::Power, SO3};
///
/// let spins = Power::<SO3, 4, 12>::new();
/// assert_eq!((spins.dim(), spins.casimir_count()), (12, 4));
/// ```
pub type Power<G, const COPIES: usize, const N: usize> = RowProduct<Copies<G, COPIES, N>>;

/// The direct product of any number of groups of one type, known at run time; elements are vectors.
///
/// ```
/// use coadjoint::{groups::DirectProduct, LieGroup, SO3};
/// use nalgebra::DVector;
///
/// let chain = DirectProduct::new(vec![SO3::<f64>::new(); 64]);
/// assert_eq!((chain.dim(), chain.casimir_count(), chain.matrix_size()), (192, 64, 192));
/// let x = DVector::from_fn(192, |i, _| (i as f64).sin());
/// assert!((chain.log(&chain.exp(&x)).unwrap() - x).amax() < 1e-14);
/// ```
#[cfg(feature = "alloc")]
pub type DirectProduct<G> = RowProduct<Factors<G>>;

/// The factors of a [`Power`].
#[derive(Clone, Copy, Debug)]
pub struct Copies<G, const COPIES: usize, const N: usize>(PhantomData<G>);

impl<G: FixedDimension, const COPIES: usize, const N: usize> Power<G, COPIES, N> {
    const DIMENSIONS_MULTIPLY: () = assert!(
        COPIES * G::DIM == N && COPIES > 0,
        "N must be COPIES times the factor's dimension"
    );

    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        const { Self::DIMENSIONS_MULTIPLY };
        Self(Copies(PhantomData))
    }
}

impl<G: FixedDimension, const COPIES: usize, const N: usize> Default for Power<G, COPIES, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<G, const COPIES: usize, const N: usize> FixedDimension for Power<G, COPIES, N> {
    const DIM: usize = N;
}

impl<T, G, const COPIES: usize, const N: usize> Row for Copies<G, COPIES, N>
where
    T: Scalar,
    G: LieGroup<Scalar = T> + Default,
{
    type Group = G;
    type Vector = SVector<T, N>;
    type Element = [G::Element; COPIES];

    fn groups(&self) -> impl AsRef<[G]> {
        [(); COPIES].map(|()| G::default())
    }

    fn element(&self, make: impl FnMut(usize) -> G::Element) -> Self::Element {
        core::array::from_fn(make)
    }
}

/// The factors of a [`DirectProduct`].
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct Factors<G>(Vec<G>);

#[cfg(feature = "alloc")]
impl<G: LieGroup> DirectProduct<G> {
    /// The product of `factors` in this order.
    #[must_use]
    pub fn new(factors: Vec<G>) -> Self {
        Self(Factors(factors))
    }

    /// The factors, in order.
    pub fn factors(&self) -> impl ExactSizeIterator<Item = &G> {
        self.0.0.iter()
    }
}

#[cfg(feature = "alloc")]
impl<G: LieGroup> Row for Factors<G> {
    type Group = G;
    type Vector = nalgebra::DVector<G::Scalar>;
    type Element = Vec<G::Element>;

    fn groups(&self) -> impl AsRef<[G]> {
        &self.0
    }

    fn element(&self, make: impl FnMut(usize) -> G::Element) -> Self::Element {
        (0..self.0.len()).map(make).collect()
    }
}

impl<T: Scalar, R: Row<Group: LieGroup<Scalar = T>>> RowProduct<R> {
    /// The sum of numbers, one for each factor.
    fn sum(&self, size: impl Fn(&R::Group) -> usize) -> usize {
        self.0.groups().as_ref().iter().map(size).sum()
    }

    /// An element, made factor by factor.
    fn element(&self, mut make: impl FnMut(Factor<'_, R::Group>) -> ElementOf<R>) -> R::Element {
        let (groups, mut start) = (self.0.groups(), 0);
        self.0.element(|at| {
            let group = &groups.as_ref()[at];
            let factor = Factor { group, at, start };
            start += group.dim();
            make(factor)
        })
    }

    /// Coordinates, made factor by factor.
    fn coordinates(&self, mut make: impl FnMut(&Factor<'_, R::Group>) -> VectorOf<R>) -> R::Vector {
        let mut result = R::Vector::zeros(self.dim());
        for factor in factors(self.0.groups().as_ref()) {
            factor.put(&mut result, &make(&factor));
        }
        result
    }

    /// Coordinates that there may not be.
    fn coordinates_if_any(
        &self,
        mut make: impl FnMut(&Factor<'_, R::Group>) -> Option<VectorOf<R>>,
    ) -> Option<R::Vector> {
        let mut result = R::Vector::zeros(self.dim());
        for factor in factors(self.0.groups().as_ref()) {
            factor.put(&mut result, &make(&factor)?);
        }
        Some(result)
    }

    /// Coordinates from two others.
    fn by_parts(
        &self,
        x: &R::Vector,
        y: &R::Vector,
        f: impl Fn(&R::Group, &VectorOf<R>, &VectorOf<R>) -> VectorOf<R>,
    ) -> R::Vector {
        self.coordinates(|factor| f(factor.group, &factor.of(x), &factor.of(y)))
    }

    /// Coordinates at each node from others.
    fn rows_by_parts<const M: usize, const A: usize, const B: usize>(
        &self,
        from: [&RowsOf<R, M>; A],
        f: impl Fn(&R::Group, [Rows<R::Group, M>; A]) -> [Rows<R::Group, M>; B],
    ) -> [RowsOf<R, M>; B] {
        let mut result = [(); B].map(|()| R::Vector::zero_rows::<M>(self.dim()));
        for Factor { group, start, .. } in factors(self.0.groups().as_ref()) {
            let n = group.dim();
            let parts = from.map(|rows| {
                let mut part = VectorOf::<R>::zero_rows::<M>(n);
                (0..n).for_each(|i| part[i] = rows[start + i]);
                part
            });
            for (rows, part) in result.iter_mut().zip(f(group, parts)) {
                (0..n).for_each(|i| rows[start + i] = part[i]);
            }
        }
        result
    }

    /// The largest of numbers, one for each factor; NaN if one is.
    fn largest(&self, f: impl Fn(Factor<'_, R::Group>) -> T) -> T {
        let groups = self.0.groups();
        factors(groups.as_ref()).map(f).fold(T::of(0.0), Scalar::worse)
    }
}

type ElementOf<R> = <<R as Row>::Group as LieGroup>::Element;
type VectorOf<R> = <<R as Row>::Group as LieGroup>::Vector;
/// Coordinates of the product at each node.
type RowsOf<R, const M: usize> =
    <<R as Row>::Vector as Coordinates<<<R as Row>::Group as LieGroup>::Scalar>>::Rows<M>;

impl<T: Scalar, R: Row<Group: LieGroup<Scalar = T>>> LieGroup for RowProduct<R> {
    type Scalar = T;
    type Vector = R::Vector;
    type Element = R::Element;

    fn dim(&self) -> usize {
        self.sum(R::Group::dim)
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let (g, h) = (g.as_ref(), h.as_ref());
        self.element(|Factor { group, at, .. }| group.compose(&g[at], &h[at]))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        self.element(|factor| factor.group.inverse(&g.as_ref()[factor.at]))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        self.element(|factor| factor.group.exp(&factor.of(x)))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        self.coordinates_if_any(|factor| factor.group.log(&g.as_ref()[factor.at]))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.by_parts(x, mu, R::Group::ad_star)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        self.coordinates(|factor| factor.group.coadjoint(&g.as_ref()[factor.at], &factor.of(mu)))
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let mut moved = R::Vector::zeros(mu.dim());
        let element = self.element(|factor| {
            let (g, part) = factor.group.exp_transport(&factor.of(x), &factor.of(mu));
            factor.put(&mut moved, &part);
            g
        });
        (element, moved)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.by_parts(x, mu, R::Group::dexp_transpose)
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        self.largest(|factor| factor.group.exp_extent(&factor.of(x)))
    }

    fn node_momenta<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        degree: usize,
    ) -> Rows<Self, M> {
        let [momenta] = self.rows_by_parts::<M, _, _>([x, p], |group, [x, p]| {
            [group.node_momenta::<M>(&x, &p, degree)]
        });
        momenta
    }

    fn node_rates<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        omega: &Rows<Self, M>,
        degree: usize,
    ) -> [Rows<Self, M>; 2] {
        self.rows_by_parts::<M, _, _>([x, p, omega], |group, [x, p, omega]| {
            group.node_rates::<M>(&x, &p, &omega, degree)
        })
    }

    fn ad_stars<const M: usize>(&self, x: &Rows<Self, M>, mu: &Rows<Self, M>) -> Rows<Self, M> {
        let [turned] =
            self.rows_by_parts::<M, _, _>([x, mu], |group, [x, mu]| [group.ad_stars::<M>(&x, &mu)]);
        turned
    }

    fn brackets<const M: usize>(&self, x: &Rows<Self, M>, y: &Rows<Self, M>) -> Rows<Self, M> {
        let [brackets] =
            self.rows_by_parts::<M, _, _>([x, y], |group, [x, y]| [group.brackets::<M>(&x, &y)]);
        brackets
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        self.largest(|factor| factor.group.element_defect(&g.as_ref()[factor.at]))
    }

    fn casimir_count(&self) -> usize {
        self.sum(R::Group::casimir_count)
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let mut index = index;
        for factor in factors(self.0.groups().as_ref()) {
            let count = factor.group.casimir_count();
            if index < count {
                return factor.group.casimir(index, &factor.of(mu));
            }
            index -= count;
        }
        T::of(0.0)
    }

    fn matrix_size(&self) -> usize {
        self.sum(R::Group::matrix_size)
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let (mut row, mut column) = (row, column);
        for (group, g) in self.0.groups().as_ref().iter().zip(g.as_ref()) {
            let size = group.matrix_size();
            match (row < size, column < size) {
                (true, true) => return group.matrix_entry(g, row, column),
                (false, false) => (row, column) = (row - size, column - size),
                // Outside of the blocks.
                _ => break,
            }
        }
        T::of(0.0)
    }

    fn matrix_entries(&self, g: &Self::Element, visit: &mut dyn FnMut(usize, usize, T)) {
        let mut first = 0;
        for (group, g) in self.0.groups().as_ref().iter().zip(g.as_ref()) {
            group.matrix_entries(g, &mut |i, j, entry| visit(first + i, first + j, entry));
            first += group.matrix_size();
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        let size = self.matrix_size();
        finite(size, &entry)?;
        // As `dyn`, so that products of products do not nest closure types without end.
        let entry: &dyn Fn(usize, usize) -> T = &entry;
        let (mut error, mut first) = (None, 0);
        let element = self.element(|Factor { group, .. }| {
            let block = first..first + group.matrix_size();
            first = block.end;
            let places = block.clone().flat_map(|row| (0..size).map(move |column| (row, column)));
            let read = places
                .filter(|(_, column)| !block.contains(column))
                .try_for_each(|place| fixed(&entry, place, 0.0))
                .and_then(|()| {
                    group.element_from_matrix(|i, j| entry(block.start + i, block.start + j))
                });
            read.unwrap_or_else(|why| {
                error.get_or_insert(why);
                group.identity()
            })
        });
        error.map_or(Ok(element), Err)
    }
}

impl<T: Scalar, R: Row<Group: CayleyGroup<Scalar = T>>> CayleyGroup for RowProduct<R> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        self.element(|factor| factor.group.cayley(&factor.of(x)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        self.largest(|factor| factor.group.cayley_extent(&factor.of(x)))
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        self.coordinates_if_any(|factor| factor.group.cayley_inverse(&g.as_ref()[factor.at]))
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.by_parts(x, mu, R::Group::dcay_transpose)
    }
}
