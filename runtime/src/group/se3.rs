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

impl<T: Scalar> SE3<T> {
    /// Cayley's J_R at one point.
    #[inline(always)]
    fn alone(&self, x: &Vector6<T>, p: &Vector6<T>) -> Vector6<T> {
        let rows = |v: &Vector6<T>| [0, 1, 2, 3, 4, 5].map(|i| [v[i]]);
        let momentum = self.node_momenta::<1>(&rows(x), &rows(p), 2);
        Vector6::from_fn(|i, _| momentum[i][0])
    }
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
        // Only the rotation has imaginary eigenvalues; the rest must be finite.
        let finite = (x[3] + x[4] + x[5]) * T::of(0.0);
        let angle = x[2].times_plus(x[2], x[1].times_plus(x[1], x[0] * x[0]));
        angle.times_plus(T::of(1.0 / (core::f64::consts::PI * core::f64::consts::PI)), finite)
    }

    fn middle_momentum(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // ½(q₀ + q₁), the pull-backs of μ and of the momentum in the middle by y = x/2.
        let y = x * T::of(0.5);
        let first = self.dcay_transpose(&y, mu);
        let second = self.dcay_transpose(&y, &self.alone(&y, &first));
        (first + second) * T::of(0.5)
    }

    fn middle_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        let g = self.cayley(&(x * T::of(0.5)));
        let g = self.compose(&g, &g);
        let moved = self.coadjoint(&self.inverse(&g), mu);
        (g, moved)
    }

    fn middle_extent(&self, x: &Self::Vector) -> T {
        self.cayley_extent(&(x * T::of(0.5)))
    }

    /// Cayley's chart, a polynomial in x = (a, b) and p = (n, f):
    /// (n + ½(n×a + f×b) + ¼(a·n)a − ¼ b×(f×a), f + ½ f×a).
    #[inline(always)]
    fn node_momenta<const M: usize>(
        &self,
        x: &Rows6<T, M>,
        p: &Rows6<T, M>,
        _degree: usize,
    ) -> Rows6<T, M> {
        let ([a, b], [n, f]) = (halves(x), halves(p));
        let (half, quarter) = (T::of(0.5), T::of(0.25));
        let bent = nodes::cross(&f, &a);
        let turned = nodes::plus(&nodes::cross(&n, &a), T::of(1.0), &nodes::cross(&f, &b));
        let along = nodes::dot(&a, &nodes::scaled(quarter, &n));
        let angular = nodes::plus_each(&nodes::plus(&n, half, &turned), &along, &a);
        whole(
            nodes::plus(&angular, -quarter, &nodes::cross(&b, &bent)),
            nodes::plus(&f, half, &bent),
        )
    }

    #[inline(always)]
    fn node_rates<const M: usize>(
        &self,
        x: &Rows6<T, M>,
        p: &Rows6<T, M>,
        omega: &Rows6<T, M>,
        _degree: usize,
    ) -> [Rows6<T, M>; 2] {
        let ([a, b], [n, f], [w, v]) = (halves(x), halves(p), halves(omega));
        let (half, quarter) = (T::of(0.5), T::of(0.25));
        let (bent, moved) = (nodes::cross(&f, &a), nodes::cross(&w, &b));
        let part = nodes::scaled(quarter, &a);
        let (along_n, along_w) = (nodes::dot(&part, &n), nodes::dot(&part, &w));
        let turn = nodes::plus(&w, half, &nodes::cross(&a, &w));
        let turn = nodes::plus_each(&turn, &along_w, &a);
        let shift = nodes::plus(&nodes::cross(&a, &v), T::of(-1.0), &moved);
        let shift =
            nodes::plus(&nodes::plus(&v, half, &shift), -quarter, &nodes::cross(&a, &moved));
        let angular = nodes::plus(&nodes::cross(&n, &w), T::of(1.0), &nodes::cross(&f, &v));
        let angular = nodes::scaled(half, &angular);
        let angular = nodes::plus(&angular, quarter, &nodes::cross(&moved, &f));
        let angular = nodes::plus_each(&angular, &nodes::minus(&along_n), &w);
        let angular = nodes::plus_each(&angular, &nodes::minus(&along_w), &n);
        let linear = nodes::scaled(half, &nodes::cross(&f, &w));
        let linear = nodes::plus(&linear, quarter, &nodes::cross(&bent, &w));
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
        let finite = (x[3] + x[4] + x[5]) * T::of(0.0);
        let angle = x[2].times_plus(x[2], x[1].times_plus(x[1], x[0] * x[0]));
        angle.times_plus(T::of(0.25), finite)
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
