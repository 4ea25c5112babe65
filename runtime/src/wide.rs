//! Eight lanes in one register, where the build target has such.

use core::array::from_fn;
use core::ops::{
    Add, AddAssign, BitAnd, BitOr, BitXor, Div, DivAssign, Mul, MulAssign, Neg, Not, Rem,
    RemAssign, Sub, SubAssign,
};

use nalgebra::{
    ComplexField, Field, RealField, SimdBool, SimdComplexField, SimdPartialOrd, SimdRealField,
    SimdValue,
};
use num_traits::{FromPrimitive, Num, One, Zero};
use simba::scalar::{SubsetOf, SupersetOf};
use simba::simd::{PrimitiveSimdValue, SimdSigned};
use wide::f64x8;

/// As many numbers as a register holds, for steps that are solved at once: eight where the build target has
/// such registers, or else four.
#[cfg(target_feature = "avx512f")]
pub type Steps = WideF64x8;
/// As many numbers as a register holds, for steps that are solved at once.
#[cfg(not(target_feature = "avx512f"))]
pub type Steps = simba::simd::WideF64x4;

/// The number of lanes.
pub const LANES: usize = 8;

/// Eight `f64`, as simba's `WideF64x4` is four: operations are the registers' own, where
/// [`F64x8`](crate::F64x8) leaves it to the compiler to find them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct WideF64x8(f64x8);

/// What comparing them gives: all bits of a lane, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct WideBoolF64x8(f64x8);

impl From<[f64; LANES]> for WideF64x8 {
    #[inline(always)]
    fn from(lanes: [f64; LANES]) -> Self {
        Self(f64x8::from(lanes))
    }
}

impl From<WideF64x8> for [f64; LANES] {
    #[inline(always)]
    fn from(wide: WideF64x8) -> Self {
        wide.0.into()
    }
}

impl WideF64x8 {
    /// The same of every lane; slow.
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        Self::from(<[f64; LANES]>::from(self).map(f))
    }

    /// The same of every pair of lanes; slow.
    fn pairs(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b): ([f64; LANES], [f64; LANES]) = (self.into(), other.into());
        Self::from(from_fn::<_, LANES, _>(|k| f(a[k], b[k])))
    }
}

/// All bits set, or none.
fn mask(holds: bool) -> f64 {
    f64::from_bits(if holds { u64::MAX } else { 0 })
}

impl WideBoolF64x8 {
    /// The masks' bits.
    #[inline(always)]
    fn bits(self) -> [u64; LANES] {
        <[f64; LANES]>::from(self.0).map(f64::to_bits)
    }
}

impl PrimitiveSimdValue for WideF64x8 {}
impl PrimitiveSimdValue for WideBoolF64x8 {}

// simba's trait has unsafe methods, without checks; these check.
#[allow(unsafe_code)]
impl SimdValue for WideF64x8 {
    const LANES: usize = LANES;
    type Element = f64;
    type SimdBool = WideBoolF64x8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(f64x8::splat(value))
    }

    #[inline(always)]
    fn extract(&self, lane: usize) -> f64 {
        <[f64; LANES]>::from(*self)[lane]
    }

    #[inline(always)]
    unsafe fn extract_unchecked(&self, lane: usize) -> f64 {
        self.extract(lane)
    }

    #[inline(always)]
    fn replace(&mut self, lane: usize, value: f64) {
        let mut lanes = <[f64; LANES]>::from(*self);
        lanes[lane] = value;
        *self = Self::from(lanes);
    }

    #[inline(always)]
    unsafe fn replace_unchecked(&mut self, lane: usize, value: f64) {
        self.replace(lane, value);
    }

    #[inline(always)]
    fn select(self, condition: WideBoolF64x8, other: Self) -> Self {
        Self(condition.0.select(self.0, other.0))
    }
}

