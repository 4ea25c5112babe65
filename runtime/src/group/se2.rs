//! SE(2): rigid motions of the plane.

use core::marker::PhantomData;

use coadjoint_geometry::angle::Length;
use coadjoint_geometry::group::Group;
use coadjoint_geometry::motion::Motion;
use coadjoint_geometry::plane::Plane;
use nalgebra::{Complex, Isometry2, SimdBool, Translation2, Unit, Vector2, Vector3};

use crate::group::arrays::{array, by_formulas, cayley_by_formulas, nodes, rows};
use crate::group::element_error::{ElementError, finite, fixed, within};
use crate::group::log::dexp_inverse;
use crate::group::{CayleyGroup, FixedDimension, LieGroup, Rows};
use crate::number::Scalar;

/// The Euclidean group of the plane, elements as a rotation (unit complex number) and a
/// translation.
///
/// Basis: e₁ the rotation, e₂ and e₃ the translations, with [e₁, e₂] = e₃, [e₁, e₃] = −e₂.
/// Matrices: 3×3, rotation and translation column. Casimir: μ₂² + μ₃². Both charts. The
/// differentials are those of SE(3), whose subgroup this is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SE2<T = f64>(PhantomData<T>);

impl<T> SE2<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// A derived impl would ask for `T: Default`.
impl<T> Default for SE2<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FixedDimension for SE2<T> {
    const DIM: usize = 3;
}

/// The motion of the plane that a motion of space keeping the third axis makes.
#[inline(always)]
fn flatten<T: Scalar>(g: Motion<T>) -> Isometry2<T> {
    // (w + iz)² = cos θ + i sin θ, scaled to the unit circle by the quaternion's norm.
    let ([w, _, _, k], [x, y, _]) = (g.turn.quaternion(), g.place);
    motion(w * w - k * k, T::of(2.0) * w * k, x, y)
}

#[inline(always)]
fn motion<T: Scalar>(cosine: T, sine: T, x: T, y: T) -> Isometry2<T> {
    Isometry2 {
        rotation: Unit::new_unchecked(Complex { re: cosine, im: sine }),
        translation: Translation2 { vector: Vector2::new(x, y) },
    }
}

#[inline(always)]
fn parts<T: Scalar>(g: &Isometry2<T>) -> (T, T, T, T) {
    (g.rotation.re, g.rotation.im, g.translation.vector.x, g.translation.vector.y)
}

impl<T: Scalar> LieGroup for SE2<T> {
    type Scalar = T;
    type Vector = Vector3<T>;
    type Element = Isometry2<T>;

    by_formulas!(Plane);

    fn dim(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        motion(T::of(1.0), T::of(0.0), T::of(0.0), T::of(0.0))
    }

    /// The product; the rotation is pulled back onto the unit circle to first order.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let ((c, s, x, y), (d, r, u, v)) = (parts(g), parts(h));
        let (cosine, sine) = (c * d - s * r, c * r + s * d);
        let factor = T::of(1.5) - T::of(0.5) * (cosine * cosine + sine * sine);
        motion(cosine * factor, sine * factor, c * u - s * v + x, s * u + c * v + y)
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        let (c, s, x, y) = parts(g);
        motion(c, -s, -(c * x + s * y), s * x - c * y)
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        flatten(Plane::exp(array(x), Length::Any))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let (c, s, x, y) = parts(g);
        let angle = s.simd_atan2(c);
        // V⁻¹ = 1 − ½ω̂ + κ ω̂², κ = (1 − (ω/2) cot(ω/2))/ω².
        let across = angle * T::of(0.5);
        let along = T::of(1.0) - angle * angle * dexp_inverse([across]);
        Some(Vector3::new(angle, along * x + across * y, along * y - across * x))
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (c, s, u, v) = parts(g);
        let (first, second) = (c * mu.y - s * mu.z, s * mu.y + c * mu.z);
        Vector3::new(mu.x + u * second - v * first, first, second)
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        let turn = g.rotation.complex();
        let off = (turn.re * turn.re + turn.im * turn.im - T::of(1.0)).simd_abs();
        off + (g.translation.x + g.translation.y) * T::of(0.0)
    }

    fn casimir_count(&self) -> usize {
        1
    }

    fn casimir(&self, _index: usize, mu: &Self::Vector) -> T {
        mu.y * mu.y + mu.z * mu.z
    }

    fn matrix_size(&self) -> usize {
        3
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let (c, s, x, y) = parts(g);
        match (row, column) {
            (0, 0) | (1, 1) => c,
            (1, 0) => s,
            (0, 1) => -s,
            (0, 2) => x,
            (1, 2) => y,
            _ => T::of(if column == 2 { 1.0 } else { 0.0 }),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(3, &entry)?;
        for column in 0..3 {
            fixed(&entry, (2, column), if column == 2 { 1.0 } else { 0.0 })?;
        }
        let (cosine, sine) = (entry(0, 0), entry(1, 0));
        let norm = (cosine * cosine + sine * sine).simd_sqrt();
        let defect = (norm - T::of(1.0))
            .simd_abs()
            .simd_max((entry(0, 1) + sine).simd_abs())
            .simd_max((entry(1, 1) - cosine).simd_abs());
        if !within(defect, T::of(1.0)) {
            return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
        }
        Ok(motion(cosine / norm, sine / norm, entry(0, 2), entry(1, 2)))
    }
}

impl<T: Scalar> CayleyGroup for SE2<T> {
    cayley_by_formulas!(Plane);

    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        flatten(Plane::cayley(array(x)))
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        // ω/2 = tan(θ/2) = sin θ/(1 + cos θ), v = (1 − ω̂/2) t
        let (c, s, x, y) = parts(g);
        let below = T::of(1.0) + c;
        if !below.simd_gt(T::epsilon()).all() {
            return None; // a half turn: cay never reaches it
        }
        let half = s / below;
        Some(Vector3::new(half + half, x + half * y, y - half * x))
    }
}
