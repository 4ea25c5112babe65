//! The functions of t = θ² = |x|² that exp and its differential on so(3) need.
//!
//! Each is entire in t (or analytic up to θ = 2π), so near 0 a polynomial reaches rounding; beyond
//! [`NEAR`] the trigonometric form does, where nothing cancels any more. Both agree to rounding at
//! the seam, and lanes choose by mask.

use nalgebra::SimdBool;

use crate::number::scalar::Scalar;

/// Up to this t (θ = 2.4) the polynomials below are exact to rounding.
const NEAR: f64 = 5.8;

/// Their coefficients.
const TERMS: usize = 12;

/// 1/n! with the sign of a cosine-like series: `alternating(k, n)` = (−1)ᵏ/n!.
const fn alternating(k: usize, n: usize) -> f64 {
    let mut factorial = 1.0;
    let mut i = 2;
    while i <= n {
        factorial *= i as f64;
        i += 1;
    }
    if k.is_multiple_of(2) { 1.0 / factorial } else { -1.0 / factorial }
}

/// Evaluates Σ cₖ tᵏ for twelve coefficients, in pairs (Estrin) to keep the chain short.
#[inline(always)]
fn polynomial<T: Scalar>(c: &[f64; TERMS], t: T) -> T {
    let pair = |k: usize| T::of(c[k + 1]).times_plus(t, T::of(c[k]));
    let t2 = t * t;
    let t4 = t2 * t2;
    let low = pair(2).times_plus(t2, pair(0));
    let high = pair(6).times_plus(t2, pair(4));
    let top = pair(10).times_plus(t2, pair(8));
    top.times_plus(t4, high).times_plus(t4, low)
}

/// Coefficient tables, each Σ cₖ tᵏ.
mod table {
    use super::{TERMS, alternating};

