//! The product of two groups.

use core::fmt;
use core::marker::PhantomData;

use nalgebra::{SMatrix, SVector};

use super::{part, place, place_block};
use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::scalar::Scalar;

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

// Derived impls would ask the same of the factors.
impl<A, B, const N: usize> Clone for Product<A, B, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A, B, const N: usize> Copy for Product<A, B, N> {}

impl<A, B, const N: usize> fmt::Debug for Product<A, B, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Product")
    }
}

impl<A, B, const N: usize> FixedDimension for Product<A, B, N> {
    const DIM: usize = N;
}

/// Splits coordinates, applies the factors' functions, and joins the results.
macro_rules! by_factor {
    ($x:ident, $y:ident, $method:ident) => {{
        let (n, m) = (A::default().dim(), B::default().dim());
        let mut result = SVector::repeat(T::of(0.0));
        place(&A::default().$method(&part($x, 0, n), &part($y, 0, n)), 0, &mut result);
        place(&B::default().$method(&part($x, n, m), &part($y, n, m)), n, &mut result);
        result
    }};
}

/// The same for functions with a derivative.
macro_rules! by_factor_with_derivative {
    ($x:ident, $mu:ident, $method:ident) => {{
        let (n, m) = (A::default().dim(), B::default().dim());
        let mut value = SVector::repeat(T::of(0.0));
        let mut slope = SMatrix::repeat(T::of(0.0));
        let (p, d) = A::default().$method(&part($x, 0, n), &part($mu, 0, n));
        place(&p, 0, &mut value);
        place_block::<T, A::Vector, N>(&d, 0, n, &mut slope);
        let (p, d) = B::default().$method(&part($x, n, m), &part($mu, n, m));
        place(&p, n, &mut value);
        place_block::<T, B::Vector, N>(&d, n, m, &mut slope);
        (value, slope)
    }};
}

/// The same for the transport of a chart.
macro_rules! by_factor_transport {
    ($x:ident, $mu:ident, $method:ident) => {{
        let (n, m) = (A::default().dim(), B::default().dim());
        let mut moved = SVector::repeat(T::of(0.0));
        let (g, nu) = A::default().$method(&part($x, 0, n), &part($mu, 0, n));
        place(&nu, 0, &mut moved);
        let (h, nu) = B::default().$method(&part($x, n, m), &part($mu, n, m));
        place(&nu, n, &mut moved);
        ((g, h), moved)
    }};
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

    #[inline(always)]
    fn dim(&self) -> usize {
        N
    }

    fn identity(&self) -> Self::Element {
        (A::default().identity(), B::default().identity())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        (A::default().compose(&g.0, &h.0), B::default().compose(&g.1, &h.1))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        (A::default().inverse(&g.0), B::default().inverse(&g.1))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (n, m) = (A::default().dim(), B::default().dim());
        (A::default().exp(&part(x, 0, n)), B::default().exp(&part(x, n, m)))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = SVector::repeat(T::of(0.0));
        place(&A::default().log(&g.0)?, 0, &mut result);
        place(&B::default().log(&g.1)?, A::default().dim(), &mut result);
        Some(result)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        by_factor!(x, y, bracket)
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_factor!(x, mu, ad_star)
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        let (n, m) = (A::default().dim(), B::default().dim());
        let mut result = SVector::repeat(T::of(0.0));
        place(&A::default().adjoint(&g.0, &part(x, 0, n)), 0, &mut result);
        place(&B::default().adjoint(&g.1, &part(x, n, m)), n, &mut result);
        result
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (n, m) = (A::default().dim(), B::default().dim());
        let mut result = SVector::repeat(T::of(0.0));
        place(&A::default().coadjoint(&g.0, &part(mu, 0, n)), 0, &mut result);
        place(&B::default().coadjoint(&g.1, &part(mu, n, m)), n, &mut result);
        result
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        by_factor_transport!(x, mu, exp_transport)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_factor!(x, mu, dexp_transpose)
    }

    fn dexp_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, SMatrix<T, N, N>) {
        by_factor_with_derivative!(x, mu, dexp_transpose_with_derivative)
    }

    fn dexp_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        by_factor!(x, p, dexp_inverse_transpose)
    }

    #[inline(always)]
    fn exp_extent(&self, x: &Self::Vector) -> T {
        let (n, m) = (A::default().dim(), B::default().dim());
        let left = A::default().exp_extent(&part(x, 0, n));
        left.worse(B::default().exp_extent(&part(x, n, m)))
    }

    #[inline(always)]
    fn element_defect(&self, g: &Self::Element) -> T {
        A::default().element_defect(&g.0).worse(B::default().element_defect(&g.1))
    }

    fn casimir_count(&self) -> usize {
        A::default().casimir_count() + B::default().casimir_count()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (n, m) = (A::default().dim(), B::default().dim());
        match index.checked_sub(A::default().casimir_count()) {
            None => A::default().casimir(index, &part(mu, 0, n)),
            Some(index) => B::default().casimir(index, &part(mu, n, m)),
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
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        by_factor_transport!(x, mu, cayley_transport)
    }

    #[inline(always)]
    fn cayley_extent(&self, x: &Self::Vector) -> T {
        let (n, m) = (A::default().dim(), B::default().dim());
        let left = A::default().cayley_extent(&part(x, 0, n));
        left.worse(B::default().cayley_extent(&part(x, n, m)))
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = SVector::repeat(T::of(0.0));
        place(&A::default().cayley_inverse(&g.0)?, 0, &mut result);
        place(&B::default().cayley_inverse(&g.1)?, A::default().dim(), &mut result);
        Some(result)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_factor!(x, mu, dcay_transpose)
    }

    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, SMatrix<T, N, N>) {
        by_factor_with_derivative!(x, mu, dcay_transpose_with_derivative)
    }

    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        by_factor!(x, p, dcay_inverse_transpose)
    }
}
