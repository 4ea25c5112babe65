//! SE(2): rigid motions of the plane.

use coadjoint_geometry::group::Matrices;
use coadjoint_geometry::motion::Motion;
use coadjoint_geometry::plane::Plane;
use coadjoint_geometry::vector::{V3, finite};
use nalgebra::{Complex, Isometry2, SimdBool, Translation2, Unit};

use crate::group::closed::{Closed, Formulas};
use crate::group::element_error::{ElementError, fixed, within};
use crate::group::log::dexp_inverse;
use crate::number::Scalar;

/// The Euclidean group of the plane, elements as a rotation (unit complex number) and a
/// translation.
///
/// Basis: e₁ the rotation, e₂ and e₃ the translations, with [e₁, e₂] = e₃, [e₁, e₃] = −e₂.
/// Matrices: 3×3, rotation and translation column. Casimir: μ₂² + μ₃². Both charts. The
/// differentials are those of SE(3), whose subgroup this is.
pub type SE2<T = f64> = Closed<Plane, T, 3, 4>;

#[inline(always)]
fn motion<T: Scalar>([cosine, sine, x, y]: [T; 4]) -> Isometry2<T> {
    Isometry2 {
        rotation: Unit::new_unchecked(Complex { re: cosine, im: sine }),
        translation: Translation2 { vector: [x, y].into() },
    }
}

#[inline(always)]
fn parts<T: Scalar>(g: &Isometry2<T>) -> [T; 4] {
    [g.rotation.re, g.rotation.im, g.translation.vector.x, g.translation.vector.y]
}

impl Formulas<3, 4> for Plane {
    type Element<T: Scalar> = Isometry2<T>;

    const ROWS: usize = 3;
    const CASIMIRS: usize = 1;

    /// Cosine and sine of half the angle, then the translation.
    #[inline(always)]
    fn numbers<T: Scalar>(g: &Isometry2<T>) -> [T; 4] {
        let ([cosine, sine, x, y], half, one) = (parts(g), T::of(0.5), T::of(1.0));
        // The larger of both by a root, the other one by sin θ = 2 sin(θ/2) cos(θ/2).
        let large = (half + half * cosine.simd_abs()).simd_sqrt();
        let small = half * sine / large;
        let near = cosine.simd_ge(T::of(0.0));
        let sign = one.select(sine.simd_ge(T::of(0.0)), -one);
        [large.select(near, small * sign), small.select(near, large * sign), x, y]
    }

    #[inline(always)]
    fn element<T: Scalar>([w, k, x, y]: [T; 4]) -> Isometry2<T> {
        motion([(w - k) * (w + k), (w + w) * k, x, y])
    }

    #[inline(always)]
    fn of_increment<T: Scalar>(h: Motion<T>) -> Isometry2<T> {
        let ([w, _, _, k], [x, y, _]) = (h.turn.quaternion(), h.place);
        Self::element([w, k, x, y])
    }

    fn compose<T: Scalar>(g: &Isometry2<T>, h: &Isometry2<T>) -> Isometry2<T> {
        let ([c, s, x, y], [d, r, u, v]) = (parts(g), parts(h));
        let (cosine, sine) = (c * d - s * r, c * r + s * d);
        let factor = T::of(1.5) - T::of(0.5) * (cosine * cosine + sine * sine);
        motion([cosine * factor, sine * factor, c * u - s * v + x, s * u + c * v + y])
    }

    fn inverse<T: Scalar>(g: &Isometry2<T>) -> Isometry2<T> {
        let [c, s, x, y] = parts(g);
        motion([c, -s, -(c * x + s * y), s * x - c * y])
    }

    fn log<T: Scalar>(g: &Isometry2<T>) -> Option<V3<T>> {
        let [c, s, x, y] = parts(g);
        let angle = s.simd_atan2(c);
        // V⁻¹ = 1 − ½ω̂ + κ ω̂², κ = (1 − (ω/2) cot(ω/2))/ω².
        let across = angle * T::of(0.5);
        let along = T::of(1.0) - angle * angle * dexp_inverse([across]);
        Some([angle, along * x + across * y, along * y - across * x])
    }

    fn cayley_inverse<T: Scalar>(g: &Isometry2<T>) -> Option<V3<T>> {
        // ω/2 = tan(θ/2) = sin θ/(1 + cos θ), v = (1 − ω̂/2) t
        let [c, s, x, y] = parts(g);
        let below = T::of(1.0) + c;
        let half = s / below;
        // A half turn is never reached.
        let reached = below.simd_gt(T::epsilon()).all();
        reached.then_some([half + half, x + half * y, y - half * x])
    }

    fn coadjoint_by<T: Scalar>(g: &Isometry2<T>, mu: V3<T>) -> V3<T> {
        let [c, s, u, v] = parts(g);
        let (first, second) = (c * mu[1] - s * mu[2], s * mu[1] + c * mu[2]);
        [mu[0] + u * second - v * first, first, second]
    }

    fn defect_of<T: Scalar>(g: &Isometry2<T>) -> T {
        let [c, s, x, y] = parts(g);
        (c * c + s * s - T::of(1.0)).simd_abs() + finite([x, y])
    }

    fn casimir<T: Scalar>(_index: usize, mu: V3<T>) -> T {
        mu[1] * mu[1] + mu[2] * mu[2]
    }

    fn entry<T: Scalar>(g: &Isometry2<T>, row: usize, column: usize) -> T {
        Self::matrix(Self::numbers(g))[row][column]
    }

    fn from_matrix<T: Scalar>(
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Isometry2<T>, ElementError> {
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
        Ok(motion([cosine / norm, sine / norm, entry(0, 2), entry(1, 2)]))
    }
}
