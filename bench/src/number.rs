//! What the equations are evaluated in: one number, or several side by side.

use std::ops::{Add, Mul, Neg, Sub};

use crate::arithmetic::fma;

/// The operations that polynomial vector fields need.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Neg<Output = Self>
{
    /// The same number in every lane.
    fn splat(value: f64) -> Self;

    /// a·self + c with one number for every lane.
    #[must_use]
    fn scaled(self, a: f64, c: Self) -> Self;

    /// self·b + c.
    #[must_use]
    fn fused(self, b: Self, c: Self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn scaled(self, a: f64, c: Self) -> Self {
        fma(a, self, c)
    }

    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        fma(self, b, c)
    }
}

/// L numbers treated alike; a compiler makes vector instructions of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const L: usize>(pub [f64; L]);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const L: usize> $trait for Lanes<L> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut result = self.0;
                for lane in 0..L {
                    result[lane] = self.0[lane] $operator other.0[lane];
                }
                Self(result)
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);

impl<const L: usize> Mul<f64> for Lanes<L> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let mut result = self.0;
        for value in &mut result {
            *value *= factor;
        }
        Self(result)
    }
}

impl<const L: usize> Neg for Lanes<L> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let mut result = self.0;
        for value in &mut result {
            *value = -*value;
        }
        Self(result)
    }
}

impl<const L: usize> Number for Lanes<L> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; L])
    }

    #[inline(always)]
    fn scaled(self, a: f64, c: Self) -> Self {
        let mut result = c.0;
        for lane in 0..L {
            result[lane] = fma(a, self.0[lane], c.0[lane]);
        }
        Self(result)
    }

    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        let mut result = c.0;
        for lane in 0..L {
            result[lane] = fma(self.0[lane], b.0[lane], c.0[lane]);
        }
        Self(result)
    }
}
