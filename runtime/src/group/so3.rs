//! SO(3): rotations of space, as unit quaternions.

use core::marker::PhantomData;

use nalgebra::{Matrix3, Quaternion, Rotation3, SimdBool, UnitQuaternion, Vector3};

use crate::group::element_error::{ElementError, finite, within};
use crate::group::entire::{entire, half_angle, log_factor};
use crate::group::nodes::{self, Row, Rows3};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::scalar::Scalar;

/// The rotation group SO(3), elements as unit quaternions.
///
/// Basis: the generators of rotations about the three axes, [e₁, e₂] = e₃ and cyclic, so that
/// [x, y] = x × y, Ad_R x = Rx, Ad\*_R μ = Rμ, ad\*_x μ = μ × x. Casimir: |μ|². Both charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SO3<T = f64>(PhantomData<T>);

// Not derived: that would ask for `T: Default`, which lanes need not have.
impl<T> Default for SO3<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> SO3<T> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<T> FixedDimension for SO3<T> {
    const DIM: usize = 3;
}

type V<T> = Vector3<T>;

#[inline(always)]
pub(crate) fn cross<T: Scalar>(a: &V<T>, b: &V<T>) -> V<T> {
    let entry = |i: usize, j: usize| (-a[j]).times_plus(b[i], a[i] * b[j]);
    V::new(entry(1, 2), entry(2, 0), entry(0, 1))
}

#[inline(always)]
pub(crate) fn dot<T: Scalar>(a: &V<T>, b: &V<T>) -> T {
    a.z.times_plus(b.z, a.y.times_plus(b.y, a.x * b.x))
}

/// R(q)ᵀ v for the unit quaternion (w, u): v + 2 w (v × u) + 2 u × (u × v).
#[inline(always)]
pub(crate) fn rotate_back<T: Scalar>(w: T, u: &V<T>, v: &V<T>) -> V<T> {
    let twice = scaled(T::of(2.0), &cross(v, u));
    sum(&plus(v, w, &twice), &cross(&twice, u))
}

// Written out, and not by the vectors' operators: those are loops of iterators, which the compiler does
// not always see through, and then wide lanes go through memory piece by piece.

/// a + s·b
#[inline(always)]
pub(crate) fn plus<T: Scalar>(a: &V<T>, s: T, b: &V<T>) -> V<T> {
    V::new(b.x.times_plus(s, a.x), b.y.times_plus(s, a.y), b.z.times_plus(s, a.z))
}

/// a + b
#[inline(always)]
pub(crate) fn sum<T: Scalar>(a: &V<T>, b: &V<T>) -> V<T> {
    V::new(a.x + b.x, a.y + b.y, a.z + b.z)
}

/// s·a
#[inline(always)]
pub(crate) fn scaled<T: Scalar>(s: T, a: &V<T>) -> V<T> {
    V::new(a.x * s, a.y * s, a.z * s)
}

#[inline(always)]
pub(crate) fn quaternion<T: Scalar>(w: T, u: &V<T>) -> UnitQuaternion<T> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, u.x, u.y, u.z))
}

/// c(t) = Σ |B₂ₖ|/(2k)! tᵏ⁻¹ up to k = 6, t = |x|², and 2 dc/dt: the factors of exp's J_R.
#[inline(always)]
fn bernoulli<T: Scalar, const M: usize>(t: &Row<T, M>) -> [Row<T, M>; 2] {
    const C: [f64; 6] = [
        1.0 / 12.0,
        1.0 / 720.0,
        1.0 / 30_240.0,
        1.0 / 1_209_600.0,
        1.0 / 47_900_160.0,
        691.0 / 1_307_674_368_000.0,
    ];
    let pair = |i: usize, a: f64, b: f64| T::of(b).times_plus(t[i], T::of(a));
    let c = nodes::each(|i| {
        let square = t[i] * t[i];
        let high = pair(i, C[4], C[5]).times_plus(square, pair(i, C[2], C[3]));
        high.times_plus(square, pair(i, C[0], C[1]))
    });
    let slope = nodes::each(|i| {
        let square = t[i] * t[i];
        let high = T::of(10.0 * C[5]).times_plus(square, pair(i, 6.0 * C[3], 8.0 * C[4]));
        high.times_plus(square, pair(i, 2.0 * C[1], 4.0 * C[2]))
    });
    [c, slope]
}

/// The rotation whose matrix has these (finite) entries.
pub(crate) fn rotation_from<T: Scalar>(
    entry: impl Fn(usize, usize) -> T,
) -> Result<UnitQuaternion<T>, ElementError> {
    let m = Matrix3::from_fn(entry);
    let gram = m.transpose() * m;
    let mut defect = T::of(0.0);
    for i in 0..3 {
        for j in 0..3 {
            let unit = T::of(if i == j { 1.0 } else { 0.0 });
            defect = defect.simd_max((gram[(i, j)] - unit).simd_abs());
        }
    }
    if !within(defect, T::of(1.0)) {
        return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
    }
    let columns = [m.column(0).into_owned(), m.column(1).into_owned(), m.column(2).into_owned()];
    let determinant = dot(&columns[0], &cross(&columns[1], &columns[2]));
    if !determinant.simd_gt(T::of(0.0)).all() {
        return Err(ElementError::Determinant {
            determinant: determinant.largest_lane(),
            required: "a rotation needs determinant 1",
        });
    }
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(m));
    Ok(UnitQuaternion::new_normalize(q.into_inner()))
}

impl<T: Scalar> LieGroup for SO3<T> {
    type Scalar = T;
    type Vector = Vector3<T>;
    type Element = UnitQuaternion<T>;

