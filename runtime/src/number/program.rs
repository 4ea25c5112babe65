//! The numbers that programs compute with, and how coefficients become such numbers.

use core::ops::{Add, BitAnd, Div, Mul, Neg, Not, Sub};

use nalgebra::{SimdBool, SimdValue};

use super::scalar::Scalar;

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

    /// Whether there is one lane only.
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
    /// Where self ≤ other.
    fn simd_le(self, other: Self) -> Self::Mask;
    /// self in the lanes of a mask, in others `other`.
    fn select(self, lanes: Self::Mask, other: Self) -> Self;
    /// Whether a mask has any lane.
    fn any(lanes: Self::Mask) -> bool;
}

impl<T: Scalar> Number for T {
    type Mask = <T as SimdValue>::SimdBool;

    const SINGLE: bool = T::LANES == 1;

    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        Scalar::times_plus(self, a, b)
    }
    #[inline(always)]
    fn simd_abs(self) -> Self {
        nalgebra::SimdComplexField::simd_abs(self)
    }
    #[inline(always)]
    fn simd_sqrt(self) -> Self {
        nalgebra::SimdComplexField::simd_sqrt(self)
    }
    #[inline(always)]
    fn simd_round(self) -> Self {
        // Numbers from here on are whole, and so is what is added to it.
        let whole = T::of(1.0) / <T as Scalar>::epsilon();
        let size = self.simd_abs();
        let rounded = size + whole - whole;
        let size = rounded.select(size.simd_le(whole), size);
        nalgebra::SimdRealField::simd_copysign(size, self)
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
    /// How many.
    const LANES: usize;

    /// The same coefficients for all lanes.
    fn coefficients<const SLOTS: usize>(
        self,
        coefficients: &[f64; SLOTS],
    ) -> impl Coefficients<Self::Number>;
    /// The numbers of a list, which has one for each lane.
    fn load(self, list: &[f64]) -> Self::Number;
    /// Writes the numbers to a list, which has a place for each lane.
    fn store(self, number: Self::Number, list: &mut [f64]);
}
