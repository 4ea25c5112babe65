//! Adaptive steps of an embedded explicit Runge–Kutta pair: the loop and the PI control of the step.

use super::general::{Control, Solver};
use crate::{arithmetic::fma, method::RunError, problem::VectorField};

/// One explicit pair whose last stage is the first of the next step.
pub trait Pair {
    /// The exponent 1/(order of the error estimate + 1) of the step control.
    const EXPONENT: f64;

    /// The new point, the field there, and the norm of the error estimate in units of the tolerance.
    fn attempt<const N: usize, F: VectorField<N>>(
        field: &F,
        y: &[f64; N],
        slope: &[f64; N],
        h: f64,
        tolerance: f64,
    ) -> ([f64; N], [f64; N], f64);
}

/// The adaptive method made of a pair.
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<P>(pub P);

/// The stabilising exponent of the PI controller (Hairer, Wanner, *Solving ODEs II*, IV.2, eq. 2.43).
const BETA: f64 = 0.04;
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;

impl<P: Pair> Solver for Adaptive<P> {
    const CONTROL: Control = Control::Tolerance;

    #[inline]
    fn solve<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        initial: [f64; N],
        end: f64,
        tolerance: f64,
    ) -> Result<[f64; N], RunError> {
        let exponent = P::EXPONENT - 0.75 * BETA;
        let (mut t, mut y) = (0.0, initial);
        let mut slope = field.evaluate(&y);
        let mut h = first_step(&y, &slope, tolerance, P::EXPONENT).min(end);
        let mut previous = 1e-4f64;
        let mut rejected = false;
        while t < end {
            let last = t + 1.000_001 * h >= end;
            if last {
                h = end - t;
            }
            if h <= 1e-14 * end && !last || !h.is_finite() {
                return Err(RunError::NotConverged);
            }
            let (next, next_slope, error) = P::attempt(field, &y, &slope, h, tolerance);
            // `max` with a positive number also turns a NaN into a rejected step.
            if error <= 1.0 {
                let error = error.max(1e-12);
                let grow =
                    (SAFETY * error.powf(-exponent) * previous.powf(BETA)).clamp(SHRINK, GROW);
                t += h;
                (y, slope, previous) = (next, next_slope, error.max(1e-4));
                h *= if rejected { grow.min(1.0) } else { grow };
                rejected = false;
                if last {
                    break;
                }
            } else {
                h *= if error.is_finite() {
                    (SAFETY * error.powf(-exponent)).clamp(SHRINK, 1.0)
                } else {
                    SHRINK
                };
                rejected = true;
            }
        }
        Ok(y)
    }
}

/// A first guess: the step over which y changes by about the root of the tolerance that a pair of that order allows.
fn first_step<const N: usize>(
    y: &[f64; N],
    slope: &[f64; N],
    tolerance: f64,
    exponent: f64,
) -> f64 {
    let size = y.iter().fold(0.0, |m: f64, v| m.max(v.abs())).max(1e-3);
    let speed = slope.iter().fold(0.0, |m: f64, v| m.max(v.abs())).max(1e-9);
    0.5 * size / speed * tolerance.powf(exponent)
}

/// y + h Σ aₖ kₖ.
#[inline(always)]
pub fn combine<const N: usize, const M: usize>(
    y: &[f64; N],
    h: f64,
    weights: &[f64; M],
    stages: [&[f64; N]; M],
) -> [f64; N] {
    let sum = weigh(weights, stages);
    std::array::from_fn(|i| fma(h, sum[i], y[i]))
}

/// Σ aₖ kₖ.
#[inline(always)]
pub fn weigh<const N: usize, const M: usize>(
    weights: &[f64; M],
    stages: [&[f64; N]; M],
) -> [f64; N] {
    let mut sum: [f64; N] = std::array::from_fn(|i| weights[0] * stages[0][i]);
    for (weight, stage) in weights.iter().zip(stages).skip(1) {
        for i in 0..N {
            sum[i] = fma(*weight, stage[i], sum[i]);
        }
    }
    sum
}

/// The mean square of h·e in units of tolerance·(1 + max(|y|, |y_new|)).
#[inline(always)]
pub fn mean_square<const N: usize>(
    e: &[f64; N],
    h: f64,
    y: &[f64; N],
    new: &[f64; N],
    tolerance: f64,
) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        let unit = tolerance * (1.0 + y[i].abs().max(new[i].abs()));
        let part = h * e[i] / unit;
        sum += part * part;
    }
    sum / N as f64
}
