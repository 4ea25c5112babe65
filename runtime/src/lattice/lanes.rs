//! Eight numbers side by side, in plain loops that compilers turn into the vectors of the processor.

use core::ops::{Add, Div, Mul, Neg, Sub};

use coadjoint_geometry::number::Number;

/// The numbers of a pack.
pub const LANES: usize = 8;

/// Numbers of sites side by side.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Pack(pub [f64; LANES]);

/// The larger of two numbers; not a number where one of them is none.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

impl Pack {
    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut list = [0.0; LANES];
        for lane in 0..LANES {
            list[lane] = f(self.0[lane], other.0[lane]);
        }
        Self(list)
    }

    /// The larger number of two in each lane; `other` where one of them is not a number.
    #[inline(always)]
    pub fn larger(self, other: Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |a, b| if a > b { a } else { b },
        )
    }

    /// The largest number; not a number where one of them is none.
    #[inline(always)]
    pub fn largest(self) -> f64 {
        self.0.into_iter().fold(f64::NEG_INFINITY, larger)
    }
}

macro_rules! operators {
    ($($operator:ident $name:ident $sign:tt),*) => {$(
        impl $operator for Pack {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.with(other, #[inline(always)] |a, b| a $sign b)
            }
        }
    )*};
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Pack {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self, |a, _| -a)
    }
}

impl Number for Pack {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self([value; LANES])
    }
    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        let mut list = [0.0; LANES];
        for lane in 0..LANES {
            list[lane] = Number::times_plus(self.0[lane], a.0[lane], b.0[lane]);
        }
        Self(list)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.with(self, |a, _| Number::abs(a))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self, |a, _| Number::sqrt(a))
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.with(self, |a, _| Number::round(a))
    }
    #[inline(always)]
    fn at_most(self, other: Self, then: Self, otherwise: Self) -> Self {
        let mut list = [0.0; LANES];
        for lane in 0..LANES {
            let taken = self.0[lane] <= other.0[lane];
            list[lane] = if taken { then.0[lane] } else { otherwise.0[lane] };
        }
        Self(list)
    }
    #[inline(always)]
    fn known_at_most(self, limit: f64) -> Option<bool> {
        let mut within = true;
        for lane in 0..LANES {
            within &= self.0[lane] <= limit;
        }
        within.then_some(true)
    }
}
