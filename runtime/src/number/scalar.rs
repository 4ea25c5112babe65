//! The numbers everything is generic over: `f64`, `f32`, and SIMD lanes of them.

use nalgebra::{RealField, SimdBool, SimdRealField};

/// A real number or a pack of lanes of them.
///
/// Implemented for every `Copy` type with simba's [`SimdRealField`]: `f64`, `f32`, and lane types
/// such as `simba::simd::AutoF64x4`. Code written against it must not branch on a value, only on
/// "all lanes"; then a lane computes the same bits as the scalar does.
pub trait Scalar: SimdRealField<Element: RealField + Copy> + Copy {
    /// The constant `value`, rounded to this type, in every lane.
    #[inline(always)]
    #[must_use]
    fn of(value: f64) -> Self {
        nalgebra::convert(value)
    }

    /// The machine epsilon of one lane.
    #[inline(always)]
    #[must_use]
    fn epsilon() -> Self {
        Self::simd_default_epsilon()
    }

    /// `self · a + b`, fused where the build target has the instruction, two roundings elsewhere
    /// (where a fused product would be a library call).
    #[inline(always)]
    #[must_use]
    fn times_plus(self, a: Self, b: Self) -> Self {
        if cfg!(target_feature = "fma") { self.simd_mul_add(a, b) } else { self * a + b }
    }

    /// The larger of two in each lane, NaN if either is: unlike `simd_max`, it hides nothing.
    #[inline(always)]
    #[must_use]
    fn worse(self, other: Self) -> Self {
        self.simd_max(other) + (self + other) * Self::of(0.0)
    }

    /// The largest lane as `f64`; NaN if any lane is NaN. For reports, not for the hot path.
    #[must_use]
    fn largest_lane(self) -> f64 {
        let mut largest = f64::NEG_INFINITY;
        for lane in 0..Self::LANES {
            let value: f64 = nalgebra::try_convert(self.extract(lane)).unwrap_or(f64::NAN);
            if value.is_nan() {
                return f64::NAN;
            }
            largest = largest.max(value);
        }
        largest
    }

    /// Whether every lane is finite.
    #[inline(always)]
    #[must_use]
    fn all_finite(self) -> bool {
        let zero = self * Self::of(0.0);
        // NaN and infinity times zero are NaN, which equals nothing.
        zero.simd_eq(Self::of(0.0)).all()
    }
}

impl<T> Scalar for T where T: SimdRealField<Element: RealField + Copy> + Copy {}
