//! The product of two groups.

use core::marker::PhantomData;

use nalgebra::SVector;

use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// The direct product A × B of two groups of fixed dimension, `N` the sum of the dimensions
/// (checked by the compiler).
///
/// Elements are pairs; coordinates are those of A, then those of B; matrices are block diagonal;
/// Casimirs are those of A, then those of B. Both charts where both factors have them.
///
/// ```
/// use coadjoint::{LieGroup, SO3};
/// use coadjoint::groups::{Product, SE2};
///
/// let group = Product::<SO3, SE2, 6>::new();
/// assert_eq!((group.dim(), group.matrix_size(), group.casimir_count()), (6, 6, 2));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Product<A, B, const N: usize>(PhantomData<(A, B)>);

impl<A: FixedDimension, B: FixedDimension, const N: usize> Product<A, B, N> {
    const DIMENSIONS_ADD_UP: () =
        assert!(A::DIM + B::DIM == N, "N must be the sum of the factors' dimensions");

    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        const { Self::DIMENSIONS_ADD_UP };
        Self(PhantomData)
    }
}

impl<A: FixedDimension, B: FixedDimension, const N: usize> Default for Product<A, B, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<A, B, const N: usize> FixedDimension for Product<A, B, N> {
    const DIM: usize = N;
}

impl<T: Scalar, A, B, const N: usize> Product<A, B, N>
where
    A: LieGroup<Scalar = T> + Default,
    B: LieGroup<Scalar = T> + Default,
{
    fn split(x: &SVector<T, N>) -> (A::Vector, B::Vector) {
        let (n, m) = (A::default().dim(), B::default().dim());
        (A::Vector::from_entries(n, |i| x[i]), B::Vector::from_entries(m, |i| x[n + i]))
    }

    fn join((a, b): (A::Vector, B::Vector)) -> SVector<T, N> {
        let n = a.dim();
        SVector::from_entries(N, |i| if i < n { a[i] } else { b[i - n] })
    }

    /// The coordinates of both factors at each node.
    fn split_rows<const M: usize>(x: &[[T; M]; N]) -> (Rows<A, M>, Rows<B, M>) {
        let (n, m) = (A::default().dim(), B::default().dim());
        let mut rows = (A::Vector::zero_rows::<M>(n), B::Vector::zero_rows::<M>(m));
        (0..n).for_each(|i| rows.0[i] = x[i]);
        (0..m).for_each(|i| rows.1[i] = x[n + i]);
        rows
    }

    fn join_rows<const M: usize>(a: &Rows<A, M>, b: &Rows<B, M>) -> [[T; M]; N] {
        let n = A::default().dim();
        core::array::from_fn(|i| if i < n { a[i] } else { b[i - n] })
    }

    /// Coordinates from two others, factor by factor.
    fn by_factor(
        x: &SVector<T, N>,
        y: &SVector<T, N>,
        f: impl Fn(&A, &A::Vector, &A::Vector) -> A::Vector,
        g: impl Fn(&B, &B::Vector, &B::Vector) -> B::Vector,
    ) -> SVector<T, N> {
        let ((a, b), (c, d)) = (Self::split(x), Self::split(y));
        Self::join((f(&A::default(), &a, &c), g(&B::default(), &b, &d)))
    }
}

