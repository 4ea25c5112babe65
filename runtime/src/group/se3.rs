//! SE(3): rigid motions of space.

mod cayley;

use core::marker::PhantomData;

use nalgebra::{Isometry3, Matrix3, Matrix6, Translation3, Vector3, Vector6};

use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::so3::{
    SO3, cross, dexp_with_derivative, difference, dot, kernel, plus, quaternion, rotate_back,
    rotation_from, scaled, sum,
};
use crate::group::{FixedDimension, LieGroup};
use crate::number::scalar::Scalar;

/// The Euclidean group SE(3), elements as a rotation (unit quaternion) and a translation.
///
/// Coordinates x = (ω, v): three rotations about the axes, then three translations along them; on
/// the dual μ = (Π, Γ), the angular and the linear momentum (for a heavy top, the momentum and the
/// advected vertical). Brackets: [(ω, v), (η, w)] = (ω×η, ω×w − η×v). Matrices: 4×4, rotation and
/// translation column. Ad\*_g (Π, Γ) = (RΠ + t×RΓ, RΓ). Casimirs: |Γ|², Π·Γ. Both charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SE3<T = f64>(PhantomData<T>);

impl<T> SE3<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

// A derived impl would ask for `T: Default`.
impl<T> Default for SE3<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> FixedDimension for SE3<T> {
    const DIM: usize = 6;
}

type V<T> = Vector3<T>;

#[inline(always)]
fn split<T: Scalar>(x: &Vector6<T>) -> (V<T>, V<T>) {
    (V::new(x[0], x[1], x[2]), V::new(x[3], x[4], x[5]))
}

#[inline(always)]
fn join<T: Scalar>(a: &V<T>, b: &V<T>) -> Vector6<T> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// The matrix with blocks [a, b; c, 0].
#[inline(always)]
fn blocks<T: Scalar>(a: &Matrix3<T>, b: &Matrix3<T>, c: &Matrix3<T>) -> Matrix6<T> {
    let mut result = Matrix6::repeat(T::of(0.0));
    for i in 0..3 {
        for j in 0..3 {
            result[(i, j)] = a[(i, j)];
            result[(i, j + 3)] = b[(i, j)];
            result[(i + 3, j)] = c[(i, j)];
        }
    }
    result
}

/// a·v
#[inline(always)]
fn applied<T: Scalar>(a: &Matrix3<T>, v: &V<T>) -> V<T> {
    let entry = |i: usize| a[(i, 2)].times_plus(v.z, a[(i, 1)].times_plus(v.y, a[(i, 0)] * v.x));
    V::new(entry(0), entry(1), entry(2))
}

/// R(q) v
#[inline(always)]
fn rotate<T: Scalar>(g: &Isometry3<T>, v: &V<T>) -> V<T> {
    let q = g.rotation.as_ref();
    rotate_back(q.w, &V::new(-q.i, -q.j, -q.k), v)
}

/// R(q)ᵀ v
#[inline(always)]
fn unrotate<T: Scalar>(g: &Isometry3<T>, v: &V<T>) -> V<T> {
    let q = g.rotation.as_ref();
    rotate_back(q.w, &V::new(q.i, q.j, q.k), v)
}

#[inline(always)]
fn isometry<T: Scalar>(rotation: nalgebra::UnitQuaternion<T>, t: V<T>) -> Isometry3<T> {
    Isometry3 { rotation, translation: Translation3 { vector: t } }
}

