//! Dual numbers a + εb, ε² = 0: SE(3) is SO(3) in these.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;
use crate::series::Taylor;
use crate::vector::{dot, each};

/// a + εb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// a
    pub real: T,
    /// b
    pub dual: T,
}

/// The numbers aᵢ + εbᵢ.
#[inline(always)]
pub fn dual<T: Number>(real: [T; 3], dual: [T; 3]) -> [Dual<T>; 3] {
    let entry = |i: usize| Dual { real: real[i], dual: dual[i] };
    [entry(0), entry(1), entry(2)]
}

/// The real and the dual parts.
#[inline(always)]
pub fn parts<T: Number, const N: usize>(x: [Dual<T>; N]) -> ([T; N], [T; N]) {
    (each(|i| x[i].real), each(|i| x[i].dual))
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { real: self.real + other.real, dual: self.dual + other.dual }
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { real: self.real - other.real, dual: self.dual - other.dual }
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let dual = self.dual.times_plus(other.real, self.real * other.dual);
        Self { real: self.real * other.real, dual }
    }
}

impl<T: Number> Div for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let real = self.real / other.real;
        Self { real, dual: (-real).times_plus(other.dual, self.dual) / other.real }
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { real: -self.real, dual: -self.dual }
    }
}

impl<T: Number> Number for Dual<T> {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self { real: T::of(value), dual: T::of(0.0) }
    }
    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        let dual = self.dual.times_plus(a.real, self.real.times_plus(a.dual, b.dual));
        Self { real: self.real.times_plus(a.real, b.real), dual }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let dual = T::of(0.0).at_most(self.real, self.dual, -self.dual);
        Self { real: self.real.abs(), dual }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.real.sqrt();
        Self { real: root, dual: T::of(0.5) / root * self.dual }
    }
    #[inline(always)]
    fn round(self) -> Self {
        Self { real: self.real.round(), dual: T::of(0.0) }
    }
    #[inline(always)]
    fn at_most(self, other: Self, then: Self, otherwise: Self) -> Self {
        Self {
            real: self.real.at_most(other.real, then.real, otherwise.real),
            dual: self.real.at_most(other.real, then.dual, otherwise.dual),
        }
    }
    #[inline(always)]
    fn known_at_most(self, limit: f64) -> Option<bool> {
        self.real.known_at_most(limit)
    }
    #[inline(always)]
    fn even<const N: usize>(x: [Self; N], series: &'static Taylor, order: usize) -> Self {
        let (real, dual) = parts(x);
        let slope = T::even(real, series, order + 1);
        Self { real: T::even(real, series, order), dual: slope * dot(real, dual) }
    }
    #[inline(always)]
    fn squares<const N: usize>(x: [Self; N]) -> Self {
        let (real, dual) = parts(x);
        Self { real: T::squares(real), dual: dot(real, dual).by(2.0) }
    }
    #[inline(always)]
    fn by(self, factor: f64) -> Self {
        Self { real: self.real.by(factor), dual: self.dual.by(factor) }
    }
    #[inline(always)]
    fn by_plus(self, factor: f64, b: Self) -> Self {
        Self { real: self.real.by_plus(factor, b.real), dual: self.dual.by_plus(factor, b.dual) }
    }
}