impl<T, A, B, const N: usize> LieGroup for Product<A, B, N>
where
    T: Scalar,
    A: LieGroup<Scalar = T> + Default,
    B: LieGroup<Scalar = T> + Default,
{
    type Scalar = T;
    type Vector = SVector<T, N>;
    type Element = (A::Element, B::Element);

    fn dim(&self) -> usize {
        N
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        (A::default().compose(&g.0, &h.0), B::default().compose(&g.1, &h.1))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        (A::default().inverse(&g.0), B::default().inverse(&g.1))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (a, b) = Self::split(x);
        (A::default().exp(&a), B::default().exp(&b))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        Some(Self::join((A::default().log(&g.0)?, B::default().log(&g.1)?)))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        Self::by_factor(x, mu, A::ad_star, B::ad_star)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (a, b) = Self::split(mu);
        Self::join((A::default().coadjoint(&g.0, &a), B::default().coadjoint(&g.1, &b)))
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let ((a, b), (c, d)) = (Self::split(x), Self::split(mu));
        let (g, left) = A::default().exp_transport(&a, &c);
        let (h, right) = B::default().exp_transport(&b, &d);
        ((g, h), Self::join((left, right)))
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        Self::by_factor(x, mu, A::dexp_transpose, B::dexp_transpose)
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        let (a, b) = Self::split(x);
        A::default().exp_extent(&a).worse(B::default().exp_extent(&b))
    }

    fn node_momenta<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        degree: usize,
    ) -> Rows<Self, M> {
        let ((xa, xb), (pa, pb)) = (Self::split_rows::<M>(x), Self::split_rows::<M>(p));
        let left = A::default().node_momenta::<M>(&xa, &pa, degree);
        Self::join_rows::<M>(&left, &B::default().node_momenta::<M>(&xb, &pb, degree))
    }

    fn node_rates<const M: usize>(
        &self,
        x: &Rows<Self, M>,
        p: &Rows<Self, M>,
        omega: &Rows<Self, M>,
        degree: usize,
    ) -> [Rows<Self, M>; 2] {
        let [(xa, xb), (pa, pb), (wa, wb)] = [x, p, omega].map(Self::split_rows::<M>);
        let [velocity, force] = A::default().node_rates::<M>(&xa, &pa, &wa, degree);
        let [other, push] = B::default().node_rates::<M>(&xb, &pb, &wb, degree);
        [Self::join_rows::<M>(&velocity, &other), Self::join_rows::<M>(&force, &push)]
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        A::default().element_defect(&g.0).worse(B::default().element_defect(&g.1))
    }

    fn casimir_count(&self) -> usize {
        A::default().casimir_count() + B::default().casimir_count()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (a, b) = Self::split(mu);
        match index.checked_sub(A::default().casimir_count()) {
            None => A::default().casimir(index, &a),
            Some(index) => B::default().casimir(index, &b),
        }
    }

    fn matrix_size(&self) -> usize {
        A::default().matrix_size() + B::default().matrix_size()
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let d = A::default().matrix_size();
        match (row < d, column < d) {
            (true, true) => A::default().matrix_entry(&g.0, row, column),
            (false, false) => B::default().matrix_entry(&g.1, row - d, column - d),
            _ => T::of(0.0),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        let (d, size) = (A::default().matrix_size(), self.matrix_size());
        finite(size, &entry)?;
        for row in 0..size {
            for column in (0..size).filter(|&column| (row < d) != (column < d)) {
                fixed(&entry, (row, column), 0.0)?;
            }
        }
        // As `dyn`, so that products of products do not nest closure types without end.
        let entry: &dyn Fn(usize, usize) -> T = &entry;
        let g = A::default().element_from_matrix(entry)?;
        Ok((g, B::default().element_from_matrix(|i, j| entry(i + d, j + d))?))
    }
}

impl<T, A, B, const N: usize> CayleyGroup for Product<A, B, N>
where
    T: Scalar,
    A: CayleyGroup<Scalar = T> + Default,
    B: CayleyGroup<Scalar = T> + Default,
{
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        let (a, b) = Self::split(x);
        (A::default().cayley(&a), B::default().cayley(&b))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        let (a, b) = Self::split(x);
        A::default().cayley_extent(&a).worse(B::default().cayley_extent(&b))
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        Some(Self::join((A::default().cayley_inverse(&g.0)?, B::default().cayley_inverse(&g.1)?)))
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        Self::by_factor(x, mu, A::dcay_transpose, B::dcay_transpose)
    }
}
