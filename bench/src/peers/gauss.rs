//! Gauss–Legendre collocation with S stages (order 2S), solved by fixed-point iteration.
//!
//! The stages lie side by side in L ≥ S lanes (lanes beyond S idle along with weight 0).
//!
//! Hairer, Lubich, Wanner, *Geometric Numerical Integration*, sections II.1 and VIII.6. The stages of a step start from
//! the collocation polynomial of the step before it, continued; the iteration ends at rounding or when it stops falling.

use super::general::{Control, Solver};
use crate::{
    arithmetic::fma,
    method::{RunError, Setting},
    number::{Lanes, Number},
    problem::VectorField,
};

/// The coefficients of the method with S stages, by columns.
#[derive(Clone, Copy, Debug)]
pub struct Gauss<const S: usize, const L: usize> {
    a: [Lanes<L>; S],
    b: [f64; S],
    /// Values at the stages of the next step of the polynomial through values at these stages.
    continuation: [Lanes<L>; S],
}

impl<const S: usize, const L: usize> Default for Gauss<S, L> {
    fn default() -> Self {
        let c = nodes::<S>();
        // Integrals of the Lagrange polynomials up to each node and up to 1, exact by a Gauss rule on [0, x] of the
        // same S nodes (degree S − 1 < 2S); its weights on [0, 1] come from the derivative of Legendre's polynomial.
        let weights: [f64; S] = std::array::from_fn(|i| {
            let x = 2.0 * c[i] - 1.0;
            let (_, slope) = legendre::<S>(x);
            1.0 / ((1.0 - x * x) * slope * slope)
        });
        let integral = |j: usize, x: f64| {
            (0..S).map(|k| x * weights[k] * lagrange(&c, j, x * c[k])).sum::<f64>()
        };
        let stages = |value: &dyn Fn(usize) -> f64| {
            Lanes(std::array::from_fn(|lane| if lane < S { value(lane) } else { 0.0 }))
        };
        Self {
            a: std::array::from_fn(|j| stages(&|i| integral(j, c[i]))),
            b: weights,
            continuation: std::array::from_fn(|j| stages(&|i| lagrange(&c, j, 1.0 + c[i]))),
        }
    }
}

/// Legendre's polynomial of degree S and its derivative.
fn legendre<const S: usize>(x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for n in 1..S {
        let n = n as f64;
        (before, value) = (value, ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0));
    }
    (value, S as f64 * (x * value - before) / (x * x - 1.0))
}

/// The zeros of Legendre's polynomial of degree S, mapped to [0, 1].
fn nodes<const S: usize>() -> [f64; S] {
    std::array::from_fn(|i| {
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (S as f64 + 0.5)).cos();
        for _ in 0..20 {
            let (value, slope) = legendre::<S>(x);
            x -= value / slope;
        }
        0.5 * (1.0 + x)
    })
}

fn lagrange<const S: usize>(c: &[f64; S], j: usize, x: f64) -> f64 {
    (0..S).filter(|&k| k != j).map(|k| (x - c[k]) / (c[j] - c[k])).product()
}

const MAX_ITERATIONS: usize = 200;

impl<const S: usize, const L: usize> Solver for Gauss<S, L> {
    const CONTROL: Control = Control::Step;

    #[inline]
    fn solve<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        initial: [f64; N],
        end: f64,
        step: f64,
    ) -> Result<[f64; N], RunError> {
        let (count, h) = Setting::steps(step, end);
        let mut y = initial;
        let mut slopes = field.evaluate(&initial.map(Lanes::<L>::splat));
        for number in 0..count {
            if number > 0 {
                slopes = slopes.map(|slope| apply(&self.continuation, &slope));
            }
            slopes = if S == 2 {
                self.iterate(field, &y, h, slopes)?
            } else {
                self.iterate_apart(field, &y, h, slopes)?
            };
            for (value, slope) in y.iter_mut().zip(&slopes) {
                let increment: f64 = (0..S).map(|i| self.b[i] * slope.0[i]).sum();
                *value = fma(h, increment, *value);
            }
        }
        Ok(y)
    }
}

impl<const S: usize, const L: usize> Gauss<S, L> {
    /// The iteration in a function of its own: with more stages the compiler vectorises it only there.
    #[inline(never)]
    fn iterate_apart<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        y: &[f64; N],
        h: f64,
        slopes: [Lanes<L>; N],
    ) -> Result<[Lanes<L>; N], RunError> {
        self.iterate(field, y, h, slopes)
    }

    #[inline(always)]
    fn iterate<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        y: &[f64; N],
        h: f64,
        mut slopes: [Lanes<L>; N],
    ) -> Result<[Lanes<L>; N], RunError> {
        let mut before = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let stage = |k: usize| apply(&self.a, &slopes[k]).scaled(h, Lanes::splat(y[k]));
            // The same either way; each is the one that the compiler turns into vector instructions.
            let stages = if S == 2 {
                std::array::from_fn(stage)
            } else {
                let mut stages = slopes;
                for (k, entry) in stages.iter_mut().enumerate() {
                    *entry = stage(k);
                }
                stages
            };
            let new = field.evaluate(&stages);
            let mut changes = [0.0f64; L];
            for k in 0..N {
                let difference = new[k] - slopes[k];
                for lane in 0..L {
                    let size = difference.0[lane].abs();
                    changes[lane] = if size > changes[lane] { size } else { changes[lane] };
                }
            }
            slopes = new;
            let change = changes[..S].iter().fold(0.0f64, |max, v| max.max(*v));
            // A change of the slopes counts h·|A| times in the stages: below 1e−16 of y it cannot be seen.
            if h * change < 1e-16 || (change >= before && h * change < 1e-13) {
                // A maximum skips what is not a number; the sum does not.
                let sum: f64 = slopes.iter().map(|slope| slope.0.iter().sum::<f64>()).sum();
                return if sum.is_finite() { Ok(slopes) } else { Err(RunError::NotConverged) };
            }
            if change > 1e100 {
                break;
            }
            before = change;
        }
        Err(RunError::NotConverged)
    }
}

/// A matrix, by columns, times the stages of one component.
#[inline(always)]
fn apply<const S: usize, const L: usize>(columns: &[Lanes<L>; S], stages: &Lanes<L>) -> Lanes<L> {
    let mut sum = columns[0] * stages.0[0];
    for (column, value) in columns.iter().zip(stages.0).skip(1) {
        sum = column.scaled(value, sum);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_stages_are_the_textbook_ones() {
        let method = Gauss::<2, 2>::default();
        let r = 3f64.sqrt() / 6.0;
        let a = [[0.25, 0.25 - r], [0.25 + r, 0.25]];
        for i in 0..2 {
            assert!((method.b[i] - 0.5).abs() < 1e-15);
            for j in 0..2 {
                assert!((method.a[j].0[i] - a[i][j]).abs() < 1e-15);
            }
        }
    }
}
