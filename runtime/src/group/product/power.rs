//! Powers of a group: spin chains, clusters of bodies.

use core::fmt;
use core::marker::PhantomData;

use nalgebra::{SMatrix, SVector};

use super::{part, place, place_block};
use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::scalar::Scalar;

/// The power G^COPIES of a group of fixed dimension, `N` = COPIES · dim G (checked by the
/// compiler).
///
/// Elements are arrays; coordinates are those of the copies in order; matrices are block diagonal;
/// Casimirs are those of the first copy, then of the second, and so on. Both charts where G has
/// them.
///
/// ```
/// use coadjoint::{LieGroup, groups::Power, SO3};
///
/// let spins = Power::<SO3, 4, 12>::new();
/// assert_eq!((spins.dim(), spins.casimir_count()), (12, 4));
/// ```
pub struct Power<G, const COPIES: usize, const N: usize>(PhantomData<G>);

impl<G: FixedDimension, const COPIES: usize, const N: usize> Power<G, COPIES, N> {
    const DIMENSIONS_MULTIPLY: () = assert!(
        COPIES * G::DIM == N && COPIES > 0,
        "N must be COPIES times the factor's dimension"
    );

    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        const { Self::DIMENSIONS_MULTIPLY };
        Self(PhantomData)
    }
}

impl<G: FixedDimension, const COPIES: usize, const N: usize> Default for Power<G, COPIES, N> {
    fn default() -> Self {
        Self::new()
    }
}

// Derived impls would ask the same of the factors.
impl<G, const COPIES: usize, const N: usize> Clone for Power<G, COPIES, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<G, const COPIES: usize, const N: usize> Copy for Power<G, COPIES, N> {}

impl<G, const COPIES: usize, const N: usize> fmt::Debug for Power<G, COPIES, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Power")
    }
}

impl<G, const COPIES: usize, const N: usize> FixedDimension for Power<G, COPIES, N> {
    const DIM: usize = N;
}

/// Applies a function of G to every part of x and y.
macro_rules! by_copy {
    ($x:ident, $y:ident, $method:ident) => {{
        let n = G::default().dim();
        let mut result = SVector::repeat(T::of(0.0));
        for copy in 0..COPIES {
            let at = copy * n;
            let value = G::default().$method(&part($x, at, n), &part($y, at, n));
            place(&value, at, &mut result);
        }
        result
    }};
}

/// The same for functions with a derivative.
macro_rules! by_copy_with_derivative {
    ($x:ident, $mu:ident, $method:ident) => {{
        let n = G::default().dim();
        let mut value = SVector::repeat(T::of(0.0));
        let mut slope = SMatrix::repeat(T::of(0.0));
        for copy in 0..COPIES {
            let at = copy * n;
            let (p, d) = G::default().$method(&part($x, at, n), &part($mu, at, n));
            place(&p, at, &mut value);
            place_block::<T, G::Vector, N>(&d, at, n, &mut slope);
        }
        (value, slope)
    }};
}

/// The same for the transport of a chart.
macro_rules! by_copy_transport {
    ($x:ident, $mu:ident, $method:ident) => {{
        let n = G::default().dim();
        let mut moved = SVector::repeat(T::of(0.0));
        let elements = core::array::from_fn(|copy| {
            let at = copy * n;
            let (g, nu) = G::default().$method(&part($x, at, n), &part($mu, at, n));
            place(&nu, at, &mut moved);
            g
        });
        (elements, moved)
    }};
}