/// `to` and the derivative in ω of D(ω, Γ)v, where D(ω, Γ) is that of f(ω) = (d^R exp_ω)ᵀ Γ: the second
/// derivative of f, once applied to v.
///
/// With f = Γ + b g + c g×ω, g = Γ×ω, and b, c functions of t = |ω|²; collected by how the second
/// direction u enters: through ω·u, through v·u, in a cross product, and as itself.
#[inline(always)]
fn bend<T: Scalar>(
    to: &Matrix3<T>,
    k: &kernel::Dexp<T>,
    k2: &kernel::DexpCurvature<T>,
    omega: &V<T>,
    gamma: &V<T>,
    v: &V<T>,
) -> Matrix3<T> {
    let two = T::of(2.0);
    let g = cross(gamma, omega);
    let gg = cross(&g, omega);
    let gv = cross(gamma, v);
    let m = sum(&cross(&gv, omega), &cross(&g, v));
    let s2 = two * dot(omega, v);
    let along = plus(&scaled(k.b_slope, &g), k.c_slope, &gg);
    let along2 = plus(&scaled(k2.b, &g), k2.c, &gg);
    let by_omega = plus(&plus(&scaled(k.b_slope, &gv), k.c_slope, &m), s2, &along2);
    let by_omega = plus(&scaled(two, &by_omega), -(s2 * k.c_slope), gamma);
    let by_v = plus(&scaled(two, &along), -k.c, gamma);
    let turn = plus(&scaled(k.c, &gv), s2, &plus(&scaled(k.b_slope, gamma), k.c_slope, &g));
    let diagonal = k.c * dot(gamma, v) + s2 * k.c_slope * dot(gamma, omega);
    let entry = |i: usize, j: usize, turned: T| {
        by_v[i].times_plus(v[j], by_omega[i].times_plus(omega[j], to[(i, j)] + turned))
    };
    Matrix3::new(
        entry(0, 0, diagonal),
        entry(0, 1, -turn.z),
        entry(0, 2, turn.y),
        entry(1, 0, turn.z),
        entry(1, 1, diagonal),
        entry(1, 2, -turn.x),
        entry(2, 0, -turn.y),
        entry(2, 1, turn.x),
        entry(2, 2, diagonal),
    )
}

impl<T: Scalar> LieGroup for SE3<T> {
    type Scalar = T;
    type Vector = Vector6<T>;
    type Element = Isometry3<T>;

    #[inline(always)]
    fn dim(&self) -> usize {
        6
    }

    #[inline(always)]
    fn identity(&self) -> Self::Element {
        isometry(SO3::new().identity(), V::repeat(T::of(0.0)))
    }