    macro_rules! coefficients {
        ($(#[$doc:meta])* $name:ident, $k:ident => $value:expr) => {
            $(#[$doc])*
            pub(crate) const $name: [f64; TERMS] = {
                let mut c = [0.0; TERMS];
                let mut $k = 0;
                while $k < TERMS {
                    c[$k] = $value;
                    $k += 1;
                }
                c
            };
        };
    }

    const fn quarter_power(k: usize) -> f64 {
        let mut result = 1.0;
        let mut i = 0;
        while i < k {
            result *= 0.25;
            i += 1;
        }
        result
    }

    coefficients!(
        /// sin(θ/2)/θ = Σ ½ (−t/4)ᵏ/(2k+1)!
        SINE, k => 0.5 * quarter_power(k) * alternating(k, 2 * k + 1)
    );
    coefficients!(
        /// cos(θ/2) = Σ (−t/4)ᵏ/(2k)!
        COSINE, k => quarter_power(k) * alternating(k, 2 * k)
    );
    coefficients!(
        /// b = (1 − cos θ)/θ² = Σ (−t)ᵏ/(2k+2)!
        B, k => alternating(k, 2 * k + 2)
    );
    coefficients!(
        /// c = (θ − sin θ)/θ³ = Σ (−t)ᵏ/(2k+3)!
        C, k => alternating(k, 2 * k + 3)
    );
    coefficients!(
        /// db/dt
        B_SLOPE, k => (k + 1) as f64 * alternating(k + 1, 2 * k + 4)
    );
    coefficients!(
        /// d²b/dt²
        B_CURVATURE, k => ((k + 1) * (k + 2)) as f64 * alternating(k, 2 * k + 6)
    );
    coefficients!(
        /// d²c/dt²
        C_CURVATURE, k => ((k + 1) * (k + 2)) as f64 * alternating(k, 2 * k + 7)
    );
    coefficients!(
        /// dc/dt
        C_SLOPE, k => (k + 1) as f64 * alternating(k + 1, 2 * k + 5)
    );
}

/// cos(θ/2) and sin(θ/2)/θ.
pub(crate) struct HalfAngle<T> {
    pub cosine: T,
    pub sine_over_angle: T,
}

/// The half-angle functions at t = θ².
#[inline(always)]
pub(crate) fn half_angle<T: Scalar>(t: T) -> HalfAngle<T> {
    let near = t.simd_le(T::of(NEAR));
    let mut result = HalfAngle {
        cosine: polynomial(&table::COSINE, t),
        sine_over_angle: polynomial(&table::SINE, t),
    };
    if !near.all() {
        let far = half_angle_far(t);
        result.cosine = result.cosine.select(near, far.cosine);
        result.sine_over_angle = result.sine_over_angle.select(near, far.sine_over_angle);
    }
    result
}

#[cold]
fn half_angle_far<T: Scalar>(t: T) -> HalfAngle<T> {
    let angle = t.simd_sqrt();
    let (sine, cosine) = (angle * T::of(0.5)).simd_sin_cos();
    HalfAngle { cosine, sine_over_angle: sine / angle }
}

/// b = (1 − cos θ)/θ², c = (θ − sin θ)/θ³ and their derivatives in t.
pub(crate) struct Dexp<T> {
    pub b: T,
    pub c: T,
    pub b_slope: T,
    pub c_slope: T,
}

/// The functions of (d^R exp)ᵀ at t = θ².
#[inline(always)]
pub(crate) fn dexp<T: Scalar>(t: T) -> Dexp<T> {
    let near = t.simd_le(T::of(NEAR));
    let mut result = Dexp {
        b: polynomial(&table::B, t),
        c: polynomial(&table::C, t),
        b_slope: polynomial(&table::B_SLOPE, t),
        c_slope: polynomial(&table::C_SLOPE, t),
    };
    if !near.all() {
        let far = dexp_far(t);
        result.b = result.b.select(near, far.b);
        result.c = result.c.select(near, far.c);
        result.b_slope = result.b_slope.select(near, far.b_slope);
        result.c_slope = result.c_slope.select(near, far.c_slope);
    }
    result
}

#[cold]
fn dexp_far<T: Scalar>(t: T) -> Dexp<T> {
    let HalfAngle { cosine, sine_over_angle: s } = half_angle_far(t);
    let inverse = T::of(1.0) / t;
    let sinc = T::of(2.0) * s * cosine; // sin θ/θ
    let b = T::of(2.0) * s * s;
    let c = (T::of(1.0) - sinc) * inverse;
    let full_cosine = T::of(1.0) - b * t;
    let sinc_slope = (full_cosine - sinc) * T::of(0.5) * inverse;
    Dexp { b, c, b_slope: (sinc * T::of(0.5) - b) * inverse, c_slope: -(sinc_slope + c) * inverse }
}

/// The second derivatives of b and c in t, for the derivative of (d^R exp)ᵀ on se(3).
pub(crate) struct DexpCurvature<T> {
    pub b: T,
    pub c: T,
}

/// d²b/dt² and d²c/dt² at t = θ².
#[inline(always)]
pub(crate) fn dexp_curvature<T: Scalar>(t: T) -> DexpCurvature<T> {
    let near = t.simd_le(T::of(NEAR));
    let mut result = DexpCurvature {
        b: polynomial(&table::B_CURVATURE, t),
        c: polynomial(&table::C_CURVATURE, t),
    };
    if !near.all() {
        let far = dexp_curvature_far(t);
        result.b = result.b.select(near, far.b);
        result.c = result.c.select(near, far.c);
    }
    result
}

#[cold]
fn dexp_curvature_far<T: Scalar>(t: T) -> DexpCurvature<T> {
    // bt = 1 − cos θ and ct = 1 − σ with σ = sin θ/θ, (cos θ)′ = −σ/2 and 2tσ′ = cos θ − σ,
    // differentiated twice.
    let Dexp { b, c, b_slope, c_slope } = dexp_far(t);
    let half = T::of(0.5);
    let two = T::of(2.0);
    let inverse = T::of(1.0) / t;
    let sinc = T::of(1.0) - c * t;
    let sinc_slope = (T::of(1.0) - b * t - sinc) * half * inverse;
    let sinc_curvature = -(sinc * half + T::of(3.0) * sinc_slope) * half * inverse;
    DexpCurvature {
        b: (sinc_slope * half - two * b_slope) * inverse,
        c: -(sinc_curvature + two * c_slope) * inverse,
    }
}

/// (1 − (θ/2) cot(θ/2))/θ², the function of (d^R exp)^{−T}; infinite at θ = 2π.
#[inline(always)]
pub(crate) fn dexp_inverse<T: Scalar>(t: T) -> T {
    dexp_inverse_with_slope(t).value
}

/// A function of t with its derivative.
pub(crate) struct WithSlope<T> {
    pub value: T,
    pub slope: T,
}

/// [`dexp_inverse`] and its derivative in t.
#[inline(always)]
pub(crate) fn dexp_inverse_with_slope<T: Scalar>(t: T) -> WithSlope<T> {
    // With s = sin(θ/2)/θ this is n/(2s), n = (2s − cos(θ/2))/t, where n has a
    // series without cancellation and s′ = −n/4.
    let near = t.simd_le(T::of(NEAR));
    let half = half_angle(t);
    let s = half.sine_over_angle;
    let two = T::of(2.0);
    let quarter = T::of(0.25);
    let mut n = polynomial(&SINE_MINUS_COSINE, t);
    let mut n_slope = polynomial(&SINE_MINUS_COSINE_SLOPE, t);
    if !near.all() {
        let inverse = T::of(1.0) / t;
        let far = (two * s - half.cosine) * inverse;
        // (2s)′ = −n/2 and cos(θ/2)′ = −s/4, so (nt)′ = s/4 − n/2.
        let far_slope = (s * quarter - T::of(1.5) * far) * inverse;
        n = n.select(near, far);
        n_slope = n_slope.select(near, far_slope);
    }
    let s_slope = -n * quarter;
    let denominator = T::of(1.0) / (two * s);
    let value = n * denominator;
    WithSlope { value, slope: (n_slope - two * value * s_slope) * denominator }
}

/// (2 sin(θ/2)/θ − cos(θ/2))/t = Σ (−1)ᵏ (2k+2)/(4ᵏ⁺¹ (2k+3)!) tᵏ.
const SINE_MINUS_COSINE: [f64; TERMS] = {
    let mut c = [0.0; TERMS];
    let mut quarter = 0.25;
    let mut k = 0;
    while k < TERMS {
        c[k] = quarter * (2 * k + 2) as f64 * alternating(k, 2 * k + 3);
        quarter *= 0.25;
        k += 1;
    }
    c
};

/// The derivative of [`SINE_MINUS_COSINE`].
const SINE_MINUS_COSINE_SLOPE: [f64; TERMS] = {
    let mut c = [0.0; TERMS];
    let mut quarter = 0.0625;
    let mut k = 0;
    while k < TERMS {
        c[k] = quarter * ((k + 1) * (2 * k + 4)) as f64 * alternating(k + 1, 2 * k + 5);
        quarter *= 0.25;
        k += 1;
    }
    c
};

/// θ/sin(θ/2) for w = cos(θ/2) > −1 and s = sin²(θ/2): the factor from a quaternion's vector part
/// to its logarithm.
pub(crate) fn log_factor<T: Scalar>(w: T, s: T) -> T {
    let root = s.simd_sqrt();
    let factor = T::of(2.0) * root.simd_atan2(w) / root;
    // For tiny s, θ/sin(θ/2) = 2 (1 + s/6 + …)/… and w is 1 to rounding.
    let series = T::of(2.0) + s * T::of(1.0 / 3.0);
    // Close to a full turn (w < 0, SU(2) only) s is small too, but nothing is lost there.
    let tiny = s.simd_le(T::of(1e-9)) & w.simd_gt(T::of(0.0));
    series.select(tiny, factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_and_closed_forms_agree_up_to_the_seam() {
        for t in [1.0, 3.0, 5.0, NEAR] {
            let (near, far) = (half_angle(t), half_angle_far(t));
            assert!((near.cosine - far.cosine).abs() < 3e-16, "{t}");
            assert!((near.sine_over_angle - far.sine_over_angle).abs() < 3e-16, "{t}");
            let (near, far) = (dexp(t), dexp_far(t));
            for (a, b) in [(near.b, far.b), (near.c, far.c)] {
                assert!((a - b).abs() < 3e-16, "{t}: {a} {b}");
            }
            for (a, b) in [(near.b_slope, far.b_slope), (near.c_slope, far.c_slope)] {
                assert!((a - b).abs() < 1e-15, "{t}: {a} {b}");
            }
            let (near, far) = (dexp_curvature(t), dexp_curvature_far(t));
            assert!((near.b - far.b).abs() < 1e-14 && (near.c - far.c).abs() < 1e-14, "{t}");
        }
    }
}
