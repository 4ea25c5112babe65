//! SU(2): unit quaternions, the double cover of SO(3).

use core::marker::PhantomData;

use nalgebra::{SimdBool, UnitQuaternion, Vector3};

use crate::group::element_error::{ElementError, finite, fixed, within};
use crate::group::entire::log_factor;
use crate::group::nodes::Rows3;
use crate::group::so3::{SO3, cross, dot, quaternion};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::scalar::Scalar;

/// The group SU(2), elements as unit quaternions; q and −q are different here.
///
/// Basis: e_k = −iσ_k/2 with the Pauli matrices, so that [e₁, e₂] = e₃ and cyclic, and brackets,
/// Ad and Ad\* are those of [`SO3`]. Matrices: the complex 2×2 matrix a + ib as the real 4×4
/// matrix ((a, −b), (b, a)). Casimir: |μ|². Both charts; the Cayley map is that of the 2×2
/// matrices, which differs from SO(3)'s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SU2<T = f64>(PhantomData<T>);

impl<T> SU2<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// A derived impl would ask for `T: Default`.
impl<T> Default for SU2<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FixedDimension for SU2<T> {
    const DIM: usize = 3;
}

type V<T> = Vector3<T>;

impl<T: Scalar> LieGroup for SU2<T> {
    type Scalar = T;
    type Vector = V<T>;
    type Element = UnitQuaternion<T>;

    fn dim(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        SO3::new().identity()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        SO3::new().compose(g, h)
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.conjugate()
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        SO3::new().exp(x)
    }

    /// The logarithm with |x| < 2π; `None` at −1, which every direction reaches.
    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let q = g.as_ref();
        let u = V::new(q.i, q.j, q.k);
        let squared = dot(&u, &u);
        if q.w.simd_lt(T::of(0.0)).any() && squared.simd_le(T::epsilon() * T::epsilon()).any() {
            return None;
        }
        Some(u * log_factor(q.w, squared))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        SO3::new().ad_star(x, mu)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        SO3::new().coadjoint(g, mu)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        SO3::new().dexp_transpose(x, mu)
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        SO3::new().exp_extent(x)
    }

    #[inline(always)]
    fn node_momenta<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        degree: usize,
    ) -> Rows3<T, M> {
        SO3::new().node_momenta(x, p, degree)
    }

    #[inline(always)]
    fn node_rates<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        omega: &Rows3<T, M>,
        degree: usize,
    ) -> [Rows3<T, M>; 2] {
        SO3::new().node_rates(x, p, omega, degree)
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        (g.as_ref().norm_squared() - T::of(1.0)).simd_abs()
    }

    fn casimir_count(&self) -> usize {
        1
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        SO3::new().casimir(index, mu)
    }

    fn matrix_size(&self) -> usize {
        4
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        // w − i(xσ₁ + yσ₂ + zσ₃): real part ((w, −y), (y, w)), imaginary part ((−z, −x), (−x, z)).
        let q = g.as_ref();
        let real = [[q.w, -q.j], [q.j, q.w]];
        let imaginary = [[-q.k, -q.i], [-q.i, q.k]];
        match (row / 2, column / 2) {
            (0, 1) => -imaginary[row % 2][column % 2],
            (1, 0) => imaginary[row % 2][column % 2],
            _ => real[row % 2][column % 2],
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(4, &entry)?;
        let u = V::new(-entry(2, 1), entry(1, 0), -entry(2, 0));
        let w = entry(0, 0);
        let norm = (w * w + dot(&u, &u)).simd_sqrt();
        let defect = (norm - T::of(1.0)).simd_abs();
        if !within(defect, T::of(1.0)) {
            return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
        }
        let q = quaternion(w / norm, &(u / norm));
        for row in 0..4 {
            for column in 0..4 {
                let expected = self.matrix_entry(&q, row, column);
                fixed(&|i, j| entry(i, j) - expected, (row, column), 0.0)?;
            }
        }
        Ok(q)
    }
}

impl<T: Scalar> CayleyGroup for SU2<T> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        // (1 − a)⁻¹(1 + a) = (1 + a)²/(1 + |a|²) for the pure quaternion a = x/4.
        let a = x * T::of(0.25);
        let n = dot(&a, &a);
        let factor = T::of(1.0) / (T::of(1.0) + n);
        quaternion((T::of(1.0) - n) * factor, &(a * (T::of(2.0) * factor)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        // Eigenvalues of x are ±i|x|/2.
        dot(x, x) * T::of(0.0625)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        let q = g.as_ref();
        let below = T::of(1.0) + q.w;
        if below.simd_le(T::epsilon()).any() {
            return None; // −1: cay never reaches it
        }
        Some(V::new(q.i, q.j, q.k) * (T::of(4.0) / below))
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // ((1 − |a|²)μ + 2(a·μ)a + 2 μ×a)/(1 + |a|²)², a = x/4
        let a = x * T::of(0.25);
        let n = dot(&a, &a);
        let (above, below) = (T::of(1.0) - n, T::of(1.0) + n);
        (mu * above + (a * dot(&a, mu) + cross(mu, &a)) * T::of(2.0)) / (below * below)
    }
}