#[allow(unsafe_code)]
impl SimdValue for WideBoolF64x8 {
    const LANES: usize = LANES;
    type Element = bool;
    type SimdBool = Self;

    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(f64x8::splat(mask(value)))
    }

    #[inline(always)]
    fn extract(&self, lane: usize) -> bool {
        self.bits()[lane] != 0
    }

    #[inline(always)]
    unsafe fn extract_unchecked(&self, lane: usize) -> bool {
        self.extract(lane)
    }

    #[inline(always)]
    fn replace(&mut self, lane: usize, value: bool) {
        let mut lanes = <[f64; LANES]>::from(self.0);
        lanes[lane] = mask(value);
        *self = Self(f64x8::from(lanes));
    }

    #[inline(always)]
    unsafe fn replace_unchecked(&mut self, lane: usize, value: bool) {
        self.replace(lane, value);
    }

    #[inline(always)]
    fn select(self, condition: Self, other: Self) -> Self {
        Self(condition.0.select(self.0, other.0))
    }
}

impl Not for WideBoolF64x8 {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl SimdBool for WideBoolF64x8 {
    #[inline(always)]
    fn bitmask(self) -> u64 {
        self.bits().iter().rev().fold(0, |mask, &bits| (mask << 1) | (bits & 1))
    }

    #[inline(always)]
    fn and(self) -> bool {
        self.all()
    }

    #[inline(always)]
    fn or(self) -> bool {
        self.any()
    }

    #[inline(always)]
    fn xor(self) -> bool {
        self.bitmask().count_ones() % 2 == 1
    }

    #[inline(always)]
    fn all(self) -> bool {
        self.bits().iter().all(|&bits| bits != 0)
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.bits().iter().any(|&bits| bits != 0)
    }

    #[inline(always)]
    fn none(self) -> bool {
        !self.any()
    }

    #[inline(always)]
    fn if_else<R: SimdValue<SimdBool = Self>>(
        self,
        value: impl FnOnce() -> R,
        otherwise: impl FnOnce() -> R,
    ) -> R {
        value().select(self, otherwise())
    }

    #[inline(always)]
    fn if_else2<R: SimdValue<SimdBool = Self>>(
        self,
        value: impl FnOnce() -> R,
        (condition, second): (impl FnOnce() -> Self, impl FnOnce() -> R),
        otherwise: impl FnOnce() -> R,
    ) -> R {
        value().select(self, condition().if_else(second, otherwise))
    }

    #[inline(always)]
    fn if_else3<R: SimdValue<SimdBool = Self>>(
        self,
        value: impl FnOnce() -> R,
        second: (impl FnOnce() -> Self, impl FnOnce() -> R),
        (condition, third): (impl FnOnce() -> Self, impl FnOnce() -> R),
        otherwise: impl FnOnce() -> R,
    ) -> R {
        let rest = condition().if_else(third, otherwise);
        value().select(self, second.0().if_else(second.1, || rest))
    }
}

macro_rules! operators {
    ($($of:ident: $operator:ident, $function:ident;)*) => {$(
        impl $operator for $of {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    )*};
}
operators! {
    WideF64x8: Add, add; WideF64x8: Sub, sub; WideF64x8: Mul, mul; WideF64x8: Div, div;
    WideBoolF64x8: BitAnd, bitand; WideBoolF64x8: BitOr, bitor; WideBoolF64x8: BitXor, bitxor;
}

impl Rem for WideF64x8 {
    type Output = Self;

    fn rem(self, other: Self) -> Self {
        self.pairs(other, |a, b| a % b)
    }
}

macro_rules! assignments {
    ($($operator:ident, $function:ident, $by:ident;)*) => {$(
        impl $operator for WideF64x8 {
            #[inline(always)]
            fn $function(&mut self, other: Self) {
                *self = self.$by(other);
            }
        }
    )*};
}
assignments! {
    AddAssign, add_assign, add; SubAssign, sub_assign, sub; MulAssign, mul_assign, mul;
    DivAssign, div_assign, div; RemAssign, rem_assign, rem;
}

impl Neg for WideF64x8 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for WideF64x8 {
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }

    #[inline(always)]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for WideF64x8 {
    #[inline(always)]
    fn one() -> Self {
        Self::splat(1.0)
    }
}

impl Num for WideF64x8 {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;

    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        <f64 as Num>::from_str_radix(text, radix).map(Self::splat)
    }
}

