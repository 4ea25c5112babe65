//! The functions of logarithms.

use coadjoint_geometry::angle::{Angle, Length};

use crate::number::Scalar;

/// (1 − (θ/2) cot(θ/2))/θ² for θ = 2|x|, the function of (d^R exp)^{−T}; infinite at θ = 2π.
#[inline(always)]
pub(crate) fn dexp_inverse<T: Scalar, const N: usize>(x: [T; N]) -> T {
    // With c₁ = sin|x|/|x| it is (c₁ − cos|x|)/(4|x|² c₁), and c₁ − cos|x| = |x|² (b − c).
    let Angle { half_cosine, half_sine, b, c } = Angle::new(x, Length::Any);
    (b - c) * T::of(0.125) / (half_sine * half_cosine)
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
