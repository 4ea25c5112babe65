//! Numbers in the widest registers that a processor has.

use core::ops::{Add, BitAnd, Div, Mul, Neg, Not, Sub};

use coadjoint_program::bits::{exponent, power_of_two};
use pulp::Simd;

use crate::number::{Coefficients, Number, Registers};

/// Several numbers in a register of the instructions `S`; each lane has the bits that a single number would have.
#[derive(Clone, Copy)]
pub(super) struct Register<S: Simd>(S, S::f64s);

/// A truth value for each number of a register.
#[derive(Clone, Copy)]
pub(super) struct Mask<S: Simd>(S, S::m64s);

macro_rules! operators {
    ($($operator:ident $name:ident $function:ident),*) => {$(
        impl<S: Simd> $operator for Register<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0, self.0.$function(self.1, other.1))
            }
        }
    )*};
}

operators!(Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s);

impl<S: Simd> Neg for Register<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0, self.0.xor_f64s(self.1, self.0.splat_f64s(-0.0)))
    }
}

impl<S: Simd> BitAnd for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0, self.0.and_m64s(self.1, other.1))
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0, self.0.not_m64s(self.1))
    }
}

impl<S: Simd> Register<S> {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut list = [0.0; 8];
        let list = &mut list[..S::F64_LANES];
        self.0.partial_store_f64s(list, self.1);
        list.iter_mut().for_each(|number| *number = f(*number));
        Self(self.0, self.0.partial_load_f64s(list))
    }
}

impl<S: Simd> Number for Register<S> {
    type Mask = Mask<S>;

    const SINGLE: bool = false;

    #[inline(always)]
    fn times_plus(self, a: Self, b: Self) -> Self {
        // As a single number has it: with two roundings where the build target has no fused product.
        match cfg!(target_feature = "fma") {
            true => Self(self.0, self.0.mul_add_f64s(self.1, a.1, b.1)),
            false => self * a + b,
        }
    }

    #[inline(always)]
    fn simd_abs(self) -> Self {
        let sign = self.0.splat_f64s(-0.0);
        Self(self.0, self.0.and_f64s(self.0.not_f64s(sign), self.1))
    }

    #[inline(always)]
    fn simd_sqrt(self) -> Self {
        Self(self.0, self.0.sqrt_f64s(self.1))
    }

    #[inline(always)]
    fn simd_round(self) -> Self {
        // As a single number has it.
        let whole = Self(self.0, self.0.splat_f64s(1.0 / f64::EPSILON));
        let size = self.simd_abs();
        let rounded = size + whole - whole;
        let size = rounded.select(size.simd_le(whole), size);
        let sign = self.0.and_f64s(self.1, self.0.splat_f64s(-0.0));
        Self(self.0, self.0.or_f64s(size.1, sign))
    }

    #[inline(always)]
    fn scale(self, k: Self) -> Self {
        let powers = k.map(power_of_two);
        self * powers
    }

    #[inline(always)]
    fn exponent(self) -> Self {
        self.map(exponent)
    }

    #[inline(always)]
    fn simd_le(self, other: Self) -> Mask<S> {
        Mask(self.0, self.0.less_than_or_equal_f64s(self.1, other.1))
    }

    #[inline(always)]
    fn select(self, lanes: Mask<S>, other: Self) -> Self {
        Self(self.0, self.0.select_f64s(lanes.1, self.1, other.1))
    }

    #[inline(always)]
    fn any(lanes: Mask<S>) -> bool {
        lanes.0.first_true_m64s(lanes.1) < S::F64_LANES
    }
}

/// Coefficients that are spread over the lanes where they are read.
#[derive(Clone, Copy)]
struct Spread<'a, S, const SLOTS: usize>(S, &'a [f64; SLOTS]);

impl<S: Simd, const SLOTS: usize> Coefficients<Register<S>> for Spread<'_, S, SLOTS> {
    #[inline(always)]
    fn at(self, place: usize) -> Register<S> {
        self.of(self.1[place])
    }
    #[inline(always)]
    fn of(self, value: f64) -> Register<S> {
        Register(self.0, self.0.splat_f64s(value))
    }
    #[inline(always)]
    fn epsilon(self) -> Register<S> {
        self.of(f64::EPSILON)
    }
}

#[derive(Clone, Copy)]
pub(super) struct Of<S>(pub(super) S);

impl<S: Simd> Registers for Of<S> {
    type Number = Register<S>;

    const LANES: usize = S::F64_LANES;

    #[inline(always)]
    fn coefficients<const SLOTS: usize>(
        self,
        coefficients: &[f64; SLOTS],
    ) -> impl Coefficients<Register<S>> {
        Spread(self.0, coefficients)
    }

    #[inline(always)]
    fn load(self, list: &[f64]) -> Register<S> {
        Register(self.0, self.0.partial_load_f64s(list))
    }

    #[inline(always)]
    fn store(self, number: Register<S>, list: &mut [f64]) {
        self.0.partial_store_f64s(list, number.1);
    }
}