impl FromPrimitive for WideF64x8 {
    fn from_i64(n: i64) -> Option<Self> {
        f64::from_i64(n).map(Self::splat)
    }

    fn from_u64(n: u64) -> Option<Self> {
        f64::from_u64(n).map(Self::splat)
    }

    fn from_f64(n: f64) -> Option<Self> {
        Some(Self::splat(n))
    }
}

impl Field for WideF64x8 {}

impl SubsetOf<Self> for WideF64x8 {
    #[inline(always)]
    fn to_superset(&self) -> Self {
        *self
    }

    #[inline(always)]
    fn from_superset_unchecked(element: &Self) -> Self {
        *element
    }

    #[inline(always)]
    fn is_in_subset(_: &Self) -> bool {
        true
    }
}

macro_rules! supersets {
    ($($number:ty),*) => {$(
        impl SupersetOf<$number> for WideF64x8 {
            #[inline(always)]
            fn is_in_subset(&self) -> bool {
                let first = self.extract(0);
                *self == Self::splat(first) && <f64 as SupersetOf<$number>>::is_in_subset(&first)
            }

            #[inline(always)]
            fn to_subset_unchecked(&self) -> $number {
                self.extract(0).to_subset_unchecked()
            }

            #[inline(always)]
            fn from_subset(&element: &$number) -> Self {
                Self::splat(f64::from(element))
            }
        }
    )*};
}
supersets!(f32, f64);

macro_rules! comparisons {
    ($($function:ident)*) => {$(
        #[inline(always)]
        fn $function(self, other: Self) -> WideBoolF64x8 {
            WideBoolF64x8(self.0.$function(other.0))
        }
    )*};
}

impl SimdPartialOrd for WideF64x8 {
    comparisons!(simd_gt simd_lt simd_ge simd_le simd_eq simd_ne);

    #[inline(always)]
    fn simd_max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn simd_min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn simd_clamp(self, least: Self, most: Self) -> Self {
        self.simd_min(most).simd_max(least)
    }

    fn simd_horizontal_min(self) -> f64 {
        <[f64; LANES]>::from(self).into_iter().fold(f64::INFINITY, f64::min)
    }

    fn simd_horizontal_max(self) -> f64 {
        <[f64; LANES]>::from(self).into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
}

impl SimdSigned for WideF64x8 {
    #[inline(always)]
    fn simd_abs(&self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn simd_abs_sub(&self, other: &Self) -> Self {
        (*self - *other).simd_max(Self::zero())
    }

    fn simd_signum(&self) -> Self {
        self.each(<f64 as ComplexField>::signum)
    }

    #[inline(always)]
    fn is_simd_positive(&self) -> WideBoolF64x8 {
        self.simd_gt(Self::zero())
    }

    #[inline(always)]
    fn is_simd_negative(&self) -> WideBoolF64x8 {
        self.simd_lt(Self::zero())
    }
}

macro_rules! constants {
    ($($function:ident: $scalar:ident;)*) => {$(
        #[inline(always)]
        fn $function() -> Self {
            Self::splat(<f64 as RealField>::$scalar())
        }
    )*};
}

impl SimdRealField for WideF64x8 {
    fn simd_atan2(self, other: Self) -> Self {
        self.pairs(other, <f64 as RealField>::atan2)
    }

    fn simd_copysign(self, sign: Self) -> Self {
        self.pairs(sign, <f64 as RealField>::copysign)
    }

    #[inline(always)]
    fn simd_default_epsilon() -> Self {
        Self::splat(f64::EPSILON)
    }

