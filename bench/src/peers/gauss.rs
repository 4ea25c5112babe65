//! Gauss–Legendre collocation with S stages (order 2S), solved by fixed-point iteration.
//!
//! Hairer, Lubich, Wanner, *Geometric Numerical Integration*, sections II.1 and VIII.6. The stages of a step start from
//! the collocation polynomial of the step before it, continued; the iteration ends at rounding or when it stops falling.

use super::general::{Control, Solver};
use crate::{arithmetic::fma, method::RunError, problem::VectorField};

/// The coefficients of the method with S stages.
#[derive(Clone, Copy, Debug)]
pub struct Gauss<const S: usize> {
    a: [[f64; S]; S],
    b: [f64; S],
    /// Values at the stages of the next step of the polynomial through values at these stages.
    continuation: [[f64; S]; S],
}

impl<const S: usize> Default for Gauss<S> {
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
        Self {
            a: std::array::from_fn(|i| std::array::from_fn(|j| integral(j, c[i]))),
            b: weights,
            continuation: std::array::from_fn(|i| {
                std::array::from_fn(|j| lagrange(&c, j, 1.0 + c[i]))
            }),
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

impl<const S: usize> Solver for Gauss<S> {
    const CONTROL: Control = Control::Step;

    #[inline]
    fn solve<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        initial: [f64; N],
        end: f64,
        step: f64,
    ) -> Result<[f64; N], RunError> {
        let (count, h) = crate::method::Setting::steps(step, end);
        let mut y = initial;
        let start = field.evaluate(&y);
        let mut slopes = [start; S];
        for number in 0..count {
            if number > 0 {
                slopes = combine_stages(&self.continuation, &slopes);
            }
            let mut before = f64::INFINITY;
            let mut solved = false;
            for _ in 0..MAX_ITERATIONS {
                let sums = combine_stages(&self.a, &slopes);
                let mut change = 0.0f64;
                let new: [[f64; N]; S] = std::array::from_fn(|i| {
                    let stage: [f64; N] = std::array::from_fn(|k| fma(h, sums[i][k], y[k]));
                    field.evaluate(&stage)
                });
                for i in 0..S {
                    for k in 0..N {
                        change = change.max((new[i][k] - slopes[i][k]).abs());
                    }
                }
                slopes = new;
                // A change of the slopes counts h·|A| times in the stages: below 1e−16 of y it cannot be seen.
                if h * change < 1e-16 || (change >= before && h * change < 1e-13) {
                    solved = true;
                    break;
                }
                if !change.is_finite() {
                    break;
                }
                before = change;
            }
            if !solved {
                return Err(RunError::NotConverged);
            }
            for k in 0..N {
                let increment: f64 = (0..S).map(|i| self.b[i] * slopes[i][k]).sum();
                y[k] = fma(h, increment, y[k]);
            }
        }
        Ok(y)
    }
}

/// Σ_j m_ij k_j.
#[inline(always)]
fn combine_stages<const S: usize, const N: usize>(
    m: &[[f64; S]; S],
    slopes: &[[f64; N]; S],
) -> [[f64; N]; S] {
    std::array::from_fn(|i| {
        let mut sum = [0.0; N];
        for j in 0..S {
            for k in 0..N {
                sum[k] = fma(m[i][j], slopes[j][k], sum[k]);
            }
        }
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_stages_are_the_textbook_ones() {
        let method = Gauss::<2>::default();
        let r = 3f64.sqrt() / 6.0;
        let a = [[0.25, 0.25 - r], [0.25 + r, 0.25]];
        for i in 0..2 {
            assert!((method.b[i] - 0.5).abs() < 1e-15);
            for j in 0..2 {
                assert!((method.a[i][j] - a[i][j]).abs() < 1e-15);
            }
        }
    }
}
