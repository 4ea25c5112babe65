//! The operations of formulas. They are those of a program's nodes; the only branch is [`Number::at_most`].

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::series::{List, Taylor};
#[cfg(feature = "simba")]
use simba::simd::SimdBool as _;

/// A number, or several side by side.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A constant.
    fn of(value: f64) -> Self;
    /// self · a + b, fused where the target has the instruction.
    fn times_plus(self, a: Self, b: Self) -> Self;
    /// |self|
    fn abs(self) -> Self;
    /// √self
    fn sqrt(self) -> Self;
    /// The nearest integer, of two the even one.
    fn round(self) -> Self;
    /// `then` where self ≤ other, else `otherwise`; that also where one of them is not a number.
    fn at_most(self, other: Self, then: Self, otherwise: Self) -> Self;

    /// True where all these numbers are known to be at most `limit`, false where none is, so that a formula may leave out what
    /// `at_most` would not select. Numbers without values know nothing.
    #[inline(always)]
    fn known_at_most(self, limit: f64) -> Option<bool> {
        let _ = limit;
        None
    }

    // Operations that dual numbers have a shorter way for.

    /// A series at t = Σ xᵢ², or its derivative of this order in t/2.
    #[inline(always)]
    fn even<const N: usize>(x: [Self; N], series: &'static Taylor, order: usize) -> Self {
        sum(&series.0[order], Self::squares(x))
    }
    /// Σ xᵢ²
    #[inline(always)]
    fn squares<const N: usize>(x: [Self; N]) -> Self {
        let mut sum = x[0] * x[0];
        for i in 1..N {
            sum = x[i].times_plus(x[i], sum);
        }
        sum
    }
    /// factor · self
    #[inline(always)]
    fn by(self, factor: f64) -> Self {
        self * Self::of(factor)
    }
    /// factor · self + b
    #[inline(always)]
    fn by_plus(self, factor: f64, b: Self) -> Self {
        self.times_plus(Self::of(factor), b)
    }
}

/// Σ cₖ tᵏ in pairs and pairs of pairs (G. Estrin, 1960), since a chain of fused products is as slow as it is long. A count that
/// is known while compiling leaves nothing but the products.
#[inline(always)]
fn sum<T: Number>(list: &'static List, t: T) -> T {
    let t2 = t * t;
    let t4 = t2 * t2;
    let t8 = t4 * t4;
    let low = list.sixteen(0, [t, t2, t4, t8]);
    if list.count > 16 { list.sixteen(16, [t, t2, t4, t8]).times_plus(t8 * t8, low) } else { low }
}

// Functions, not closures, and each lower half once: closures are not always inlined, and then no count is known.
impl List {
    #[inline(always)]
    fn one<T: Number>(&'static self, k: usize) -> T {
        T::of(self.coefficients[k])
    }
    #[inline(always)]
    fn two<T: Number>(&'static self, k: usize, t: T) -> T {
        let low = self.one(k);
        if k + 1 < self.count { self.one::<T>(k + 1).times_plus(t, low) } else { low }
    }
    #[inline(always)]
    fn four<T: Number>(&'static self, k: usize, [t, t2]: [T; 2]) -> T {
        let low = self.two(k, t);
        if k + 2 < self.count { self.two(k + 2, t).times_plus(t2, low) } else { low }
    }
    #[inline(always)]
    fn eight<T: Number>(&'static self, k: usize, [t, t2, t4]: [T; 3]) -> T {
        let low = self.four(k, [t, t2]);
        if k + 4 < self.count { self.four(k + 4, [t, t2]).times_plus(t4, low) } else { low }
    }
    #[inline(always)]
    fn sixteen<T: Number>(&'static self, k: usize, [t, t2, t4, t8]: [T; 4]) -> T {
        let low = self.eight(k, [t, t2, t4]);
        if k + 8 < self.count { self.eight(k + 8, [t, t2, t4]).times_plus(t8, low) } else { low }
    }
}

#[cfg(feature = "simba")]
impl<T> Number for T
where
    T: simba::simd::SimdRealField<Element: simba::scalar::RealField + Copy> + Copy,
{
    #[inline(always)]
    fn of(value: f64) -> Self {
        simba::scalar::SupersetOf::from_subset(&value)
    }
    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        // Where there is no instruction a fused product would be a library call.
        if cfg!(target_feature = "fma") { self.simd_mul_add(a, b) } else { self * a + b }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.simd_abs()
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.simd_sqrt()
    }
    #[inline(always)]
    fn round(self) -> Self {
        // Numbers from here on are whole, and so is a number that it is added to.
        let whole = Self::of(1.0) / Self::simd_default_epsilon();
        let size = self.simd_abs();
        let rounded = size + whole - whole;
        let size = rounded.select(size.simd_le(whole), size);
        size.simd_copysign(self)
    }
    #[inline(always)]
    fn at_most(self, other: Self, then: Self, otherwise: Self) -> Self {
        then.select(self.simd_le(other), otherwise)
    }
    #[inline(always)]
    fn known_at_most(self, limit: f64) -> Option<bool> {
        let lanes = self.simd_le(Self::of(limit));
        if lanes.all() {
            return Some(true);
        }
        if lanes.any() { None } else { Some(false) }
    }
}
