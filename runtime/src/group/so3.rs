//! SO(3), the rotations of space, and SU(2), their double cover, as unit quaternions.

use core::marker::PhantomData;

use nalgebra::{Matrix3, Quaternion, Rotation3, SimdBool, UnitQuaternion, Vector3};

use crate::group::element_error::{ElementError, finite, fixed, within};
use crate::group::entire::{entire, half_angle, log_factor};
use crate::group::nodes::{self, Rows3};
use crate::group::{CayleyGroup, FixedDimension, LieGroup};
use crate::number::Scalar;

/// The rotation group SO(3), elements as unit quaternions.
///
/// Basis: the generators of rotations about the three axes, [e₁, e₂] = e₃ and cyclic, so that
/// [x, y] = x × y, Ad_R x = Rx, Ad\*_R μ = Rμ, ad\*_x μ = μ × x. Casimir: |μ|². Both charts.
pub type SO3<T = f64> = Quaternions<T, false>;

/// The group SU(2), elements as unit quaternions; q and −q are different here.
///
/// Basis: e_k = −iσ_k/2 with the Pauli matrices, so that [e₁, e₂] = e₃ and cyclic, and brackets,
/// Ad and Ad\* are those of [`SO3`]. Matrices: the complex 2×2 matrix a + ib as the real 4×4
/// matrix ((a, −b), (b, a)). Casimir: |μ|². Both charts; the Cayley map is that of the 2×2
/// matrices, which differs from SO(3)'s.
pub type SU2<T = f64> = Quaternions<T, true>;

/// The groups of unit quaternions: [`SO3`], where q and −q are one element, and [`SU2`], the double cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quaternions<T, const DOUBLE_COVER: bool>(PhantomData<T>);

// Not derived: that would ask for `T: Default`, which lanes need not have.
impl<T, const DOUBLE_COVER: bool> Default for Quaternions<T, DOUBLE_COVER> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T, const DOUBLE_COVER: bool> Quaternions<T, DOUBLE_COVER> {
    /// The group; there is nothing to choose.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<T, const DOUBLE_COVER: bool> FixedDimension for Quaternions<T, DOUBLE_COVER> {
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

/// Entry (row, column) of the matrix of SU(2).
fn complex_entry<T: Scalar>(q: &Quaternion<T>, row: usize, column: usize) -> T {
    // w − i(xσ₁ + yσ₂ + zσ₃): real part ((w, −y), (y, w)), imaginary part ((−z, −x), (−x, z)).
    let real = [[q.w, -q.j], [q.j, q.w]];
    let imaginary = [[-q.k, -q.i], [-q.i, q.k]];
    match (row / 2, column / 2) {
        (0, 1) => -imaginary[row % 2][column % 2],
        (1, 0) => imaginary[row % 2][column % 2],
        _ => real[row % 2][column % 2],
    }
}

/// The element of SU(2) whose matrix has these (finite) entries.
fn complex_from<T: Scalar>(
    entry: impl Fn(usize, usize) -> T,
) -> Result<UnitQuaternion<T>, ElementError> {
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
            let expected = complex_entry(q.as_ref(), row, column);
            fixed(&|i, j| entry(i, j) - expected, (row, column), 0.0)?;
        }
    }
    Ok(q)
}

impl<T: Scalar, const DOUBLE_COVER: bool> LieGroup for Quaternions<T, DOUBLE_COVER> {
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

