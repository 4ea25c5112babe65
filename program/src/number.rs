//! The numbers that programs are evaluated in: scalars, and several at once.

use crate::bits::{exponent, power_of_two};

/// A number, or several in lanes, with the operations of [`Node`](crate::Node), each rounded once.
pub(crate) trait Number: Copy {
    /// The same number in all lanes.
    fn of(value: f64) -> Self;
    /// a + b
    fn add(self, b: Self) -> Self;
    /// a − b
    fn sub(self, b: Self) -> Self;
    /// a · b
    fn mul(self, b: Self) -> Self;
    /// a · b + c, rounded once.
    fn times_plus(self, b: Self, c: Self) -> Self;
    /// a / b
    fn div(self, b: Self) -> Self;
    /// −a
    fn neg(self) -> Self;
    /// |a|
    fn abs(self) -> Self;
    /// √a
    fn sqrt(self) -> Self;
    /// The integer nearest to a, the even one of two.
    fn round(self) -> Self;
    /// a · 2ᵏ, by the exponent field of k.
    fn scale(self, k: Self) -> Self;
    /// The exponent of a.
    fn exponent(self) -> Self;
    /// `then` where self ≤ b, else `otherwise`.
    fn select(self, b: Self, then: Self, otherwise: Self) -> Self;
}

#[cfg(not(feature = "std"))]
use libm::{fma as fused, rint as nearest, sqrt as root};
#[cfg(feature = "std")]
use standard::{fused, nearest, root};

#[cfg(feature = "std")]
mod standard {
    #[inline(always)]
    pub(crate) fn fused(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }

    #[inline(always)]
    pub(crate) fn root(a: f64) -> f64 {
        a.sqrt()
    }

    #[inline(always)]
    pub(crate) fn nearest(a: f64) -> f64 {
        a.round_ties_even()
    }
}

impl Number for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        self + b
    }
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self - b
    }
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        self * b
    }
    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        fused(self, b, c)
    }
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        self / b
    }
    #[inline(always)]
    fn neg(self) -> Self {
        -self
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::from_bits(self.to_bits() & (u64::MAX >> 1))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        root(self)
    }
    #[inline(always)]
    fn round(self) -> Self {
        nearest(self)
    }
    #[inline(always)]
    fn scale(self, k: Self) -> Self {
        self * power_of_two(k)
    }
    #[inline(always)]
    fn exponent(self) -> Self {
        exponent(self)
    }
    #[inline(always)]
    fn select(self, b: Self, then: Self, otherwise: Self) -> Self {
        if self <= b { then } else { otherwise }
    }
}

/// L numbers side by side; each lane has the bits that it would have alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes<const L: usize>(pub [f64; L]);

/// The operations of numbers, in each lane.
macro_rules! in_lanes {
    ($($name:ident($($other:ident),*)),*) => {
        impl<const L: usize> Number for Lanes<L> {
            #[inline(always)]
            fn of(value: f64) -> Self {
                Self([value; L])
            }
            $(
                #[inline(always)]
                fn $name(mut self $(, $other: Self)*) -> Self {
                    for l in 0..L {
                        self.0[l] = Number::$name(self.0[l] $(, $other.0[l])*);
                    }
                    self
                }
            )*
        }
    };
}

in_lanes!(
    add(b),
    sub(b),
    mul(b),
    times_plus(b, c),
    div(b),
    neg(),
    abs(),
    sqrt(),
    round(),
    scale(k),
    exponent(),
    select(b, then, otherwise)
);

/// Numbers that know how they lie in memory, and which of them are done.
pub(crate) trait Packed<const L: usize>: Number {
    /// Number i of the list; NaN where it is shorter.
    fn load(list: &[f64], i: usize) -> Self;
    fn store(self, list: &mut [f64], i: usize);
    fn lane(self, lane: usize) -> f64;
    /// In live lanes `new`, in others self.
    fn update(self, live: [bool; L], new: Self) -> Self;
}

impl Packed<1> for f64 {
    #[inline(always)]
    fn load(list: &[f64], i: usize) -> Self {
        list.get(i).copied().unwrap_or(f64::NAN)
    }
    #[inline(always)]
    fn store(self, list: &mut [f64], i: usize) {
        if let Some(place) = list.get_mut(i) {
            *place = self;
        }
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn update(self, live: [bool; 1], new: Self) -> Self {
        if live[0] { new } else { self }
    }
}

impl<const L: usize> Packed<L> for Lanes<L> {
    #[inline(always)]
    fn load(list: &[f64], i: usize) -> Self {
        let mut result = [0.0; L];
        for (lane, value) in result.iter_mut().enumerate() {
            *value = list.get(i * L + lane).copied().unwrap_or(f64::NAN);
        }
        Self(result)
    }
    #[inline(always)]
    fn store(self, list: &mut [f64], i: usize) {
        for (lane, value) in self.0.into_iter().enumerate() {
            if let Some(place) = list.get_mut(i * L + lane) {
                *place = value;
            }
        }
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn update(self, live: [bool; L], new: Self) -> Self {
        let mut result = self.0;
        for lane in 0..L {
            if live[lane] {
                result[lane] = new.0[lane];
            }
        }
        Self(result)
    }
}