    constants! {
        simd_pi: pi; simd_two_pi: two_pi; simd_frac_pi_2: frac_pi_2; simd_frac_pi_3: frac_pi_3;
        simd_frac_pi_4: frac_pi_4; simd_frac_pi_6: frac_pi_6; simd_frac_pi_8: frac_pi_8;
        simd_frac_1_pi: frac_1_pi; simd_frac_2_pi: frac_2_pi;
        simd_frac_2_sqrt_pi: frac_2_sqrt_pi; simd_e: e; simd_log2_e: log2_e;
        simd_log10_e: log10_e; simd_ln_2: ln_2; simd_ln_10: ln_10;
    }
}

macro_rules! each {
    ($($function:ident: $scalar:ident;)*) => {$(
        fn $function(self) -> Self {
            self.each(<f64 as ComplexField>::$scalar)
        }
    )*};
}

impl SimdComplexField for WideF64x8 {
    type SimdRealField = Self;

    #[inline(always)]
    fn from_simd_real(re: Self) -> Self {
        re
    }

    #[inline(always)]
    fn simd_real(self) -> Self {
        self
    }

    #[inline(always)]
    fn simd_imaginary(self) -> Self {
        Self::zero()
    }

    #[inline(always)]
    fn simd_modulus(self) -> Self {
        SimdSigned::simd_abs(&self)
    }

    #[inline(always)]
    fn simd_modulus_squared(self) -> Self {
        self * self
    }

    fn simd_argument(self) -> Self {
        self.each(<f64 as ComplexField>::argument)
    }

    #[inline(always)]
    fn simd_norm1(self) -> Self {
        SimdSigned::simd_abs(&self)
    }

    #[inline(always)]
    fn simd_scale(self, factor: Self) -> Self {
        self * factor
    }

    #[inline(always)]
    fn simd_unscale(self, factor: Self) -> Self {
        self / factor
    }

    #[inline(always)]
    fn simd_abs(self) -> Self {
        SimdSigned::simd_abs(&self)
    }

