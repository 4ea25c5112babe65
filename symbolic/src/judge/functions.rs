//! Functions in doubled precision, and in double precision those of the standard library.
//!
//! Arguments are reduced, and what is left goes through Taylor's series; inverse functions correct the double next to them
//! once, which squares its error.
//! A crate does not take their place: exp, ln, atan and tanh of `twofloat` 0.8 have 13 to 18 digits, and `qd` 0.8 has
//! no sine.

use coadjoint_program::Function;

use super::DoubleDouble;
use super::linear::{Functions, Real};

/// ln 2 and π/2: the nearest double and the rest.
const LN_2: (f64, f64) = (std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
const QUARTER: (f64, f64) = (std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);

/// A function's value and slope; not a number outside its domain.
pub(super) fn elementary<T: Real>(function: Function, a: T) -> [T; 2] {
    let one = T::one();
    match function {
        Function::Exp => [a.exp(); 2],
        Function::Ln => [a.ln(), one / a],
        Function::Sin => a.sin_cos().into(),
        Function::Cos => {
            let (sine, cosine) = a.sin_cos();
            [cosine, -sine]
        }
        Function::Tan => {
            let (sine, cosine) = a.sin_cos();
            [sine / cosine, one / (cosine * cosine)]
        }
        Function::Atan => [a.atan(), one / (one + a * a)],
        Function::Tanh => {
            // exp(−2|a|) does not overflow.
            let size = if a.double() < 0.0 { a } else { -a };
            let small = (size + size).exp();
            let value = (one - small) / (one + small);
            let value = if a.double() < 0.0 { -value } else { value };
            [value, one - value * value]
        }
        Function::Power(m, n) => {
            let [top, bottom] = [f64::from(m), f64::from(n)].map(T::from);
            [power(a, m, n), power(a, m - n as i32, n) * top / bottom]
        }
    }
}

/// a to the power m/n.
fn power<T: Real>(a: T, m: i32, n: u32) -> T {
    if n == 1 {
        let product = (0..m.unsigned_abs()).fold(T::one(), |product, _| product * a);
        return if m < 0 { T::one() / product } else { product };
    }
    match a.is_zero() && m > 0 {
        true => a,
        false => (a.ln() * T::from(f64::from(m)) / T::from(f64::from(n))).exp(),
    }
}

impl Functions for DoubleDouble {
    fn sqrt(self) -> Self {
        let root = Self::from(self.to_f64().sqrt());
        match root.to_f64() == 0.0 {
            true => root,
            false => root + (self - root * root) / (root + root),
        }
    }

    fn exp(self) -> Self {
        const HALVINGS: i64 = 9;
        let first = self.to_f64();
        if !(first.abs() < 745.0) {
            return first.exp().into();
        }
        let twos = (first / LN_2.0).round();
        // The remainder modulo ln 2, halved nine times.
        let rest = (self - Self::new(LN_2.0, LN_2.1) * twos.into()).scaled(-HALVINGS);
        // eʳ − 1, so that no digits are lost beside 1.
        let more = (2..11_u8).rev().fold(Self::from(1.0), |sum, k| {
            Self::from(1.0) + rest * sum / Self::from(f64::from(k))
        });
        let more = (0..HALVINGS).fold(rest * more, |more, _| more * (more + 2.0.into()));
        (more + 1.0.into()).scaled(twos as i64)
    }

    fn ln(self) -> Self {
        let value = Self::from(self.to_f64().ln());
        if !value.is_finite() {
            return value;
        }
        // ln q = 2 (q − 1)/(q + 1) to third order.
        let quotient = self * (-value).exp();
        let less = quotient - 1.0.into();
        value + (less + less) / (quotient + 1.0.into())
    }

    fn sin_cos(self) -> (Self, Self) {
        let quarters = (self.to_f64() / QUARTER.0).round();
        let rest = self - Self::new(QUARTER.0, QUARTER.1) * quarters.into();
        let (mut sums, mut term) = ([Self::from(1.0), rest], rest);
        for k in 2..30_u8 {
            term = term * rest / Self::from(f64::from(k));
            let signed = if k % 4 < 2 { term } else { -term };
            sums[usize::from(k % 2)] += signed;
        }
        let [cosine, sine] = sums;
        match quarters.rem_euclid(4.0) as u8 {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    fn atan(self) -> Self {
        let angle = Self::from(self.to_f64().atan());
        let (sine, cosine) = angle.sin_cos();
        angle + (self * cosine - sine) / (cosine + self * sine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> DoubleDouble {
        value.into()
    }

    /// f(a).
    fn of(function: Function, a: DoubleDouble) -> DoubleDouble {
        elementary(function, a)[0]
    }

    /// Asserts that a and b differ by `bound` at most, relative to b.
    fn close(what: &str, a: DoubleDouble, b: DoubleDouble, bound: f64) {
        let error = ((a - b).to_f64() / b.to_f64()).abs();
        assert!(error <= bound, "{what}: {} {error:e}", b.to_f64());
    }

    /// Arguments of both signs, from tiny to large, with digits in both halves.
    fn arguments(largest: f64) -> impl Iterator<Item = DoubleDouble> {
        let sizes = (0..400).map(|i| 1e-18 * 1.13_f64.powi(i)).take_while(move |&a| a < largest);
        sizes.flat_map(|a| [a, -a]).map(|a| DoubleDouble::new(a, a * 3.1e-17))
    }

    #[test]
    fn functions_satisfy_their_identities_in_doubled_precision() {
        let one = number(1.0);
        for a in arguments(300.0) {
            let (up, down) = (of(Function::Exp, a), of(Function::Exp, -a));
            close("exp a · exp −a", up * down, one, 1e-30 * a.to_f64().abs().max(1.0));
            let tanh = of(Function::Tanh, a);
            close("tanh a", tanh * (up + down), up - down, 1e-30 / a.to_f64().abs().min(1.0));
            close("tanh −a", of(Function::Tanh, -a), -tanh, 0.0);
            close("ln exp a", of(Function::Ln, up), a, 1e-30 / a.to_f64().abs().min(1.0));
        }
        for a in arguments(1e8) {
            let (sine, cosine) = (of(Function::Sin, a), of(Function::Cos, a));
            close("sin² + cos²", sine * sine + cosine * cosine, one, 1e-30);
            close("tan", of(Function::Tan, a) * cosine, sine, 1e-30);
            let double = of(Function::Sin, a + a);
            close("sin 2a", sine * cosine * number(2.0), double, 1e-30 / double.to_f64().abs());
            let size = a.to_f64().abs();
            close("tan atan a", of(Function::Tan, of(Function::Atan, a)), a, 1e-30 * size.max(1.0));
            close("√a², squared", (a * a).sqrt() * (a * a).sqrt(), a * a, 1e-30);
            // By the logarithm, which is as large as this.
            let bound = 1e-31 * (10.0 + size.ln().abs());
            let power = of(Function::Power(2, 3), a * a);
            close("a^(4/3), cubed", power * power * power, a * a * a * a, bound);
            let inverse = of(Function::Power(-1, 2), a * a);
            close("1/|a|", inverse * inverse * a * a, one, bound);
        }
    }
}
