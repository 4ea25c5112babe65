//! Numbers side by side, as those at the nodes of a step. Each has the bits that it would have alone.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;

/// M numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuple<T, const M: usize>(pub [T; M]);

/// Operations of numbers side by side, as methods of a trait; with loops, and not the maps of arrays, which stay calls in
/// large formulas.
macro_rules! by_number {
    ($($name:ident($($other:ident),*)),*) => {$(
        #[inline(always)]
        fn $name(self $(, $other: Self)*) -> Self {
            let mut row = self.0;
            for i in 0..M {
                row[i] = self.0[i].$name($($other.0[i]),*);
            }
            Self(row)
        }
    )*};
}

macro_rules! operators {
    ($($operator:ident $name:ident($($other:ident)?)),*) => {$(
        impl<T: Number, const M: usize> $operator for Tuple<T, M> {
            type Output = Self;

            by_number!($name($($other)?));
        }
    )*};
}

operators!(Add add(b), Sub sub(b), Mul mul(b), Div div(b), Neg neg());

impl<T: Number, const M: usize> Number for Tuple<T, M> {
    by_number!(times_plus(a, b), abs(), sqrt(), round(), at_most(other, then, otherwise));

    #[inline(always)]
    fn of(value: f64) -> Self {
        Self([T::of(value); M])
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