    /// The logarithm with |x| ≤ π; of the double cover with |x| < 2π, and `None` at −1, which every direction reaches.
    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let q = g.as_ref();
        if DOUBLE_COVER {
            let u = V::new(q.i, q.j, q.k);
            let squared = dot(&u, &u);
            if q.w.simd_lt(T::of(0.0)).any() && squared.simd_le(T::epsilon() * T::epsilon()).any() {
                return None;
            }
            return Some(u * log_factor(q.w, squared));
        }
        // q and −q are the same rotation; the one with w ≥ 0 has the smaller angle.
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
        degree: usize,
    ) -> Rows3<T, M> {
        // p − ½ x×p + c x×(x×p)
        let once = nodes::cross(x, p);
        let [c, ..] = nodes::bernoulli(&nodes::dot(x, x), degree);
        let twice = nodes::cross(x, &once);
        nodes::plus_each(&nodes::plus(p, T::of(-0.5), &once), &c, &twice)
    }

    #[inline(always)]
    fn node_rates<const M: usize>(
        &self,
        x: &Rows3<T, M>,
        p: &Rows3<T, M>,
        omega: &Rows3<T, M>,
        degree: usize,
    ) -> [Rows3<T, M>; 2] {
        // ẋ = ω + ½ x×ω + c x×(x×ω), −ṗ = ½ ω×p + c[(x×p)×ω + (x×ω)×p] + 2c′ (ω·x×(x×p)) x
        let [c, slope, _] = nodes::bernoulli(&nodes::dot(x, x), degree);
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
        if DOUBLE_COVER { 4 } else { 3 }
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        if DOUBLE_COVER {
            return complex_entry(g.as_ref(), row, column);
        }
        let mut unit = V::repeat(T::of(0.0));
        unit[column] = T::of(1.0);
        self.coadjoint(g, &unit)[row]
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(self.matrix_size(), &entry)?;
        if DOUBLE_COVER { complex_from(entry) } else { rotation_from(entry) }
    }
}

impl<T: Scalar, const DOUBLE_COVER: bool> CayleyGroup for Quaternions<T, DOUBLE_COVER> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        if DOUBLE_COVER {
            // (1 − a)⁻¹(1 + a) = (1 + a)²/(1 + |a|²) for the pure quaternion a = x/4.
            let a = x * T::of(0.25);
            let n = dot(&a, &a);
            let factor = T::of(1.0) / (T::of(1.0) + n);
            return quaternion((T::of(1.0) - n) * factor, &(a * (T::of(2.0) * factor)));
        }
        // The rotation with quaternion (1, x/2)/√(1 + |x|²/4).
        let half = x * T::of(0.5);
        let w = T::of(1.0) / (T::of(1.0) + dot(&half, &half)).simd_sqrt();
        quaternion(w, &(half * w))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> T {
        if DOUBLE_COVER {
            // Eigenvalues of x are ±i|x|/2.
            return dot(x, x) * T::of(0.0625);
        }
        dot(x, x) * T::of(0.25)
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        if DOUBLE_COVER {
            let q = g.as_ref();
            let below = T::of(1.0) + q.w;
            if below.simd_le(T::epsilon()).any() {
                return None; // −1: cay never reaches it
            }
            return Some(V::new(q.i, q.j, q.k) * (T::of(4.0) / below));
        }
        let q = g.as_ref();
        if q.w.simd_abs().simd_le(T::epsilon()).any() {
            return None; // a half turn: cay never reaches it
        }
        let factor = T::of(2.0) / q.w;
        Some(V::new(q.i, q.j, q.k) * factor)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        if DOUBLE_COVER {
            // ((1 − |a|²)μ + 2(a·μ)a + 2 μ×a)/(1 + |a|²)², a = x/4
            let a = x * T::of(0.25);
            let n = dot(&a, &a);
            let (above, below) = (T::of(1.0) - n, T::of(1.0) + n);
            return (mu * above + (a * dot(&a, mu) + cross(mu, &a)) * T::of(2.0)) / (below * below);
        }
        // d^R cay_x = (1 + x̂/2)/(1 + |x|²/4); its transpose sends μ to (μ + ½ μ×x)/(1 + |x|²/4).
        let factor = T::of(1.0) / (T::of(1.0) + dot(x, x) * T::of(0.25));
        (mu + cross(mu, x) * T::of(0.5)) * factor
    }
}
