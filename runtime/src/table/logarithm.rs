//! The principal logarithm: inverse scaling and squaring, then Newton steps in the group.
//!
//! N. J. Higham, *Functions of Matrices* (SIAM 2008), section 11.5; square roots by the product
//! form of the Denman–Beavers iteration, equation (6.29) there.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::group::{Element, TableGroup};
use super::tables::Tables;
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::Scalar;

/// Square roots taken at most; more than enough for any finite element near which log exists.
const ROOTS: u32 = 64;
/// Iterations for one square root; quadratic, so that 20 reach rounding from far away.
const ROOT_ITERATIONS: u32 = 20;

impl<K: Tables> TableGroup<K> {
    pub(super) fn logarithm(&self, g: &Element<K>) -> Option<K::Vector> {
        if self.algebra().facts.dependent.is_some() {
            return None;
        }
        let dim = self.algebra().dim;
        let mut x = self.coordinates_of(&self.matrix_logarithm(g)?);
        // The roots lose a few digits; one or two Newton steps in the group bring them back:
        // g = exp(r)·exp(x) and x + (d^R exp_x)⁻¹ r is the better logarithm.
        let one = K::Scalar::of(1.0);
        for _ in 0..2 {
            let back = self.exp(&K::Vector::from_entries(dim, |i| -x[i]));
            let rest = square::multiply(self.algebra().size, g, &back);
            let rest = square::plus_scaled(self.algebra().size, &rest, -one, &self.unit_matrix());
            let r = self.coordinates_of(&rest);
            // Row j of d^R exp_x: the transpose applied to a basis vector.
            let mut turn = K::Vector::zero_matrix(dim);
            for j in 0..dim {
                let row = self.dexp_transpose(&x, &K::Vector::unit(dim, j));
                for i in 0..dim {
                    turn[(j, i)] = row[i];
                }
            }
            let better = K::Vector::solve(&turn, &r);
            x = K::Vector::from_entries(dim, |i| x[i] + better[i]);
        }
        // Only a logarithm that gives g back is one.
        let size = self.algebra().size;
        let again = self.exp(&x);
        let difference = square::plus_scaled(size, &again, -one, g);
        let scale = square::largest_entry(size, g) + one;
        let tolerance = K::Scalar::epsilon().simd_sqrt() * scale;
        square::largest_entry(size, &difference).simd_le(tolerance).all().then_some(x)
    }

    /// The principal logarithm of a matrix to about half the digits or better; `None` where the
    /// square roots do not converge (an eigenvalue on the negative axis).
    fn matrix_logarithm(&self, g: &Element<K>) -> Option<Element<K>> {
        let size = self.algebra().size;
        let one = K::Scalar::of(1.0);
        let unit = self.unit_matrix();
        let mut root = g.clone();
        let mut scale = one;
        let mut roots = 0;
        let rest = loop {
            let rest = square::plus_scaled(size, &root, -one, &unit);
            let norm = square::row_sum_norm(size, &rest);
            if norm.simd_le(K::Scalar::of(0.3)).all() {
                break rest;
            }
            if roots == ROOTS || !norm.all_finite() {
                return None;
            }
            root = self.square_root(&root);
            scale += scale;
            roots += 1;
        };
        // log A = 2 artanh((A − 1)(A + 1)⁻¹)
        let sum = square::plus_scaled(size, &root, one, &unit);
        let z = square::multiply(size, &rest, &square::invert(size, &sum).0);
        let square = square::multiply(size, &z, &z);
        let mut power = z.clone();
        let mut total = z;
        for k in 1..20 {
            power = square::multiply(size, &power, &square);
            let factor = K::Scalar::of(1.0 / (2 * k + 1) as f64);
            total = square::plus_scaled(size, &total, factor, &power);
        }
        Some(square::scale(size, &total, scale + scale))
    }

    fn square_root(&self, a: &Element<K>) -> Element<K> {
        let size = self.algebra().size;
        let (one, half) = (K::Scalar::of(1.0), K::Scalar::of(0.5));
        let unit = self.unit_matrix();
        let mut m = a.clone();
        let mut root = a.clone();
        for _ in 0..ROOT_ITERATIONS {
            let inverse = square::invert(size, &m).0;
            let factor = square::plus_scaled(size, &unit, one, &inverse);
            root = square::scale(size, &square::multiply(size, &root, &factor), half);
            // M ← ½ (1 + ½ (M + M⁻¹))
            let sum = square::plus_scaled(size, &m, one, &inverse);
            m = square::scale(size, &square::plus_scaled(size, &unit, half, &sum), half);
            let change = square::plus_scaled(size, &m, -one, &unit);
            let limit = K::Scalar::epsilon() * K::Scalar::of(8.0);
            if square::largest_entry(size, &change).simd_le(limit).all() {
                break;
            }
        }
        root
    }
}
