//! Functions against those in doubled precision: at most two units in the last place, fused products or not.

use coadjoint_program::{Function, Graph, Program};

use crate::numbers::{Chance, evaluate};

/// The sum of two numbers that do not overlap.
#[derive(Clone, Copy, Debug)]
struct Wide(f64, f64);

impl Wide {
    const LN_2: Self = Self(std::f64::consts::LN_2, 2.319046813846299558e-17);

    fn of(value: f64) -> Self {
        Self(value, 0.0)
    }

    fn sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let b_part = sum - a;
        Self(sum, (a - (sum - b_part)) + (b - b_part))
    }

    fn plus(self, b: Self) -> Self {
        let (high, low) = (Self::sum(self.0, b.0), Self::sum(self.1, b.1));
        let high = Self::sum(high.0, high.1 + low.0);
        Self::sum(high.0, high.1 + low.1)
    }

    fn times(self, b: Self) -> Self {
        let product = self.0 * b.0;
        let rest = self.0.mul_add(b.0, -product);
        Self::sum(product, rest + (self.0 * b.1 + self.1 * b.0))
    }

    fn negative(self) -> Self {
        Self(-self.0, -self.1)
    }

    fn over(self, b: Self) -> Self {
        let first = self.0 / b.0;
        let rest = self.plus(b.times(Self::of(-first)));
        let second = rest.0 / b.0;
        let rest = rest.plus(b.times(Self::of(-second)));
        Self::sum(first, second).plus(Self::of(rest.0 / b.0))
    }

    /// exp as a number near 1 and an exponent.
    fn exp(self) -> (Self, i32) {
        let k = (self.0 / std::f64::consts::LN_2).round();
        let r = self.plus(Self::LN_2.times(Self::of(-k)));
        let terms = (1..30).rev().fold(Self::of(1.0), |sum, n| {
            sum.times(r).over(Self::of(f64::from(n))).plus(Self::of(1.0))
        });
        (terms, k as i32)
    }

    fn ln(x: f64) -> Self {
        let first = x.ln();
        let (back, k) = Self::of(-first).exp();
        let scaled = x * 2_f64.powi(k / 2) * 2_f64.powi(k - k / 2);
        let d = back.times(Self::of(scaled)).plus(Self::of(-1.0));
        let square = d.times(d).times(Self::of(-0.5));
        Self::of(first).plus(d).plus(square)
    }

    fn sine_and_cosine(x: f64) -> [Self; 2] {
        let parts = [1.570796325802803, 9.920935739593517e-10, 5.721188709663575e-18];
        let k = (x / std::f64::consts::FRAC_PI_2).round();
        let r = parts.iter().fold(Self::of(x), |r, part| r.plus(Self::of(-k * part)));
        let r = r.plus(Self::of(-k * 1.6446256936324258e-26));
        let square = r.times(r).negative();
        let series = |first: i32, start: Self| {
            let (mut term, mut sum) = (start, start);
            for n in (first..40).step_by(2) {
                term = term.times(square).over(Self::of(f64::from(n * (n + 1))));
                sum = sum.plus(term);
            }
            sum
        };
        let (sine, cosine) = (series(2, r), series(1, Self::of(1.0)));
        match (k as i64).rem_euclid(4) {
            0 => [sine, cosine],
            1 => [cosine, sine.negative()],
            2 => [sine.negative(), cosine.negative()],
            _ => [cosine.negative(), sine],
        }
    }
}

/// The value in doubled precision, and the power of two that it is to be multiplied by.
fn reference(function: Function, x: f64) -> (Wide, i32) {
    let one = Wide::of(1.0);
    let value = match function {
        Function::Exp => return Wide::of(x).exp(),
        Function::Ln => Wide::ln(x),
        Function::Sin => Wide::sine_and_cosine(x)[0],
        Function::Cos => Wide::sine_and_cosine(x)[1],
        Function::Tan => {
            let [sine, cosine] = Wide::sine_and_cosine(x);
            sine.over(cosine)
        }
        Function::Atan => {
            let first = x.atan();
            let [sine, cosine] = Wide::sine_and_cosine(first);
            let wide = Wide::of(x);
            let d = wide.times(cosine).plus(sine.negative());
            let d = d.over(cosine.plus(wide.times(sine)));
            Wide::of(first).plus(d)
        }
        Function::Tanh => {
            let (e, k) = Wide::of(2.0 * x).exp();
            if k.abs() > 300 {
                return (Wide::of(x.signum()), 0);
            }
            let factor = Wide::of(2_f64.powi(k));
            let e = e.times(factor);
            e.plus(Wide::of(-1.0)).over(e.plus(one))
        }
        Function::Power(m, n) => {
            let ratio = Wide::of(f64::from(m)).over(Wide::of(f64::from(n)));
            return Wide::ln(x).times(ratio).exp();
        }
    };
    (value, 0)
}

/// The error of a value in units of the last place.
fn off(found: f64, (expected, k): (Wide, i32)) -> f64 {
    // Compared where the reference is near 1, so that results near the ends of the range count as well.
    let back = |value: f64| value * 2_f64.powi(-k / 2) * 2_f64.powi(-k - -k / 2);
    let exponent = expected.0.abs().log2().floor() as i32;
    // Numbers with fewer digits are rounded to them.
    let unit = 2_f64.powi((exponent - 52).max(-1074 - k));
    ((back(found) - expected.0) - expected.1).abs() / unit
}

