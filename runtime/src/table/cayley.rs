//! The Cayley map in the matrix representation.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::action::Matrix;
use super::algebra::Tables;
use super::group::{Element, TableGroup};
use super::linear;
use crate::group::{CayleyGroup, LieGroup};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Tables of an algebra with xξx ∈ 𝔤 for x, ξ ∈ 𝔤.
pub trait CayleyTables: Tables {}

impl<K: CayleyTables> TableGroup<K> {
    /// 1 + s·x as a matrix.
    fn shifted(&self, x: &K::Vector, s: f64) -> Element<K> {
        let size = self.tables.matrix_size();
        linear::plus_scaled(size, &self.unit_matrix(), K::Scalar::of(s), &self.matrix_of(x))
    }

    /// Q = (1 − x/2)⁻ᵀ P (1 + x/2)⁻ᵀ with ⟨P, ·⟩ = μ on 𝔤, so that (d^R cay_x)ᵀ μ = ⟨Q, ·⟩; with
    /// it the two inverses.
    fn pulled(&self, x: &K::Vector, mu: &K::Vector) -> [Element<K>; 3] {
        let size = self.tables.matrix_size();
        let left = linear::invert(size, &self.shifted(x, -0.5));
        let right = linear::invert(size, &self.shifted(x, 0.5));
        let half = linear::transpose_multiply(size, &left, &self.dual_matrix(mu));
        [linear::multiply_transpose(size, &half, &right), left, right]
    }
}

impl<K: CayleyTables> CayleyGroup for TableGroup<K> {
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        let size = self.tables.matrix_size();
        let left = linear::invert(size, &self.shifted(x, -0.5));
        let g = self.straighten(linear::multiply(size, &left, &self.shifted(x, 0.5)));
        let moved = self.coadjoint(&self.inverse(&g), mu);
        (g, moved)
    }

    #[inline(always)]
    fn cayley_extent(&self, x: &Self::Vector) -> Self::Scalar {
        self.tables.cayley_extent(x)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        // x/2 = (g − 1)(g + 1)⁻¹
        let size = self.tables.matrix_size();
        let one = K::Scalar::of(1.0);
        let unit = self.unit_matrix();
        let below = linear::invert(size, &linear::plus_scaled(size, g, one, &unit));
        let above = linear::plus_scaled(size, g, -one, &unit);
        let half = linear::multiply(size, &above, &below);
        let x = self.coordinates_of(&linear::scale(size, &half, K::Scalar::of(2.0)));
        let scale = one / K::Scalar::epsilon().simd_sqrt();
        let reached = x.largest_entry().simd_le(scale).all()
            && (0..self.tables.dim()).all(|i| x[i].all_finite());
        reached.then_some(x)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let [q, ..] = self.pulled(x, mu);
        self.products(&q)
    }

    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, Matrix<K>) {
        let (dim, size) = (self.tables.dim(), self.tables.matrix_size());
        let [q, left, right] = self.pulled(x, mu);
        let mut derivative = K::Vector::zero_matrix(dim);
        for k in 0..dim {
            // ∂Q/∂xₖ = ½ (1 − x/2)⁻ᵀ eₖᵀ Q − ½ Q eₖᵀ (1 + x/2)⁻ᵀ
            let e = self.matrix_of(&K::Vector::from_entries(dim, |i| {
                K::Scalar::of(if i == k { 0.5 } else { 0.0 })
            }));
            let first = linear::transpose_multiply(size, &e, &q);
            let first = linear::transpose_multiply(size, &left, &first);
            let second = linear::multiply_transpose(size, &q, &e);
            let second = linear::multiply_transpose(size, &second, &right);
            let slope = linear::plus_scaled(size, &first, K::Scalar::of(-1.0), &second);
            let column = self.products(&slope);
            for i in 0..dim {
                derivative[(i, k)] = column[i];
            }
        }
        (self.products(&q), derivative)
    }

    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        // ⟨P, (1 − x/2) ξ (1 + x/2)⟩ = ⟨(1 − x/2)ᵀ P (1 + x/2)ᵀ, ξ⟩
        let size = self.tables.matrix_size();
        let half = linear::transpose_multiply(size, &self.shifted(x, -0.5), &self.dual_matrix(p));
        self.products(&linear::multiply_transpose(size, &half, &self.shifted(x, 0.5)))
    }
}