    fn dim(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        quaternion(T::of(1.0), &V::repeat(T::of(0.0)))
    }

    /// The product, pulled back onto the unit sphere to first order so that rounding does not
    /// accumulate in the norm over many steps.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        // Written out: in wide lanes nalgebra's product stays a call.
        let (a, b) = (g.as_ref(), h.as_ref());
        let w = a.w * b.w - a.i * b.i - a.j * b.j - a.k * b.k;
        let i = a.w * b.i + a.i * b.w + a.j * b.k - a.k * b.j;
        let j = a.w * b.j - a.i * b.k + a.j * b.w + a.k * b.i;
        let k = a.w * b.k + a.i * b.j - a.j * b.i + a.k * b.w;
        let norm_squared = (i * i + j * j) + (k * k + w * w);
        let factor = T::of(1.5) - T::of(0.5) * norm_squared;
        UnitQuaternion::new_unchecked(Quaternion::new(
            w * factor,
            i * factor,
            j * factor,
            k * factor,
        ))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.conjugate()
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let (cosine, sine) = half_angle(dot(x, x));
        quaternion(cosine, &(x * sine))
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        // q and −q are the same rotation; the one with w ≥ 0 has the smaller angle.
        let q = g.as_ref();
        let sign = T::of(1.0).simd_copysign(q.w);
        let u = V::new(q.i, q.j, q.k) * sign;
        let factor = log_factor(q.w * sign, dot(&u, &u));
        Some(u * factor)
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        cross(mu, x)
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let q = g.as_ref();
        rotate_back(q.w, &V::new(-q.i, -q.j, -q.k), mu)
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // Σ ad_xᵀᵏ μ/(k + 1)! with ad_xᵀ³ = −|x|² ad_xᵀ.
        let [_, _, b, c, ..] = entire(dot(x, x));
        let once = cross(mu, x);
        plus(&plus(mu, b, &once), c, &cross(&once, x))
    }

    fn exp_extent(&self, x: &Self::Vector) -> T {
        dot(x, x) * T::of(1.0 / (core::f64::consts::PI * core::f64::consts::PI))
    }

    #[inline(always)]
    fn node_momenta<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        _degree: usize,
    ) -> Rows3<T, M> {
        // p − ½ x×p + c x×(x×p)
        let once = nodes::cross(x, p);
        let [c, _] = bernoulli(&nodes::dot(x, x));
        let twice = nodes::cross(x, &once);
        nodes::plus_each(&nodes::plus(p, T::of(-0.5), &once), &c, &twice)
    }

    #[inline(always)]
    fn node_rates<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        omega: &Rows3<T, M>,
        _degree: usize,
    ) -> [Rows3<T, M>; 2] {
        // ẋ = ω + ½ x×ω + c x×(x×ω), −ṗ = ½ ω×p + c[(x×p)×ω + (x×ω)×p] + 2c′ (ω·x×(x×p)) x
        let [c, slope] = bernoulli(&nodes::dot(x, x));
        let (turned, once) = (nodes::cross(x, omega), nodes::cross(x, p));
        let velocity = nodes::plus(omega, T::of(0.5), &turned);
        let velocity = nodes::plus_each(&velocity, &c, &nodes::cross(x, &turned));
        let bent = nodes::plus(&nodes::cross(&once, omega), T::of(1.0), &nodes::cross(&turned, p));
        let along = nodes::dot(omega, &nodes::cross(x, &once));
        let along = nodes::each(|i| -(slope[i] * along[i]));
        let force = nodes::scaled(T::of(0.5), &nodes::cross(p, omega));
        let force = nodes::plus_each(&force, &nodes::minus(&c), &bent);
        [velocity, nodes::plus_each(&force, &along, x)]
    }

    #[inline(always)]
    fn ad_stars<const M: usize>(&self, x: &Rows3<T, M>, mu: &Rows3<T, M>) -> Rows3<T, M> {
        nodes::cross(mu, x)
    }

    #[inline(always)]
    fn brackets<const M: usize>(&self, x: &Rows3<T, M>, y: &Rows3<T, M>) -> Rows3<T, M> {
        nodes::cross(x, y)
    }

    fn element_defect(&self, g: &Self::Element) -> T {
        (g.as_ref().norm_squared() - T::of(1.0)).simd_abs()
    }

    fn casimir_count(&self) -> usize {
        1
    }

    fn casimir(&self, _index: usize, mu: &Self::Vector) -> T {
        dot(mu, mu)
    }

    fn matrix_size(&self) -> usize {
        3
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let mut unit = V::repeat(T::of(0.0));
        unit[column] = T::of(1.0);
        self.coadjoint(g, &unit)[row]
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(3, &entry)?;
        rotation_from(entry)
    }
}

impl<T: Scalar> CayleyGroup for SO3<T> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        // The rotation with quaternion (1, x/2)/√(1 + |x|²/4).
        let half = x * T::of(0.5);
        let w = T::of(1.0) / (T::of(1.0) + dot(&half, &half)).simd_sqrt();
        quaternion(w, &(half * w))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        dot(x, x) * T::of(0.25)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        let q = g.as_ref();
        if q.w.simd_abs().simd_le(T::epsilon()).any() {
            return None; // a half turn: cay never reaches it
        }
        let factor = T::of(2.0) / q.w;
        Some(V::new(q.i, q.j, q.k) * factor)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // d^R cay_x = (1 + x̂/2)/(1 + |x|²/4); its transpose sends μ to (μ + ½ μ×x)/(1 + |x|²/4).
        let factor = T::of(1.0) / (T::of(1.0) + dot(x, x) * T::of(0.25));
        (mu + cross(mu, x) * T::of(0.5)) * factor
    }
}
