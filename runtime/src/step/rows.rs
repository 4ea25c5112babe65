//! Numbers side by side in programs: those at the nodes of a step.

use core::ops::{Add, BitAnd, Div, Mul, Neg, Not, Sub};

use crate::number::{Coefficients, Number};

/// M numbers, each with the bits that it would have alone.
#[derive(Clone, Copy, Debug)]
pub struct Row<T, const M: usize>(pub [T; M]);

/// A truth value for each lane of each number of a row.
#[derive(Clone, Copy, Debug)]
pub struct RowMask<B, const M: usize>([B; M]);

/// The numbers of an array from a place on, with a distance from one to the next.
#[inline(always)]
pub fn row<T: Number, const M: usize>(array: &[T], first: usize, distance: usize) -> Row<T, M> {
    let mut row = [array[first]; M];
    for i in 0..M {
        row[i] = array[first + i * distance];
    }
    Row(row)
}

/// Operations number by number, in loops: closures would not have the instructions of their caller.
macro_rules! by_number {
    ($($name:ident($($other:ident),*))*) => {$(
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
    ($($operator:ident $name:ident($($other:ident)?);)*) => {$(
        impl<T: Number, const M: usize> $operator for Row<T, M> {
            type Output = Self;

            by_number!($name($($other)?));
        }
    )*};
}

operators! { Add add(b); Sub sub(b); Mul mul(b); Div div(b); Neg neg(); }

impl<B: Copy + BitAnd<Output = B>, const M: usize> BitAnd for RowMask<B, M> {
    type Output = Self;

    by_number!(bitand(other));
}

impl<B: Copy + Not<Output = B>, const M: usize> Not for RowMask<B, M> {
    type Output = Self;

    by_number!(not());
}

impl<T: Number, const M: usize> Number for Row<T, M> {
    type Mask = RowMask<T::Mask, M>;

    const SINGLE: bool = T::SINGLE;

    by_number!(times_plus(a, b) simd_abs() simd_sqrt() simd_round() scale(k) exponent());

    #[inline(always)]
    fn simd_le(self, other: Self) -> Self::Mask {
        let mut mask = [self.0[0].simd_le(other.0[0]); M];
        for i in 1..M {
            mask[i] = self.0[i].simd_le(other.0[i]);
        }
        RowMask(mask)
    }

    #[inline(always)]
    fn select(self, lanes: Self::Mask, other: Self) -> Self {
        let mut row = self.0;
        for i in 0..M {
            row[i] = self.0[i].select(lanes.0[i], other.0[i]);
        }
        Self(row)
    }

    #[inline(always)]
    fn any(lanes: Self::Mask) -> bool {
        lanes.0.into_iter().any(T::any)
    }
}

/// Coefficients, each in all numbers of a row.
#[derive(Clone, Copy)]
pub struct RowOf<C, const M: usize>(pub C);

impl<T: Number, C: Coefficients<T>, const M: usize> Coefficients<Row<T, M>> for RowOf<C, M> {
    #[inline(always)]
    fn at(self, place: usize) -> Row<T, M> {
        Row([self.0.at(place); M])
    }
    #[inline(always)]
    fn of(self, value: f64) -> Row<T, M> {
        Row([self.0.of(value); M])
    }
    #[inline(always)]
    fn epsilon(self) -> Row<T, M> {
        Row([self.0.epsilon(); M])
    }
}

/// `then` where a ≤ b, else `otherwise`.
#[inline(always)]
pub fn select<T: Number>(a: T, b: T, then: T, otherwise: T) -> T {
    then.select(a.simd_le(b), otherwise)
}

/// a · 2ᵏ
#[inline(always)]
pub fn scale<T: Number>(a: T, k: T) -> T {
    a.scale(k)
}

/// ⌊log₂ |a|⌋
#[inline(always)]
pub fn exponent<T: Number>(a: T) -> T {
    a.exponent()
}