impl<T, G, const COPIES: usize, const N: usize> LieGroup for Power<G, COPIES, N>
where
    T: Scalar,
    G: LieGroup<Scalar = T> + Default,
{
    type Scalar = T;
    type Vector = SVector<T, N>;
    type Element = [G::Element; COPIES];

    #[inline(always)]
    fn dim(&self) -> usize {
        N
    }

    fn identity(&self) -> Self::Element {
        core::array::from_fn(|_| G::default().identity())
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        core::array::from_fn(|copy| G::default().compose(&g[copy], &h[copy]))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        core::array::from_fn(|copy| G::default().inverse(&g[copy]))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let n = G::default().dim();
        core::array::from_fn(|copy| G::default().exp(&part(x, copy * n, n)))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = SVector::repeat(T::of(0.0));
        for (copy, g) in g.iter().enumerate() {
            place(&G::default().log(g)?, copy * G::default().dim(), &mut result);
        }
        Some(result)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        by_copy!(x, y, bracket)
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_copy!(x, mu, ad_star)
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        let n = G::default().dim();
        let mut result = SVector::repeat(T::of(0.0));
        for (copy, g) in g.iter().enumerate() {
            place(&G::default().adjoint(g, &part(x, copy * n, n)), copy * n, &mut result);
        }
        result
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let n = G::default().dim();
        let mut result = SVector::repeat(T::of(0.0));
        for (copy, g) in g.iter().enumerate() {
            place(&G::default().coadjoint(g, &part(mu, copy * n, n)), copy * n, &mut result);
        }
        result
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        by_copy_transport!(x, mu, exp_transport)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_copy!(x, mu, dexp_transpose)
    }

    fn dexp_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, SMatrix<T, N, N>) {
        by_copy_with_derivative!(x, mu, dexp_transpose_with_derivative)
    }

    fn dexp_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        by_copy!(x, p, dexp_inverse_transpose)
    }

    #[inline(always)]
    fn exp_extent(&self, x: &Self::Vector) -> T {
        let n = G::default().dim();
        (0..COPIES).fold(T::of(0.0), |extent, copy| {
            extent.worse(G::default().exp_extent(&part(x, copy * n, n)))
        })
    }

    #[inline(always)]
    fn element_defect(&self, g: &Self::Element) -> T {
        g.iter().fold(T::of(0.0), |defect, g| defect.worse(G::default().element_defect(g)))
    }

    fn casimir_count(&self) -> usize {
        COPIES * G::default().casimir_count()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (n, each) = (G::default().dim(), G::default().casimir_count());
        if index >= COPIES * each {
            return T::of(0.0);
        }
        G::default().casimir(index % each, &part(mu, index / each * n, n))
    }

    fn matrix_size(&self) -> usize {
        COPIES * G::default().matrix_size()
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let d = G::default().matrix_size();
        if row / d != column / d {
            return T::of(0.0);
        }
        G::default().matrix_entry(&g[row / d], row % d, column % d)
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        let (d, size) = (G::default().matrix_size(), self.matrix_size());
        finite(size, &entry)?;
        for row in 0..size {
            for column in (0..size).filter(|&column| row / d != column / d) {
                fixed(&entry, (row, column), 0.0)?;
            }
        }
        // As `dyn`, so that powers of powers do not nest closure types without end.
        let entry: &dyn Fn(usize, usize) -> T = &entry;
        let mut elements = self.identity();
        for (copy, element) in elements.iter_mut().enumerate() {
            *element =
                G::default().element_from_matrix(|i, j| entry(copy * d + i, copy * d + j))?;
        }
        Ok(elements)
    }
}

impl<T, G, const COPIES: usize, const N: usize> CayleyGroup for Power<G, COPIES, N>
where
    T: Scalar,
    G: CayleyGroup<Scalar = T> + Default,
{
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        by_copy_transport!(x, mu, cayley_transport)
    }

    #[inline(always)]
    fn cayley_extent(&self, x: &Self::Vector) -> T {
        let n = G::default().dim();
        (0..COPIES).fold(T::of(0.0), |extent, copy| {
            extent.worse(G::default().cayley_extent(&part(x, copy * n, n)))
        })
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = SVector::repeat(T::of(0.0));
        for (copy, g) in g.iter().enumerate() {
            place(&G::default().cayley_inverse(g)?, copy * G::default().dim(), &mut result);
        }
        Some(result)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        by_copy!(x, mu, dcay_transpose)
    }

    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, SMatrix<T, N, N>) {
        by_copy_with_derivative!(x, mu, dcay_transpose_with_derivative)
    }

    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        by_copy!(x, p, dcay_inverse_transpose)
    }
}
