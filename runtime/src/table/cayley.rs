//! The Cayley map in the matrix representation.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::algebra::Algebra;
use super::domain;
use super::group::{Element, TableGroup};
use super::tables::Tables;
use crate::group::CayleyGroup;
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::scalar::Scalar;

/// Tables of an algebra with xξx ∈ 𝔤 for x, ξ ∈ 𝔤.
pub trait CayleyTables: Tables {}

impl<K: CayleyTables> TableGroup<K> {
    /// 1 + s·x as a matrix.
    fn shifted(&self, x: &K::Vector, s: f64) -> Element<K> {
        let size = self.algebra().size;
        square::plus_scaled(size, &self.unit_matrix(), K::Scalar::of(s), &self.matrix_of(x))
    }
}

impl<K: CayleyTables> CayleyGroup for TableGroup<K> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        let size = self.algebra().size;
        let left = square::invert(size, &self.shifted(x, -0.5)).0;
        self.straighten(square::multiply(size, &left, &self.shifted(x, 0.5)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> Self::Scalar {
        let Algebra { dim, cayley, .. } = self.algebra();
        domain::cayley_extent(cayley, dim, x)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        // x/2 = (g − 1)(g + 1)⁻¹
        let size = self.algebra().size;
        let one = K::Scalar::of(1.0);
        let unit = self.unit_matrix();
        let below = square::invert(size, &square::plus_scaled(size, g, one, &unit)).0;
        let above = square::plus_scaled(size, g, -one, &unit);
        let half = square::multiply(size, &above, &below);
        let x = self.coordinates_of(&square::scale(size, &half, K::Scalar::of(2.0)));
        let scale = one / K::Scalar::epsilon().simd_sqrt();
        let reached = x.largest_entry().simd_le(scale).all()
            && (0..self.algebra().dim).all(|i| x[i].all_finite());
        reached.then_some(x)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // ⟨P, (1 − x/2)⁻¹ ξ (1 + x/2)⁻¹⟩ = ⟨(1 − x/2)⁻ᵀ P (1 + x/2)⁻ᵀ, ξ⟩ with ⟨P, ·⟩ = μ on 𝔤
        let size = self.algebra().size;
        let left = square::invert(size, &self.shifted(x, -0.5)).0;
        let right = square::invert(size, &self.shifted(x, 0.5)).0;
        let half = square::transpose_multiply(size, &left, &self.dual_matrix(mu));
        self.products(&square::multiply_transpose(size, &half, &right))
    }
}
