//! The product of two groups.

use nalgebra::{SMatrix, SVector};

use super::{part, place, place_block};
use crate::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::scalar::Scalar;

/// The direct product A × B of two groups of fixed dimension, `N` the sum of the dimensions
/// (checked by the compiler).
///
/// Elements are pairs; coordinates are those of A, then those of B; matrices are block diagonal;
/// Casimirs are those of A, then those of B. Both charts where both factors have them.
///
/// ```
/// use coadjoint::{LieGroup, Product, SE2, SO3};
///
/// let group = Product::<SO3, SE2, 6>::default();
/// assert_eq!((group.dim(), group.matrix_size(), group.casimir_count()), (6, 6, 2));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Product<A, B, const N: usize> {
    first: A,
    second: B,
}

impl<A: FixedDimension, B: FixedDimension, const N: usize> Product<A, B, N> {
    const DIMENSIONS_ADD_UP: () =
        assert!(A::DIM + B::DIM == N, "N must be the sum of the factors' dimensions");

    /// The product of these groups.
    #[must_use]
    pub const fn new(first: A, second: B) -> Self {
        const { Self::DIMENSIONS_ADD_UP };
        Self { first, second }
    }
}

impl<A: FixedDimension + Default, B: FixedDimension + Default, const N: usize> Default
    for Product<A, B, N>
{
    fn default() -> Self {
        Self::new(A::default(), B::default())
    }
}

impl<A, B, const N: usize> FixedDimension for Product<A, B, N> {
    const DIM: usize = N;
}

/// Splits coordinates, applies the factors' functions, and joins the results.
macro_rules! by_factor {
    ($self:ident, $x:ident, $y:ident, $method:ident) => {{
        let (n, m) = ($self.first.dim(), $self.second.dim());
        let mut result = SVector::repeat(T::of(0.0));
        place(&$self.first.$method(&part($x, 0, n), &part($y, 0, n)), 0, &mut result);
        place(&$self.second.$method(&part($x, n, m), &part($y, n, m)), n, &mut result);
        result
    }};
}

/// The same for functions with a derivative.
macro_rules! by_factor_with_derivative {
    ($self:ident, $x:ident, $mu:ident, $method:ident) => {{
        let (n, m) = ($self.first.dim(), $self.second.dim());
        let mut value = SVector::repeat(T::of(0.0));
        let mut slope = SMatrix::repeat(T::of(0.0));
        let (p, d) = $self.first.$method(&part($x, 0, n), &part($mu, 0, n));
        place(&p, 0, &mut value);
        place_block::<T, A::Vector, N>(&d, 0, n, &mut slope);
        let (p, d) = $self.second.$method(&part($x, n, m), &part($mu, n, m));
        place(&p, n, &mut value);
        place_block::<T, B::Vector, N>(&d, n, m, &mut slope);
        (value, slope)
    }};
}

/// The same for the transport of a chart.
macro_rules! by_factor_transport {
    ($self:ident, $x:ident, $mu:ident, $method:ident) => {{
        let (n, m) = ($self.first.dim(), $self.second.dim());
        let mut moved = SVector::repeat(T::of(0.0));
        let (g, nu) = $self.first.$method(&part($x, 0, n), &part($mu, 0, n));
        place(&nu, 0, &mut moved);
        let (h, nu) = $self.second.$method(&part($x, n, m), &part($mu, n, m));
        place(&nu, n, &mut moved);
        ((g, h), moved)
    }};
}

impl<T, A, B, const N: usize> LieGroup for Product<A, B, N>
where
    T: Scalar,
    A: LieGroup<Scalar = T>,
    B: LieGroup<Scalar = T>,
{
    type Scalar = T;
    type Vector = SVector<T, N>;
    type Element = (A::Element, B::Element);

    #[inline(always)]
    fn dim(&self) -> usize {
        N
    }

    fn identity(&self) -> Self::Element {
        (self.first.identity(), self.second.identity())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        (self.first.compose(&g.0, &h.0), self.second.compose(&g.1, &h.1))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        (self.first.inverse(&g.0), self.second.inverse(&g.1))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (n, m) = (self.first.dim(), self.second.dim());
        (self.first.exp(&part(x, 0, n)), self.second.exp(&part(x, n, m)))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = SVector::repeat(T::of(0.0));
        place(&self.first.log(&g.0)?, 0, &mut result);
        place(&self.second.log(&g.1)?, self.first.dim(), &mut result);
        Some(result)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        by_factor!(self, x, y, bracket)
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_factor!(self, x, mu, ad_star)
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        let (n, m) = (self.first.dim(), self.second.dim());
        let mut result = SVector::repeat(T::of(0.0));
        place(&self.first.adjoint(&g.0, &part(x, 0, n)), 0, &mut result);
        place(&self.second.adjoint(&g.1, &part(x, n, m)), n, &mut result);
        result
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (n, m) = (self.first.dim(), self.second.dim());
        let mut result = SVector::repeat(T::of(0.0));
        place(&self.first.coadjoint(&g.0, &part(mu, 0, n)), 0, &mut result);
        place(&self.second.coadjoint(&g.1, &part(mu, n, m)), n, &mut result);
        result
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        by_factor_transport!(self, x, mu, exp_transport)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_factor!(self, x, mu, dexp_transpose)
    }

    fn dexp_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, SMatrix<T, N, N>) {
        by_factor_with_derivative!(self, x, mu, dexp_transpose_with_derivative)
    }

    fn dexp_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        by_factor!(self, x, p, dexp_inverse_transpose)
    }

    fn casimir_count(&self) -> usize {
        self.first.casimir_count() + self.second.casimir_count()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (n, m) = (self.first.dim(), self.second.dim());
        match index.checked_sub(self.first.casimir_count()) {
            None => self.first.casimir(index, &part(mu, 0, n)),
            Some(index) => self.second.casimir(index, &part(mu, n, m)),
        }
    }

    fn matrix_size(&self) -> usize {
        self.first.matrix_size() + self.second.matrix_size()
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let d = self.first.matrix_size();
        match (row < d, column < d) {
            (true, true) => self.first.matrix_entry(&g.0, row, column),
            (false, false) => self.second.matrix_entry(&g.1, row - d, column - d),
            _ => T::of(0.0),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        let (d, size) = (self.first.matrix_size(), self.matrix_size());
        finite(size, &entry)?;
        for row in 0..size {
            for column in (0..size).filter(|&column| (row < d) != (column < d)) {
                fixed(&entry, (row, column), 0.0)?;
            }
        }
        // As `dyn`, so that products of products do not nest closure types without end.
        let entry: &dyn Fn(usize, usize) -> T = &entry;
        let g = self.first.element_from_matrix(entry)?;
        Ok((g, self.second.element_from_matrix(|i, j| entry(i + d, j + d))?))
    }
}

impl<T, A, B, const N: usize> CayleyGroup for Product<A, B, N>
where
    T: Scalar,
    A: CayleyGroup<Scalar = T>,
    B: CayleyGroup<Scalar = T>,
{
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        by_factor_transport!(self, x, mu, cayley_transport)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = SVector::repeat(T::of(0.0));
        place(&self.first.cayley_inverse(&g.0)?, 0, &mut result);
        place(&self.second.cayley_inverse(&g.1)?, self.first.dim(), &mut result);
        Some(result)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_factor!(self, x, mu, dcay_transpose)
    }

    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, SMatrix<T, N, N>) {
        by_factor_with_derivative!(self, x, mu, dcay_transpose_with_derivative)
    }

    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        by_factor!(self, x, p, dcay_inverse_transpose)
    }
}