    /// The product; its rotation is kept on the unit sphere as SO(3)'s is.
    #[inline(always)]
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let t = sum(&rotate(g, &h.translation.vector), &g.translation.vector);
        isometry(SO3::new().compose(&g.rotation, &h.rotation), t)
    }

    #[inline(always)]
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        isometry(g.rotation.conjugate(), -unrotate(g, &g.translation.vector))
    }

    #[inline(always)]
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (omega, v) = split(x);
        let t = dot(&omega, &omega);
        let half = kernel::half_angle(t);
        let k = kernel::dexp(t);
        let once = cross(&omega, &v);
        let translation = plus(&plus(&v, k.b, &once), k.c, &cross(&omega, &once));
        isometry(quaternion(half.cosine, &scaled(half.sine_over_angle, &omega)), translation)
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let omega = SO3::new().log(&g.rotation)?;
        let c = kernel::dexp_inverse(dot(&omega, &omega));
        let t = &g.translation.vector;
        let once = cross(&omega, t);
        Some(join(&omega, &(t - once * T::of(0.5) + cross(&omega, &once) * c)))
    }

    #[inline(always)]
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let ((omega, v), (eta, w)) = (split(x), split(y));
        join(&cross(&omega, &eta), &(cross(&omega, &w) - cross(&eta, &v)))
    }

    #[inline(always)]
    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        join(&sum(&cross(&pi, &omega), &cross(&gamma, &v)), &cross(&gamma, &omega))
    }

    #[inline(always)]
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        let (omega, v) = split(x);
        let turned = rotate(g, &omega);
        join(&turned, &(rotate(g, &v) + cross(&g.translation.vector, &turned)))
    }

    #[inline(always)]
    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (pi, gamma) = split(mu);
        let turned = rotate(g, &gamma);
        join(&(rotate(g, &pi) + cross(&g.translation.vector, &turned)), &turned)
    }

    #[inline(always)]
    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        let g = self.exp(x);
        let (pi, gamma) = split(mu);
        let lifted = difference(&pi, &cross(&g.translation.vector, &gamma));
        let moved = join(&unrotate(&g, &lifted), &unrotate(&g, &gamma));
        (g, moved)
    }

    #[inline(always)]
    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        let k = kernel::dexp(dot(&omega, &omega));
        let once = cross(&pi, &omega);
        let angular = plus(&plus(&pi, k.b, &once), k.c, &cross(&once, &omega));
        let (linear, slope) = dexp_with_derivative(&k, &omega, &gamma);
        join(&sum(&angular, &applied(&slope, &v)), &linear)
    }

    /// (d^R exp)ᵀ (Π, Γ) = (f_Π + D_Γ v, f_Γ) with so(3)'s f_Π = (d^R exp_ω)ᵀ Π and its
    /// derivative D: the upper block of an entire function of a block triangular matrix.
    #[inline(always)]
    fn dexp_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, Matrix6<T>) {
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        let t = dot(&omega, &omega);
        let k = kernel::dexp(t);
        let k2 = kernel::dexp_curvature(t);
        let (angular, angular_slope) = dexp_with_derivative(&k, &omega, &pi);
        let (linear, slope) = dexp_with_derivative(&k, &omega, &gamma);
        let value = join(&sum(&angular, &applied(&slope, &v)), &linear);
        let corner = bend(&angular_slope, &k, &k2, &omega, &gamma, &v);
        (value, blocks(&corner, &slope, &slope))
    }

    #[inline(always)]
    fn dexp_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        let ((omega, v), (pi, gamma)) = (split(x), split(p));
        let c = kernel::dexp_inverse_with_slope(dot(&omega, &omega));
        let half = T::of(0.5);
        let apply = |p: &V<T>| {
            let once = cross(&omega, p);
            (p + once * half + cross(&omega, &once) * c.value, once)
        };
        let (angular, _) = apply(&pi);
        let (linear, once) = apply(&gamma);
        let turned = cross(&v, &gamma);
        let bent = cross(&v, &once) + cross(&omega, &turned);
        let along = cross(&omega, &once) * (T::of(2.0) * dot(&omega, &v) * c.slope);
        join(&(angular + turned * half + bent * c.value + along), &linear)
    }

    #[inline(always)]
    fn exp_extent(&self, x: &Self::Vector) -> T {
        // Only the rotation has imaginary eigenvalues; the rest must be finite.
        let finite = (x[3] + x[4] + x[5]) * T::of(0.0);
        let angle = x[2].times_plus(x[2], x[1].times_plus(x[1], x[0] * x[0]));
        angle.times_plus(T::of(1.0 / (core::f64::consts::PI * core::f64::consts::PI)), finite)
    }

    #[inline(always)]
    fn element_defect(&self, g: &Self::Element) -> T {
        let off = (g.rotation.as_ref().norm_squared() - T::of(1.0)).simd_abs();
        let place = &g.translation;
        off + (place.x + place.y + place.z) * T::of(0.0)
    }

    #[inline(always)]
    fn casimir_count(&self) -> usize {
        2
    }

    #[inline(always)]
    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (pi, gamma) = split(mu);
        if index == 0 { dot(&gamma, &gamma) } else { dot(&pi, &gamma) }
    }

    #[inline(always)]
    fn matrix_size(&self) -> usize {
        4
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        match (row, column) {
            (0..3, 0..3) => SO3::new().matrix_entry(&g.rotation, row, column),
            (0..3, _) => g.translation.vector[row],
            _ => T::of(if column == 3 { 1.0 } else { 0.0 }),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(4, &entry)?;
        for column in 0..4 {
            fixed(&entry, (3, column), if column == 3 { 1.0 } else { 0.0 })?;
        }
        let t = V::from_fn(|row, _| entry(row, 3));
        Ok(isometry(rotation_from(entry)?, t))
    }
}
