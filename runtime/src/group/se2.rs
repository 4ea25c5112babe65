//! SE(2): rigid motions of the plane.

use core::marker::PhantomData;

use nalgebra::{
    Complex, Isometry2, Isometry3, SimdBool, Translation2, Unit, Vector2, Vector3, Vector6,
};

use crate::group::element_error::{ElementError, finite, fixed, within};
use crate::group::entire::{dexp_inverse, entire};
use crate::group::nodes::Rows3;
use crate::group::se3::{Rows6, SE3};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
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

/// The coordinates of se(2) in se(3).
const PLACES: [usize; 3] = [2, 3, 4];

#[inline(always)]
fn lift<T: Scalar>(x: &Vector3<T>) -> Vector6<T> {
    let zero = T::of(0.0);
    Vector6::new(zero, zero, x.x, x.y, x.z, zero)
}

#[inline(always)]
fn drop<T: Scalar>(x: &Vector6<T>) -> Vector3<T> {
    Vector3::from_fn(|i, _| x[PLACES[i]])
}

#[inline(always)]
fn lift_rows<T: Scalar, const M: usize>(x: &Rows3<T, M>) -> Rows6<T, M> {
    let zero = [T::of(0.0); M];
    [zero, zero, x[0], x[1], x[2], zero]
}

#[inline(always)]
fn drop_rows<T: Scalar, const M: usize>(x: &Rows6<T, M>) -> Rows3<T, M> {
    PLACES.map(|place| x[place])
}

/// The motion of the plane that a motion of space keeping the third axis makes.
#[inline(always)]
fn flatten<T: Scalar>(g: &Isometry3<T>) -> Isometry2<T> {
    // (w + iz)² = cos θ + i sin θ, scaled to the unit circle by the quaternion's norm.
    let q = g.rotation.as_ref();
    let t = &g.translation.vector;
    motion(q.w * q.w - q.k * q.k, T::of(2.0) * q.w * q.k, t.x, t.y)
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
        // The translation is (sin ω/ω) v + ((1 − cos ω)/ω) Jv.
        let [cosine, along, b, ..] = entire(x.x * x.x);
        let across = x.x * b;
        motion(cosine, along * x.x, along * x.y - across * x.z, across * x.y + along * x.z)
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let (c, s, x, y) = parts(g);
        let angle = s.simd_atan2(c);
        // V⁻¹ = 1 − ½ω̂ + κ ω̂², κ = (1 − (ω/2) cot(ω/2))/ω².
        let t = angle * angle;
        let along = T::of(1.0) - t * dexp_inverse(t);
        let across = angle * T::of(0.5);
        Some(Vector3::new(angle, along * x + across * y, along * y - across * x))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        Vector3::new(x.z * mu.y - x.y * mu.z, x.x * mu.z, -x.x * mu.y)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (c, s, u, v) = parts(g);
        let (first, second) = (c * mu.y - s * mu.z, s * mu.y + c * mu.z);
        Vector3::new(mu.x + u * second - v * first, first, second)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        drop(&SE3::new().dexp_transpose(&lift(x), &lift(mu)))
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        let finite = (x.y + x.z) * T::of(0.0);
        (x.x * x.x).times_plus(T::of(1.0 / (core::f64::consts::PI * core::f64::consts::PI)), finite)
    }

    fn node_momenta<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        degree: usize,
    ) -> Rows3<T, M> {
        drop_rows(&SE3::new().node_momenta(&lift_rows(x), &lift_rows(p), degree))
    }

    fn node_rates<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        omega: &Rows3<T, M>,
        degree: usize,
    ) -> [Rows3<T, M>; 2] {
        let [x, p, omega] = [x, p, omega].map(lift_rows);
        SE3::new().node_rates(&x, &p, &omega, degree).each_ref().map(drop_rows)
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
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        flatten(&SE3::new().cayley(&lift(x)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        (x.x * x.x).times_plus(T::of(0.25), (x.y + x.z) * T::of(0.0))
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

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        drop(&SE3::new().dcay_transpose(&lift(x), &lift(mu)))
    }
}
