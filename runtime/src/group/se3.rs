//! SE(3): rigid motions of space.

use core::marker::PhantomData;

use nalgebra::{Isometry3, Translation3, Vector3, Vector6};

use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::entire::{dexp_inverse, entire, half_angle};
use crate::group::nodes::{self, Row, Rows3};
use crate::group::so3::{
    SO3, cross, dot, plus, quaternion, rotate_back, rotation_from, scaled, sum,
};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::Scalar;

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

/// Coordinates at each node.
pub(super) type Rows6<T, const M: usize> = [Row<T, M>; 6];

/// The rotations and the translations.
#[inline(always)]
fn halves<T: Scalar, const M: usize>(x: &Rows6<T, M>) -> [Rows3<T, M>; 2] {
    [[x[0], x[1], x[2]], [x[3], x[4], x[5]]]
}

#[inline(always)]
fn whole<T: Scalar, const M: usize>(a: Rows3<T, M>, b: Rows3<T, M>) -> Rows6<T, M> {
    let ([x, y, z], [u, v, w]) = (a, b);
    [x, y, z, u, v, w]
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

/// The square of the angle by a factor: only the rotation has imaginary eigenvalues, the rest must be finite.
#[inline(always)]
fn extent<T: Scalar>(x: &Vector6<T>, factor: f64) -> T {
    let finite = (x[3] + x[4] + x[5]) * T::of(0.0);
    let angle = x[2].times_plus(x[2], x[1].times_plus(x[1], x[0] * x[0]));
    angle.times_plus(T::of(factor), finite)
}

impl<T: Scalar> LieGroup for SE3<T> {
    type Scalar = T;
    type Vector = Vector6<T>;
    type Element = Isometry3<T>;

    fn dim(&self) -> usize {
        6
    }

    fn identity(&self) -> Self::Element {
        isometry(SO3::new().identity(), V::repeat(T::of(0.0)))
    }

    /// The product; its rotation is kept on the unit sphere as SO(3)'s is.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let t = sum(&rotate(g, &h.translation.vector), &g.translation.vector);
        isometry(SO3::new().compose(&g.rotation, &h.rotation), t)
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        isometry(g.rotation.conjugate(), -unrotate(g, &g.translation.vector))
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (omega, v) = split(x);
        let t = dot(&omega, &omega);
        let [_, _, b, c, ..] = entire(t);
        let once = cross(&omega, &v);
        let translation = plus(&plus(&v, b, &once), c, &cross(&omega, &once));
        let (cosine, sine) = half_angle(t);
        isometry(quaternion(cosine, &scaled(sine, &omega)), translation)
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let omega = SO3::new().log(&g.rotation)?;
        let c = dexp_inverse(dot(&omega, &omega));
        let t = &g.translation.vector;
        let once = cross(&omega, t);
        Some(join(&omega, &(t - once * T::of(0.5) + cross(&omega, &once) * c)))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        join(&sum(&cross(&pi, &omega), &cross(&gamma, &v)), &cross(&gamma, &omega))
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let (pi, gamma) = split(mu);
        let turned = rotate(g, &gamma);
        join(&(rotate(g, &pi) + cross(&g.translation.vector, &turned)), &turned)
    }

    /// (d^R exp)ᵀ (Π, Γ) = (f_Π + D_Γ v, f_Γ) with so(3)'s f_Π = Π + b Π×ω + c (Π×ω)×ω and the derivative D of that in ω:
    /// D v = b Γ×v + c [(Γ×v)×ω + (Γ×ω)×v] + 2 (ω·v)(b′ Γ×ω + c′ (Γ×ω)×ω).
    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        let [_, _, b, c, c4, c5] = entire(dot(&omega, &omega));
        // 2 cₖ′ = k cₖ₊₂ − cₖ₊₁
        let [b_slope, c_slope] = [c4 + c4 - c, T::of(3.0) * c5 - c4];
        let f = |p: &V<T>| {
            let once = cross(p, &omega);
            let twice = cross(&once, &omega);
            (plus(&plus(p, b, &once), c, &twice), once, twice)
        };
        let ((angular, ..), (linear, once, twice)) = (f(&pi), f(&gamma));
        let bent = cross(&gamma, &v);
        let turned = sum(&cross(&bent, &omega), &cross(&once, &v));
        let along = plus(&scaled(b_slope, &once), c_slope, &twice);
        let angular = plus(&plus(&angular, b, &bent), c, &turned);
        join(&plus(&angular, dot(&omega, &v), &along), &linear)
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        extent(x, 1.0 / (core::f64::consts::PI * core::f64::consts::PI))
    }

    // On SO(3) with dual numbers a + εb, f + εn, w + εv in the place of x, p, ω.

    #[inline(always)]
    fn node_momenta<const M: usize>(
        &self,
        x: &Rows6<T, M>,
        p: &Rows6<T, M>,
        degree: usize,
    ) -> Rows6<T, M> {
        let ([a, b], [n, f]) = (halves(x), halves(p));
        let half = T::of(-0.5);
        let [c, slope, _] = nodes::bernoulli(&nodes::dot(&a, &a), degree);
        let (once, bent) = (nodes::cross(&a, &f), nodes::cross(&b, &f));
        let twice = nodes::cross(&a, &once);
        let turned = nodes::plus(&nodes::cross(&a, &n), T::of(1.0), &bent);
        let second = nodes::plus(&nodes::cross(&a, &turned), T::of(1.0), &nodes::cross(&b, &once));
        let along = nodes::product(&slope, &nodes::dot(&a, &b));
        let angular = nodes::plus_each(&nodes::plus(&n, half, &turned), &c, &second);
        whole(
            nodes::plus_each(&angular, &along, &twice),
            nodes::plus_each(&nodes::plus(&f, half, &once), &c, &twice),
        )
    }

    #[inline(always)]
    fn node_rates<const M: usize>(
        &self,
        x: &Rows6<T, M>,
        p: &Rows6<T, M>,
        omega: &Rows6<T, M>,
        degree: usize,
    ) -> [Rows6<T, M>; 2] {
        let ([a, b], [n, f], [w, v]) = (halves(x), halves(p), halves(omega));
        let (one, half) = (T::of(1.0), T::of(0.5));
        let [c, slope, bend] = nodes::bernoulli(&nodes::dot(&a, &a), degree);
        let stretch = nodes::dot(&a, &b);
        let along = nodes::product(&slope, &stretch);
        // a×w and its dual part, a×f and its dual part.
        let (turned, once) = (nodes::cross(&a, &w), nodes::cross(&a, &f));
        let moved = nodes::plus(&nodes::cross(&a, &v), one, &nodes::cross(&b, &w));
        let bent = nodes::plus(&nodes::cross(&a, &n), one, &nodes::cross(&b, &f));

        let twice = nodes::cross(&a, &turned);
        let turn = nodes::plus_each(&nodes::plus(&w, half, &turned), &c, &twice);
        let second = nodes::plus(&nodes::cross(&a, &moved), one, &nodes::cross(&b, &turned));
        let shift = nodes::plus_each(&nodes::plus(&v, half, &moved), &c, &second);
        let shift = nodes::plus_each(&shift, &along, &twice);

        // −ω·x×(x×p) = (x×ω)·(x×p)
        let across = nodes::dot(&turned, &once);
        let other = nodes::plus_rows(&nodes::dot(&turned, &bent), &nodes::dot(&moved, &once));
        let own = nodes::plus(&nodes::cross(&w, &once), one, &nodes::cross(&f, &turned));
        let linear = nodes::plus_each(&nodes::scaled(half, &nodes::cross(&f, &w)), &c, &own);
        let linear = nodes::plus_each(&linear, &nodes::product(&slope, &across), &a);
        let angular = nodes::plus(&nodes::cross(&n, &w), one, &nodes::cross(&f, &v));
        let dual = nodes::plus(&nodes::cross(&w, &bent), one, &nodes::cross(&v, &once));
        let dual = nodes::plus(&dual, one, &nodes::cross(&n, &turned));
        let dual = nodes::plus(&dual, one, &nodes::cross(&f, &moved));
        let angular = nodes::plus_each(&nodes::scaled(half, &angular), &c, &dual);
        let angular = nodes::plus_each(&angular, &along, &own);
        let curved = nodes::product(&bend, &nodes::product(&stretch, &across));
        let weight = nodes::plus_rows(&nodes::product(&slope, &other), &curved);
        let angular = nodes::plus_each(&angular, &weight, &a);
        let angular = nodes::plus_each(&angular, &nodes::product(&slope, &across), &b);
        [whole(turn, shift), whole(angular, linear)]
    }

    #[inline(always)]
    fn ad_stars<const M: usize>(&self, x: &Rows6<T, M>, mu: &Rows6<T, M>) -> Rows6<T, M> {
        let ([a, b], [n, f]) = (halves(x), halves(mu));
        let turned = nodes::plus(&nodes::cross(&n, &a), T::of(1.0), &nodes::cross(&f, &b));
        whole(turned, nodes::cross(&f, &a))
    }

    #[inline(always)]
    fn brackets<const M: usize>(&self, x: &Rows6<T, M>, y: &Rows6<T, M>) -> Rows6<T, M> {
        let ([a, b], [w, v]) = (halves(x), halves(y));
        let moved = nodes::plus(&nodes::cross(&a, &v), T::of(1.0), &nodes::cross(&b, &w));
        whole(nodes::cross(&a, &w), moved)
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        let off = (g.rotation.as_ref().norm_squared() - T::of(1.0)).simd_abs();
        let place = &g.translation;
        off + (place.x + place.y + place.z) * T::of(0.0)
    }

    fn casimir_count(&self) -> usize {
        2
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        let (pi, gamma) = split(mu);
        if index == 0 { dot(&gamma, &gamma) } else { dot(&pi, &gamma) }
    }

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

