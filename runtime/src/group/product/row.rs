//! Products of any number of groups of one type: powers, known to the compiler, and rows known at run time. Spin
//! chains, clusters of bodies.

use core::borrow::Borrow;
use core::fmt::{self, Debug};
use core::marker::PhantomData;

#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

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

    /// How many factors there are.
    fn count(&self) -> usize;

    /// A factor.
    fn group(&self, at: usize) -> impl Borrow<Self::Group>;

    /// Where a factor begins, or where the last one ends.
    fn place(&self, at: usize) -> Place;

    /// The element with these in the factors.
    fn element(
        &self,
        make: impl FnMut(usize) -> <Self::Group as LieGroup>::Element,
    ) -> Self::Element;
}

/// The first coordinate, the first row of matrices and the first Casimir of a factor.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place {
    coordinate: usize,
    row: usize,
    casimir: usize,
}

impl Place {
    /// The place after `count` copies of a group from here.
    fn after<G: LieGroup>(self, count: usize, group: &G) -> Self {
        Self {
            coordinate: self.coordinate + count * group.dim(),
            row: self.row + count * group.matrix_size(),
            casimir: self.casimir + count * group.casimir_count(),
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

// Derived impls would ask the same of the factors.
impl<G, const COPIES: usize, const N: usize> Clone for Copies<G, COPIES, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<G, const COPIES: usize, const N: usize> Copy for Copies<G, COPIES, N> {}

impl<G, const COPIES: usize, const N: usize> Debug for Copies<G, COPIES, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{COPIES} copies")
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

    fn count(&self) -> usize {
        COPIES
    }

    fn group(&self, _at: usize) -> impl Borrow<G> {
        G::default()
    }

    fn place(&self, at: usize) -> Place {
        Place::default().after(at, &G::default())
    }

    fn element(&self, make: impl FnMut(usize) -> G::Element) -> Self::Element {
        core::array::from_fn(make)
    }
}

/// The factors of a [`DirectProduct`].
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
pub struct Factors<G> {
    groups: Vec<G>,
    /// Where each begins, and where the last one ends.
    places: Vec<Place>,
}

#[cfg(feature = "alloc")]
impl<G: LieGroup> DirectProduct<G> {
    /// The product of `factors` in this order.
    #[must_use]
    pub fn new(factors: Vec<G>) -> Self {
        let mut places = vec![Place::default()];
        let mut end = Place::default();
        for group in &factors {
            end = end.after(1, group);
            places.push(end);
        }
        Self(Factors { groups: factors, places })
    }

    /// The factors, in order.
    pub fn factors(&self) -> impl ExactSizeIterator<Item = &G> {
        self.0.groups.iter()
    }
}

#[cfg(feature = "alloc")]
impl<G: LieGroup> Row for Factors<G> {
    type Group = G;
    type Vector = nalgebra::DVector<G::Scalar>;
    type Element = Vec<G::Element>;

    fn count(&self) -> usize {
        self.groups.len()
    }

    fn group(&self, at: usize) -> impl Borrow<G> {
        &self.groups[at]
    }

    fn place(&self, at: usize) -> Place {
        self.places[at]
    }

    fn element(&self, make: impl FnMut(usize) -> G::Element) -> Self::Element {
        (0..self.groups.len()).map(make).collect()
    }
}

impl<T: Scalar, R: Row<Group: LieGroup<Scalar = T>>> RowProduct<R> {
    fn end(&self) -> Place {
        self.0.place(self.0.count())
    }

    fn part(&self, at: usize, x: &R::Vector) -> VectorOf<R> {
        let start = self.0.place(at).coordinate;
        VectorOf::<R>::from_entries(self.0.group(at).borrow().dim(), |i| x[start + i])
    }

    /// Coordinates, made factor by factor.
    fn coordinates(&self, mut make: impl FnMut(usize, &R::Group) -> VectorOf<R>) -> R::Vector {
        let mut result = R::Vector::zeros(self.end().coordinate);
        for at in 0..self.0.count() {
            let part = make(at, self.0.group(at).borrow());
            let start = self.0.place(at).coordinate;
            for i in 0..part.dim() {
                result[start + i] = part[i];
            }
        }
        result
    }

    /// The same of coordinates that there may not be.
    fn coordinates_if_any(
        &self,
        mut make: impl FnMut(usize, &R::Group) -> Option<VectorOf<R>>,
    ) -> Option<R::Vector> {
        let mut known = true;
        let result = self.coordinates(|at, group| {
            make(at, group).unwrap_or_else(|| {
                known = false;
                VectorOf::<R>::zeros(group.dim())
            })
        });
        known.then_some(result)
    }

    /// Coordinates from two others.
    fn by_parts(
        &self,
        x: &R::Vector,
        y: &R::Vector,
        f: impl Fn(&R::Group, &VectorOf<R>, &VectorOf<R>) -> VectorOf<R>,
    ) -> R::Vector {
        self.coordinates(|at, group| f(group, &self.part(at, x), &self.part(at, y)))
    }

    /// Coordinates at each node from others.
    fn rows_by_parts<const M: usize, const A: usize, const B: usize>(
        &self,
        from: [&RowsOf<R, M>; A],
        f: impl Fn(&R::Group, [Rows<R::Group, M>; A]) -> [Rows<R::Group, M>; B],
    ) -> [RowsOf<R, M>; B] {
        let mut result = [(); B].map(|()| R::Vector::zero_rows::<M>(self.end().coordinate));
        for at in 0..self.0.count() {
            let (group, start) = (self.0.group(at), self.0.place(at).coordinate);
            let n = group.borrow().dim();
            let parts = from.map(|rows| {
                let mut part = VectorOf::<R>::zero_rows::<M>(n);
                (0..n).for_each(|i| part[i] = rows[start + i]);
                part
            });
            for (rows, part) in result.iter_mut().zip(f(group.borrow(), parts)) {
                (0..n).for_each(|i| rows[start + i] = part[i]);
            }
        }
        result
    }

    /// The largest of numbers, one for each factor; NaN if one is.
    fn largest(&self, f: impl Fn(usize, &R::Group) -> T) -> T {
        (0..self.0.count())
            .fold(T::of(0.0), |largest, at| largest.worse(f(at, self.0.group(at).borrow())))
    }

    /// The factor that owns a row of the matrices, or a Casimir, and where it begins.
    fn owner(&self, index: usize, first: impl Fn(Place) -> usize) -> Option<(usize, usize)> {
        // Of factors without Casimirs the last of equal beginnings is the owner.
        let (mut low, mut high) = (0, self.0.count());
        while low < high {
            let middle = low + (high - low) / 2;
            match first(self.0.place(middle)) <= index {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        let owner = low.checked_sub(1)?;
        Some((owner, first(self.0.place(owner))))
    }
}

type VectorOf<R> = <<R as Row>::Group as LieGroup>::Vector;
/// Coordinates of the product at each node.
type RowsOf<R, const M: usize> =
    <<R as Row>::Vector as Coordinates<<<R as Row>::Group as LieGroup>::Scalar>>::Rows<M>;

impl<T: Scalar, R: Row<Group: LieGroup<Scalar = T>>> LieGroup for RowProduct<R> {
    type Scalar = T;
    type Vector = R::Vector;
    type Element = R::Element;

    fn dim(&self) -> usize {
        self.end().coordinate
    }

    fn identity(&self) -> Self::Element {
        self.0.element(|at| self.0.group(at).borrow().identity())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let (g, h) = (g.as_ref(), h.as_ref());
        self.0.element(|at| self.0.group(at).borrow().compose(&g[at], &h[at]))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        self.0.element(|at| self.0.group(at).borrow().inverse(&g.as_ref()[at]))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        self.0.element(|at| self.0.group(at).borrow().exp(&self.part(at, x)))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        self.coordinates_if_any(|at, group| group.log(&g.as_ref()[at]))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.by_parts(x, mu, R::Group::ad_star)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        self.coordinates(|at, group| group.coadjoint(&g.as_ref()[at], &self.part(at, mu)))
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let mut moved = R::Vector::zeros(mu.dim());
        let element = self.0.element(|at| {
            let (group, start) = (self.0.group(at), self.0.place(at).coordinate);
            let (g, part) = group.borrow().exp_transport(&self.part(at, x), &self.part(at, mu));
            for i in 0..part.dim() {
                moved[start + i] = part[i];
            }
            g
        });
        (element, moved)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.by_parts(x, mu, R::Group::dexp_transpose)
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        self.largest(|at, group| group.exp_extent(&self.part(at, x)))
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
        self.largest(|at, group| group.element_defect(&g.as_ref()[at]))
    }

    fn casimir_count(&self) -> usize {
        self.end().casimir
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        match self.owner(index, |place| place.casimir) {
            Some((at, first)) if index < self.casimir_count() => {
                self.0.group(at).borrow().casimir(index - first, &self.part(at, mu))
            }
            _ => T::of(0.0),
        }
    }

    fn matrix_size(&self) -> usize {
        self.end().row
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let owner = |index| self.owner(index, |place| place.row);
        match (owner(row), owner(column)) {
            (Some((at, first)), Some((other, _))) if at == other => {
                let group = self.0.group(at);
                group.borrow().matrix_entry(&g.as_ref()[at], row - first, column - first)
            }
            _ => T::of(0.0),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        let size = self.matrix_size();
        finite(size, &entry)?;
        let block = |at| self.0.place(at).row..self.0.place(at + 1).row;
        for at in 0..self.0.count() {
            for row in block(at) {
                for column in (0..size).filter(|column| !block(at).contains(column)) {
                    fixed(&entry, (row, column), 0.0)?;
                }
            }
        }
        // As `dyn`, so that products of products do not nest closure types without end.
        let entry: &dyn Fn(usize, usize) -> T = &entry;
        let mut error = None;
        let element = self.0.element(|at| {
            let (group, first) = (self.0.group(at), self.0.place(at).row);
            let read = group.borrow().element_from_matrix(|i, j| entry(first + i, first + j));
            read.unwrap_or_else(|why| {
                error.get_or_insert(why);
                group.borrow().identity()
            })
        });
        error.map_or(Ok(element), Err)
    }
}

impl<T: Scalar, R: Row<Group: CayleyGroup<Scalar = T>>> CayleyGroup for RowProduct<R> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        self.0.element(|at| self.0.group(at).borrow().cayley(&self.part(at, x)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        self.largest(|at, group| group.cayley_extent(&self.part(at, x)))
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        self.coordinates_if_any(|at, group| group.cayley_inverse(&g.as_ref()[at]))
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.by_parts(x, mu, R::Group::dcay_transpose)
    }
}
