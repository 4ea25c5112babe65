//! The Heisenberg group: upper unitriangular 3×3 matrices.

use core::marker::PhantomData;

use nalgebra::Vector3;

use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::scalar::Scalar;

/// The Heisenberg group, elements as the entries (g₁₂, g₂₃, g₁₃) of an upper unitriangular matrix.
///
/// Basis: e₁ = E₁₂, e₂ = E₂₃, e₃ = E₁₃ with [e₁, e₂] = e₃, the centre. Casimir: μ₃. Both charts,
/// which agree here: cubes of the matrices vanish, so that cay = exp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heisenberg<T = f64>(PhantomData<T>);

impl<T> Heisenberg<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// A derived impl would ask for `T: Default`.
impl<T> Default for Heisenberg<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FixedDimension for Heisenberg<T> {
    const DIM: usize = 3;
}

impl<T: Scalar> LieGroup for Heisenberg<T> {
    type Scalar = T;
    type Vector = Vector3<T>;
    type Element = Vector3<T>;

    fn dim(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        Vector3::repeat(T::of(0.0))
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        Vector3::new(g.x + h.x, g.y + h.y, g.z + h.z + g.x * h.y)
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        Vector3::new(-g.x, -g.y, g.x * g.y - g.z)
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        Vector3::new(x.x, x.y, x.z + x.x * x.y * T::of(0.5))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        Some(Vector3::new(g.x, g.y, g.z - g.x * g.y * T::of(0.5)))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        Vector3::new(-x.y * mu.z, x.x * mu.z, T::of(0.0))
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        Vector3::new(mu.x + g.y * mu.z, mu.y - g.x * mu.z, mu.z)
    }

    /// μ + ½ ad_xᵀ μ: higher powers of ad vanish.
    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        mu + self.ad_star(x, mu) * T::of(0.5)
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        // Nilpotent: exp is a chart everywhere; x must be finite.
        (x.x + x.y + x.z) * T::of(0.0)
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        (g.x + g.y + g.z) * T::of(0.0)
    }

    fn casimir_count(&self) -> usize {
        1
    }

    fn casimir(&self, _index: usize, mu: &Self::Vector) -> T {
        mu.z
    }

    fn matrix_size(&self) -> usize {
        3
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        match (row, column) {
            (0, 1) => g.x,
            (1, 2) => g.y,
            (0, 2) => g.z,
            _ => T::of(if row == column { 1.0 } else { 0.0 }),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(3, &entry)?;
        for row in 0..3 {
            for column in 0..=row {
                fixed(&entry, (row, column), if row == column { 1.0 } else { 0.0 })?;
            }
        }
        Ok(Vector3::new(entry(0, 1), entry(1, 2), entry(0, 2)))
    }
}

impl<T: Scalar> CayleyGroup for Heisenberg<T> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        self.exp(x)
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        self.exp_extent(x)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        self.log(g)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.dexp_transpose(x, mu)
    }
}
