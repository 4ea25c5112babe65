//! Numbers: scalars, and packs of them in the lanes of a register.

use core::ops::{Add, BitAnd, Div, Mul, Neg, Not, Sub};

use coadjoint_geometry::number as geometry;
use nalgebra::{RealField, SimdBool, SimdRealField, SimdValue};

/// Numbers that programs compute with: scalars, lanes of them, and registers of the processor.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A truth value for each lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + Not<Output = Self::Mask>;

    /// True if there is one lane only.
    const SINGLE: bool;

    /// self · a + b, fused where the build target has the instruction.
    fn times_plus(self, a: Self, b: Self) -> Self;
    /// |self|
    fn simd_abs(self) -> Self;
    /// √self
    fn simd_sqrt(self) -> Self;
    /// The nearest integer, of two the even one.
    fn simd_round(self) -> Self;
    /// self · 2ᵏ, for whole k from −1022 to 1023 (−126 to 127 in 32 bits).
    fn scale(self, k: Self) -> Self;
    /// The exponent of self, ⌊log₂ |self|⌋ for normal numbers.
    fn exponent(self) -> Self;
    /// The lanes in which self ≤ other.
    fn simd_le(self, other: Self) -> Self::Mask;
    /// self in the lanes of a mask, in others `other`.
    fn select(self, lanes: Self::Mask, other: Self) -> Self;
    /// True if a mask has any lane set.
    fn any(lanes: Self::Mask) -> bool;
}

impl<T: Scalar> Number for T {
    type Mask = <T as SimdValue>::SimdBool;

    const SINGLE: bool = T::LANES == 1;

    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        geometry::Number::times_plus(self, a, b)
    }
    #[inline(always)]
    fn simd_abs(self) -> Self {
        geometry::Number::abs(self)
    }
    #[inline(always)]
    fn simd_sqrt(self) -> Self {
        geometry::Number::sqrt(self)
    }
    #[inline(always)]
    fn simd_round(self) -> Self {
        geometry::Number::round(self)
    }
    #[inline(always)]
    fn scale(self, k: Self) -> Self {
        self.zip_map_lanes(k, |a, k| {
            let k: f64 = nalgebra::try_convert(k).unwrap_or(f64::NAN);
            a * nalgebra::convert::<f64, T::Element>(coadjoint_program::bits::power_of_two(k))
        })
    }
    #[inline(always)]
    fn exponent(self) -> Self {
        self.map_lanes(|a| {
            let a: f64 = nalgebra::try_convert(a).unwrap_or(f64::NAN);
            nalgebra::convert(coadjoint_program::bits::exponent(a))
        })
    }
    #[inline(always)]
    fn simd_le(self, other: Self) -> Self::Mask {
        nalgebra::SimdPartialOrd::simd_le(self, other)
    }
    #[inline(always)]
    fn select(self, lanes: Self::Mask, other: Self) -> Self {
        SimdValue::select(self, lanes, other)
    }
    #[inline(always)]
    fn any(lanes: Self::Mask) -> bool {
        lanes.any()
    }
}

/// The coefficients of programs, and the constants, as numbers.
pub trait Coefficients<T>: Copy {
    /// The coefficient at a place, in every lane.
    fn at(self, place: usize) -> T;
    /// The constant nearest to a value, in every lane.
    fn of(self, value: f64) -> T;
    /// The distance from 1 to the next larger number.
    fn epsilon(self) -> T;
}

impl<T: Scalar, const SLOTS: usize> Coefficients<T> for &[T; SLOTS] {
    #[inline(always)]
    fn at(self, place: usize) -> T {
        self[place]
    }
    #[inline(always)]
    fn of(self, value: f64) -> T {
        T::of(value)
    }
    #[inline(always)]
    fn epsilon(self) -> T {
        T::epsilon()
    }
}

/// A way to have numbers of several trajectories in registers.
pub trait Registers: Copy {
    /// Several numbers.
    type Number: Number;
    /// The number of lanes.
    const LANES: usize;

    /// One set of coefficients for all lanes.
    fn coefficients<const SLOTS: usize>(
        self,
        coefficients: &[f64; SLOTS],
    ) -> impl Coefficients<Self::Number>;
    /// The numbers of a list, which has one for each lane.
    fn load(self, list: &[f64]) -> Self::Number;
    /// Writes the numbers to a list, which has a place for each lane.
    fn store(self, number: Self::Number, list: &mut [f64]);
}

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
        geometry::Number::of(value)
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
        geometry::Number::times_plus(self, a, b)
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

    /// True if every lane is finite.
    #[inline(always)]
    #[must_use]
    fn all_finite(self) -> bool {
        let zero = self * Self::of(0.0);
        // NaN and infinity times zero are NaN, which equals nothing.
        zero.simd_eq(Self::of(0.0)).all()
    }
}

impl<T> Scalar for T where T: SimdRealField<Element: RealField + Copy> + Copy {}