/// (1 + ω̂/2)⁻¹ y (1 + |ω|²/4) = y + ½ y×ω + ¼ (ω·y) ω
#[inline(always)]
fn resolve<T: Scalar>(omega: &V<T>, y: &V<T>) -> V<T> {
    y + cross(y, omega) * T::of(0.5) + omega * (dot(omega, y) * T::of(0.25))
}

impl<T: Scalar> CayleyGroup for SE3<T> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        // The rotation cay(ω) and the translation (1 − ω̂/2)⁻¹ v.
        let (omega, v) = split(x);
        let f = T::of(1.0) / (T::of(1.0) + dot(&omega, &omega) * T::of(0.25));
        isometry(SO3::new().cayley(&omega), resolve(&-omega, &v) * f)
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        extent(x, 0.25)
    }

    fn cayley_inverse(&self, g: &Isometry3<T>) -> Option<Self::Vector> {
        let omega = SO3::new().cayley_inverse(&g.rotation)?;
        let t = &g.translation.vector;
        Some(join(&omega, &(t - cross(&omega, t) * T::of(0.5))))
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // (P, Q) with Q = (1 + ω̂/2)⁻¹ Γ, r = ¼ Q×ω − ½ Q, s = Π + v×r, P = f·(s + ½ s×ω), f = 1/(1 + |ω|²/4).
        let ((omega, v), (pi, gamma)) = (split(x), split(mu));
        let half = T::of(0.5);
        let f = T::of(1.0) / (T::of(1.0) + dot(&omega, &omega) * T::of(0.25));
        let q = resolve(&omega, &gamma) * f;
        let r = cross(&q, &omega) * T::of(0.25) - q * half;
        let s = pi + cross(&v, &r);
        join(&((s + cross(&s, &omega) * half) * f), &q)
    }
}