    #[inline(always)]
    fn simd_mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0))
    }

    #[inline(always)]
    fn simd_sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn simd_recip(self) -> Self {
        Self::one() / self
    }

    #[inline(always)]
    fn simd_conjugate(self) -> Self {
        self
    }

    fn simd_hypot(self, other: Self) -> Self {
        self.pairs(other, <f64 as ComplexField>::hypot)
    }

    fn simd_sin_cos(self) -> (Self, Self) {
        (self.simd_sin(), self.simd_cos())
    }

    fn simd_log(self, base: Self) -> Self {
        self.pairs(base, <f64 as ComplexField>::log)
    }

    fn simd_powi(self, n: i32) -> Self {
        self.each(|x| <f64 as ComplexField>::powi(x, n))
    }

    fn simd_powf(self, n: Self) -> Self {
        self.pairs(n, <f64 as ComplexField>::powf)
    }

    fn simd_powc(self, n: Self) -> Self {
        self.pairs(n, <f64 as ComplexField>::powc)
    }

    each! {
        simd_floor: floor; simd_ceil: ceil; simd_round: round; simd_trunc: trunc;
        simd_fract: fract; simd_sin: sin; simd_cos: cos; simd_tan: tan; simd_asin: asin;
        simd_acos: acos; simd_atan: atan; simd_sinh: sinh; simd_cosh: cosh; simd_tanh: tanh;
        simd_asinh: asinh; simd_acosh: acosh; simd_atanh: atanh; simd_log2: log2;
        simd_log10: log10; simd_ln: ln; simd_ln_1p: ln_1p; simd_exp: exp; simd_exp2: exp2;
        simd_exp_m1: exp_m1; simd_cbrt: cbrt;
    }

    fn simd_horizontal_sum(self) -> f64 {
        <[f64; LANES]>::from(self).into_iter().sum()
    }

    fn simd_horizontal_product(self) -> f64 {
        <[f64; LANES]>::from(self).into_iter().product()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f64; LANES] = [1.5, -2.0, 0.0, 3.25, -0.5, 1e-3, 7.0, -1.0];
    const B: [f64; LANES] = [0.5, 4.0, -1.0, 3.25, 2.0, -1e-3, 0.1, -3.0];

    fn lanes(wide: WideF64x8) -> [f64; LANES] {
        wide.into()
    }

    /// Every operation is the scalar's in every lane, to the last bit.
    #[test]
    fn operations_are_those_of_the_lanes() {
        let (a, b) = (WideF64x8::from(A), WideF64x8::from(B));
        type Operation = (fn(WideF64x8, WideF64x8) -> WideF64x8, fn(f64, f64) -> f64);
        let operations: [Operation; 12] = [
            (|a, b| a + b, |a, b| a + b),
            (|a, b| a - b, |a, b| a - b),
            (|a, b| a * b, |a, b| a * b),
            (|a, b| a / b, |a, b| a / b),
            (|a, b| a % b, |a, b| a % b),
            (|a, _| -a, |a, _| -a),
            (|a, b| a.simd_max(b), f64::max),
            (|a, b| a.simd_min(b), f64::min),
            (
                |a, _| SimdComplexField::simd_abs(a).simd_sqrt(),
                |a, _| ComplexField::sqrt(ComplexField::abs(a)),
            ),
            (|a, b| a.simd_copysign(b), RealField::copysign),
            (
                |a, b| SimdComplexField::simd_abs(a).simd_powf(b),
                |a, b| ComplexField::powf(ComplexField::abs(a), b),
            ),
            (|a, _| a.simd_sin(), |a, _| ComplexField::sin(a)),
        ];
        for (number, (wide, scalar)) in operations.into_iter().enumerate() {
            let expected: [f64; LANES] = from_fn(|k| scalar(A[k], B[k]));
            assert_eq!(lanes(wide(a, b)), expected, "operation {number}");
        }
        let fused = WideF64x8::splat(0.1).simd_mul_add(WideF64x8::splat(10.0), -WideF64x8::one());
        assert!(fused.extract(3) == 0.1_f64.mul_add(10.0, -1.0) || fused.extract(3) == 0.0);
    }

    #[test]
    fn masks_choose_lane_by_lane() {
        let (a, b) = (WideF64x8::from(A), WideF64x8::from(B));
        let less = a.simd_lt(b);
        let expected = A.iter().zip(&B).enumerate();
        let expected = expected.map(|(k, (a, b))| u64::from(a < b) << k).sum::<u64>();
        assert_eq!(less.bitmask(), expected);
        assert_eq!((!less).bitmask(), !expected & 0xff);
        assert_eq!(less.xor(), expected.count_ones() % 2 == 1);
        assert_eq!(lanes(a.select(less, b)), from_fn(|k| A[k].min(B[k])));
        assert!(less.any() && !less.all() && !less.none() && less.or() && !less.and());
        assert!(a.simd_eq(a).all() && a.simd_ne(a).none() && (a.simd_ge(b) ^ less).all());
        let swapped = less.if_else(|| b, || a);
        assert_eq!(lanes(swapped), from_fn(|k| A[k].max(B[k])));
        let mut mask = WideBoolF64x8::splat(false);
        mask.replace(5, true);
        assert!(mask.extract(5) && mask.bitmask() == 32);
        let mut changed = a;
        changed.replace(2, 9.0);
        assert_eq!((changed.extract(2), changed.extract(3)), (9.0, A[3]));
    }

    #[test]
    fn lanes_are_summed_and_compared() {
        let a = WideF64x8::from(A);
        assert_eq!(a.simd_horizontal_max(), 7.0);
        assert_eq!(a.simd_horizontal_min(), -2.0);
        assert_eq!(a.simd_horizontal_sum(), A.iter().sum::<f64>());
        assert!(a.is_zero() == (a == WideF64x8::zero()));
        let same: Option<f64> = nalgebra::try_convert(WideF64x8::splat(2.5));
        let mixed: Option<f64> = nalgebra::try_convert(a);
        assert_eq!((same, mixed), (Some(2.5), None));
    }
}
