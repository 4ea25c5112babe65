//! Group elements from a user's matrix, checked.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::group::{Element, TableGroup};
use super::tables::Tables;
use crate::group::LieGroup;
use crate::group::element_error::{ElementError, within};
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::scalar::Scalar;

impl<K: Tables> TableGroup<K> {
    /// Reads an element: finite, invertible, orthogonal where the group is, of the right
    /// determinant, and acting on 𝔤 as an element does (conjugation keeps 𝔤; an adjoint matrix
    /// keeps the bracket). For groups that are not the whole normaliser of their algebra this is
    /// necessary, not sufficient.
    pub(super) fn member(
        &self,
        entry: impl Fn(usize, usize) -> K::Scalar,
    ) -> Result<Element<K>, ElementError> {
        let size = self.algebra().size;
        let mut g = self.zero_matrix();
        for row in 0..size {
            for column in 0..size {
                let value = entry(row, column);
                if !value.all_finite() {
                    return Err(ElementError::NonFinite { row, column });
                }
                g[(row, column)] = value;
            }
        }
        let one = K::Scalar::of(1.0);
        let scale = square::largest_entry(size, &g);
        if self.algebra().facts.orthogonal {
            let gram = square::transpose_multiply(size, &g, &g);
            let difference = square::plus_scaled(size, &gram, -one, &self.unit_matrix());
            let defect = square::largest_entry(size, &difference);
            if !within(defect, one) {
                return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
            }
        }
        let determinant = square::invert(size, &g).1;
        let traceless = self.algebra().facts.traceless && !self.is_adjoint();
        let fits = if traceless {
            within((determinant - one).simd_abs(), one + scale)
        } else {
            determinant.simd_gt(K::Scalar::of(0.0)).all()
        };
        if !fits {
            let required = if traceless {
                "the group needs determinant 1"
            } else {
                "the connected group needs a positive one"
            };
            let determinant = determinant.largest_lane();
            return Err(ElementError::Determinant { determinant, required });
        }
        let g = self.straighten(self.straighten(g));
        let defect = self.action_defect(&g);
        let inverse = square::largest_entry(size, &self.inverse(&g));
        if !within(defect, one + scale * inverse) {
            return Err(ElementError::NotInGroup { defect: defect.largest_lane() });
        }
        Ok(g)
    }

    /// How far g is from acting on 𝔤 by automorphisms.
    fn action_defect(&self, g: &Element<K>) -> K::Scalar {
        let (dim, size) = (self.algebra().dim, self.algebra().size);
        let minus = K::Scalar::of(-1.0);
        let mut defect = K::Scalar::of(0.0);
        let unit = |i| K::Vector::unit(dim, i);
        if self.is_adjoint() {
            for i in 0..dim {
                for j in i + 1..dim {
                    let moved = self.adjoint(g, &self.bracket(&unit(i), &unit(j)));
                    let bracket =
                        self.bracket(&self.adjoint(g, &unit(i)), &self.adjoint(g, &unit(j)));
                    let difference = K::Vector::from_entries(dim, |k| moved[k] - bracket[k]);
                    defect = defect.simd_max(difference.largest_entry());
                }
            }
            return defect;
        }
        let back = self.inverse(g);
        for i in 0..dim {
            let moved = self.tables.multiply(g, &self.matrix_of(&unit(i)));
            let moved = self.tables.multiply(&moved, &back);
            let inside = self.matrix_of(&self.coordinates_of(&moved));
            let outside = square::plus_scaled(size, &moved, minus, &inside);
            defect = defect.simd_max(square::row_sum_norm(size, &outside));
        }
        defect
    }
}
