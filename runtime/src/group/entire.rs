//! The functions of t = θ² = |x|² that exp and its differential on so(3) need, from cₖ(t) = Σⱼ (−t)ʲ/(2j + k)!:
//! c₀ = cos θ, c₁ = sin θ/θ, and cₖ = 1/k! − t cₖ₊₂ (K. Stumpff, *Himmelsmechanik* I, 1959).
//!
//! Near 0 the series of the last two reach rounding, and the others follow downwards; beyond [`NEAR`], where nothing
//! cancels any more, they follow upwards from cosine and sine. Both agree to rounding at the seam, and lanes choose by
//! mask.

use nalgebra::SimdBool;

use crate::number::Scalar;

/// Up to this t (θ = 2.4) the series are exact to rounding.
const NEAR: f64 = 5.8;

/// Coefficients of a series.
const TERMS: usize = 12;

/// 1/k!
const INVERSE_FACTORIALS: [f64; 4] = [1.0, 1.0, 0.5, 1.0 / 6.0];

/// The coefficients of cₖ.
const fn coefficients(k: usize) -> [f64; TERMS] {
    let mut c = [0.0; TERMS];
    let (mut factorial, mut i, mut j) = (1.0, 0, 0);
    while j < TERMS {
        while i < 2 * j + k {
            i += 1;
            factorial *= i as f64;
        }
        c[j] = if j.is_multiple_of(2) { 1.0 / factorial } else { -1.0 / factorial };
        j += 1;
    }
    c
}

/// Σ cₖ tᵏ, in pairs (Estrin) to keep the chain short.
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

/// c₀ … c₅ at t = θ².
#[inline(always)]
pub(crate) fn entire<T: Scalar>(t: T) -> [T; 6] {
    let is_near = t.simd_le(T::of(NEAR));
    let mut c = near(t);
    if !is_near.all() {
        let far = far(t);
        for k in 0..c.len() {
            c[k] = c[k].select(is_near, far[k]);
        }
    }
    c
}

#[inline(always)]
fn near<T: Scalar>(t: T) -> [T; 6] {
    let mut c = [T::of(0.0); 6];
    c[4] = polynomial(&const { coefficients(4) }, t);
    c[5] = polynomial(&const { coefficients(5) }, t);
    for k in (0..4).rev() {
        c[k] = (-t).times_plus(c[k + 2], T::of(INVERSE_FACTORIALS[k]));
    }
    c
}

#[cold]
fn far<T: Scalar>(t: T) -> [T; 6] {
    let angle = t.simd_sqrt();
    let (sine, cosine) = angle.simd_sin_cos();
    let mut c = [T::of(0.0); 6];
    (c[0], c[1]) = (cosine, sine / angle);
    for k in 0..4 {
        c[k + 2] = (T::of(INVERSE_FACTORIALS[k]) - c[k]) / t;
    }
    c
}

/// cos(θ/2) and sin(θ/2)/θ at t = θ².
#[inline(always)]
pub(crate) fn half_angle<T: Scalar>(t: T) -> (T, T) {
    let [cosine, sine, ..] = entire(t * T::of(0.25));
    (cosine, sine * T::of(0.5))
}

/// (1 − (θ/2) cot(θ/2))/θ², the function of (d^R exp)^{−T}; infinite at θ = 2π.
pub(crate) fn dexp_inverse<T: Scalar>(t: T) -> T {
    // With u = t/4 it is (c₁ − c₀)/(4u c₁) at u, where c₁ − c₀ = u (c₂ − c₃).
    let [_, sine, c2, c3, ..] = entire(t * T::of(0.25));
    (c2 - c3) * T::of(0.25) / sine
}

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
    fn series_and_closed_forms_agree_up_to_the_seam() {
        for t in [1.0, 3.0, 5.0, NEAR] {
            for (k, (near, far)) in near::<f64>(t).into_iter().zip(far(t)).enumerate() {
                let bound = if t < 3.0 { 2e-15 } else { 4e-16 };
                assert!((near - far).abs() < bound, "c{k} at {t}: {near} {far}");
            }
        }
    }
}
