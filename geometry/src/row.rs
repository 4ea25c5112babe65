//! Numbers side by side, as those at the nodes of a step. Each has the bits that it would have alone.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;

/// M numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<T, const M: usize>(pub [T; M]);

// Loops, and not the maps of arrays, which stay calls in large formulas.
impl<T: Copy, const M: usize> Row<T, M> {
    #[inline(always)]
    fn one(self, f: impl Fn(T) -> T) -> Self {
        let mut row = self.0;
        for i in 0..M {
            row[i] = f(self.0[i]);
        }
        Self(row)
    }
    #[inline(always)]
    fn two(self, b: Self, f: impl Fn(T, T) -> T) -> Self {
        let mut row = self.0;
        for i in 0..M {
            row[i] = f(self.0[i], b.0[i]);
        }
        Self(row)
    }
}

macro_rules! operators {
    ($($operator:ident $name:ident),*) => {$(
        impl<T: Number, const M: usize> $operator for Row<T, M> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, b: Self) -> Self {
                self.two(b, T::$name)
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl<T: Number, const M: usize> Neg for Row<T, M> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.one(T::neg)
    }
}

impl<T: Number, const M: usize> Number for Row<T, M> {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self([T::of(value); M])
    }
    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        let mut row = self.0;
        for i in 0..M {
            row[i] = self.0[i].times_plus(a.0[i], b.0[i]);
        }
        Self(row)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.one(T::abs)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.one(T::sqrt)
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.one(T::round)
    }
    #[inline(always)]
    fn at_most(self, other: Self, then: Self, otherwise: Self) -> Self {
        let mut row = self.0;
        for i in 0..M {
            row[i] = self.0[i].at_most(other.0[i], then.0[i], otherwise.0[i]);
        }
        Self(row)
    }
    #[inline(always)]
    fn known_at_most(self, limit: f64) -> Option<bool> {
        let first = self.0.first()?.known_at_most(limit)?;
        for i in 1..M {
            if self.0[i].known_at_most(limit) != Some(first) {
                return None;
            }
        }
        Some(first)
    }
}