fn program(function: Function) -> Program {
    let graph = Graph::new();
    let x = graph.input(0);
    let y = graph.function(function, x);
    graph.finish(1, &[y])
}

const FUNCTIONS: [(Function, f64, f64); 14] = [
    (Function::Exp, -744.0, 709.78),
    (Function::Ln, 0.0, 0.0),
    (Function::Sin, -100.0, 100.0),
    (Function::Cos, -100.0, 100.0),
    (Function::Tan, -100.0, 100.0),
    (Function::Sin, -1e8, 1e8),
    (Function::Atan, -20.0, 20.0),
    (Function::Tanh, -3.0, 3.0),
    (Function::Power(1, 3), 0.0, 0.0),
    (Function::Power(-3, 4), 0.0, 0.0),
    (Function::Power(3, 2), 0.0, 0.0),
    (Function::Power(-1, 2), 0.0, 0.0),
    (Function::Power(-5, 3), 0.0, 0.0),
    (Function::Power(7, 5), 0.0, 0.0),
];

/// The largest errors on this many arguments of each function, half of them near 0 and 1.
fn worst(count: usize) -> Vec<(Function, f64)> {
    let mut chance = Chance(2);
    let one = |(function, low, high): (Function, f64, f64)| {
        let program = program(function);
        let mut most = 0.0_f64;
        for i in 0..count {
            let x = match (low < high, i % 4) {
                (true, 0 | 1) => chance.between(low, high),
                (true, 2) => chance.between(-1.0, 1.0),
                (true, _) => 2_f64.powf(chance.between(-30.0, 6.0)).min(high),
                (false, 0) => 2_f64.powf(chance.between(-500.0, 500.0)),
                (false, 1) => 2_f64.powf(chance.between(-1.0, 1.0)),
                (false, 2) => 1.0 + 2_f64.powf(chance.between(-40.0, -2.0)),
                (false, _) => chance.between(0.0, 100.0),
            };
            let expected = reference(function, x);
            let fused = program.run(&[x], &[])[0];
            let apart = evaluate(&program, &[x], &[])[0];
            for found in [fused, apart] {
                let error = off(found, expected);
                assert!(error <= 2.0, "{function:?}({x:e}) = {found:e} is off by {error} units");
                most = most.max(error);
            }
        }
        (function, most)
    };
    FUNCTIONS.into_iter().map(one).collect()
}

#[test]
fn functions_are_off_by_two_units_at_most() {
    worst(20_000);
}

/// Two minutes.
#[test]
#[ignore = "ten million arguments of each function take minutes"]
fn functions_are_off_by_two_units_at_most_on_ten_million_arguments() {
    for (function, most) in worst(10_000_000) {
        println!("{function:?}: {most:.2} units in the last place");
    }
}

#[test]
fn ends_of_domains() {
    let inf = f64::INFINITY;
    for (function, x, expected) in [
        (Function::Exp, inf, inf),
        (Function::Exp, -inf, 0.0),
        (Function::Exp, 710.0, inf),
        (Function::Exp, -745.0, 5e-324),
        (Function::Exp, 0.0, 1.0),
        (Function::Exp, f64::NAN, f64::NAN),
        (Function::Ln, inf, inf),
        (Function::Ln, 1.0, 0.0),
        (Function::Ln, f64::MAX, f64::MAX.ln()),
        (Function::Ln, 5e-324, 5e-324_f64.ln()),
        (Function::Ln, 0.0, f64::NAN),
        (Function::Ln, -1.0, f64::NAN),
        (Function::Sin, 0.0, 0.0),
        (Function::Cos, 0.0, 1.0),
        (Function::Sin, 1.01e8, f64::NAN),
        (Function::Cos, inf, f64::NAN),
        (Function::Tan, f64::NAN, f64::NAN),
        (Function::Atan, inf, std::f64::consts::FRAC_PI_2),
        (Function::Atan, -inf, -std::f64::consts::FRAC_PI_2),
        (Function::Tanh, inf, 1.0),
        (Function::Tanh, -30.0, -1.0),
        (Function::Tanh, f64::NAN, f64::NAN),
        (Function::Power(1, 3), 8.0, 2.0),
        (Function::Power(1, 3), 0.0, 0.0),
        (Function::Power(2, 3), inf, inf),
        (Function::Power(-2, 3), 0.0, inf),
        (Function::Power(-2, 3), inf, 0.0),
        (Function::Power(1, 3), -8.0, f64::NAN),
        (Function::Power(3, 2), -1.0, f64::NAN),
        (Function::Power(1, 3), f64::NAN, f64::NAN),
        (Function::Power(2, 1), -3.0, 9.0),
        (Function::Power(-4, 2), 2.0, 0.25),
        (Function::Power(0, 5), 3.0, 1.0),
    ] {
        let found = program(function).run(&[x], &[])[0];
        let same = found == expected || (found.is_nan() && expected.is_nan());
        assert!(same, "{function:?}({x}) = {found}, not {expected}");
    }
}
