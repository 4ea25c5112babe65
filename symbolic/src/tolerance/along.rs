//! The effect on a run from a given state of leaving out the terms S_j: to first order,
//! by the variational equations.
//!
//! A step whose generating function lacks t^j S_j is, to leading order, the exact flow followed by
//! that of −h^j S_j. So its solution is that of ξ̃ = ξ − h^{j−1} ∂S_j, ξ = ∂H, and with
//! g̃ = g·exp(η), μ̃ = μ + ν,
//!
//! η̇ = H″ν − [ξ, η] + e,   ν̇ = ad\*_{H″ν + e} μ + ad\*_ξ ν,   e = −h^{j−1} ∂S_j(μ).
//!
//! This is how the error of a geometric integrator accumulates (Hairer, Lubich, Wanner,
//! *Geometric Numerical Integration*, chapter X): linearly in time on regular orbits, with the
//! frequencies' change counted, and as fast as neighbours part on others.

use crate::lie::LieAlgebra;
use crate::poly::{Numeric, Polynomial};

/// The most steps of the equations; a longer run is taken to go on in proportion.
const MOST_STEPS: usize = 20_000;

/// The observations along a run.
#[derive(Clone, Debug)]
pub(super) struct Along {
    /// max ‖∂S_j‖ in the sense of [`rate`], for each j asked for.
    pub(super) rates: Vec<f64>,
    /// The largest error by the end for h = 1, for each j.
    pub(super) errors: Vec<f64>,
    /// The largest Euclidean norm of μ.
    pub(super) radius: f64,
    /// The largest spectral radius of ad_ξ.
    pub(super) turning: f64,
}

/// The rate at which e changes a state: the larger of its own coordinates and those of ad\*_e μ relative to μ.
pub(super) fn rate(brackets: &Brackets, e: &[f64], mu: &[f64]) -> f64 {
    let size = largest(mu);
    let turned = largest(&brackets.ad_star(e, mu));
    largest(e).max(if size > 0.0 { turned / size } else { 0.0 })
}

/// The system the equations are of.
pub(super) struct Flow<'a> {
    pub(super) brackets: &'a Brackets,
    /// ∂H.
    pub(super) energy: &'a Gradient,
    /// ∂S_j.
    pub(super) terms: &'a [Gradient],
}

impl Flow<'_> {
    /// Follows the run from `start` for `duration`.
    pub(super) fn follow(&self, start: &[f64], duration: f64) -> Along {
        let (n, count) = (start.len(), self.terms.len());
        let size = largest(start).max(f64::MIN_POSITIVE);
        // ν, then η.
        let mut errors = vec![vec![0.0; 2 * n]; count];
        let mut mu = start.to_vec();
        let mut along =
            Along { rates: vec![0.0; count], errors: vec![0.0; count], radius: 0.0, turning: 0.0 };
        let mut forcing: Vec<Vec<f64>> = self.terms.iter().map(|term| term.at(&mu)).collect();
        self.look(&mut along, &mu, &forcing);
        let (mut time, mut steps) = (0.0, 0);
        let mut step = self.step(&mu);
        while time < duration && steps < MOST_STEPS {
            // The rates change slowly compared with the step.
            if steps % 16 == 0 {
                step = self.step(&mu);
            }
            let h = f64::min(step, duration - time);
            let mut points = Vec::with_capacity(4);
            let next = runge_kutta(&mu, h, |_, mu| {
                points.push(mu.to_vec());
                self.slope(mu)
            });
            let after: Vec<Vec<f64>> = self.terms.iter().map(|term| term.at(&next)).collect();
            for ((error, before), after) in errors.iter_mut().zip(&forcing).zip(&after) {
                let middle: Vec<f64> =
                    before.iter().zip(after).map(|(a, b)| 0.5 * (a + b)).collect();
                let e = [before, &middle, &middle, after];
                *error = runge_kutta(error, h, |stage, error| {
                    self.error_slope(error, &points[stage], e[stage])
                });
            }
            if next.iter().chain(after.iter().flatten()).any(|value| !value.is_finite()) {
                // The motion leaves every bound: no step is small enough.
                along.errors.fill(f64::INFINITY);
                return along;
            }
            mu = next;
            forcing = after;
            time += h;
            steps += 1;
            self.look(&mut along, &mu, &forcing);
            for (largest_so_far, error) in along.errors.iter_mut().zip(&errors) {
                let now = (largest(&error[..n]) / size).max(largest(&error[n..]));
                let finite = error.iter().all(|value| value.is_finite());
                *largest_so_far = largest_so_far.max(if finite { now } else { f64::INFINITY });
            }
        }
        // Beyond what was followed: in proportion to time.
        for error in &mut along.errors {
            *error *= (duration / time).max(1.0);
        }
        along
    }

    fn look(&self, along: &mut Along, mu: &[f64], forcing: &[Vec<f64>]) {
        for (largest_so_far, e) in along.rates.iter_mut().zip(forcing) {
            *largest_so_far = largest_so_far.max(rate(self.brackets, e, mu));
        }
        let norm = mu.iter().map(|x| x * x).sum::<f64>().sqrt();
        along.radius = along.radius.max(norm);
        let turning = self.brackets.turning_rate(&self.energy.at(mu));
        along.turning = along.turning.max(turning);
    }

    /// A step in which nothing turns by more than a seventh.
    fn step(&self, mu: &[f64]) -> f64 {
        let n = mu.len();
        let mut jacobian = vec![0.0; n * n];
        let scale = 1e-6 * largest(mu).max(1e-3);
        for j in 0..n {
            let moved = |by: f64| {
                let mut moved = mu.to_vec();
                moved[j] += by;
                self.slope(&moved)
            };
            let (up, down) = (moved(scale), moved(-scale));
            for i in 0..n {
                jacobian[i * n + j] = (up[i] - down[i]) / (2.0 * scale);
            }
        }
        let turning = self.brackets.turning_rate(&self.energy.at(mu));
        0.15 / spectral_radius(n, jacobian).max(turning).max(1e-9)
    }

    /// μ̇.
    fn slope(&self, mu: &[f64]) -> Vec<f64> {
        self.brackets.ad_star(&self.energy.at(mu), mu)
    }

    /// (ν̇, η̇) of an error (ν, η).
    fn error_slope(&self, error: &[f64], mu: &[f64], e: &[f64]) -> Vec<f64> {
        let (nu, eta) = error.split_at(mu.len());
        let xi = self.energy.at(mu);
        // H″ν + e, by a difference in the direction of ν: exact for quadratic H up to rounding.
        let size = largest(nu);
        let mut change = e.to_vec();
        if size > 0.0 {
            let by = 1e-5 * largest(mu).max(1e-3) / size;
            let moved = |by: f64| {
                let moved: Vec<f64> = mu.iter().zip(nu).map(|(m, v)| m + by * v).collect();
                self.energy.at(&moved)
            };
            let (up, down) = (moved(by), moved(-by));
            for (i, value) in change.iter_mut().enumerate() {
                *value += (up[i] - down[i]) / (2.0 * by);
            }
        }
        let turned = self.brackets.bracket(&xi, eta);
        let pushed = self.brackets.ad_star(&change, mu);
        let carried = self.brackets.ad_star(&xi, nu);
        let nu = pushed.iter().zip(&carried).map(|(a, b)| a + b);
        nu.chain(change.iter().zip(&turned).map(|(c, t)| c - t)).collect()
    }
}

/// A step of the classical method of Runge and Kutta; `slope` is given the number of the stage and its point.
fn runge_kutta(from: &[f64], h: f64, mut slope: impl FnMut(usize, &[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut slopes = [(); 4].map(|()| vec![0.0; from.len()]);
    for (stage, by) in [0.0, 0.5 * h, 0.5 * h, h].into_iter().enumerate() {
        let last = &slopes[stage.saturating_sub(1)];
        let point: Vec<f64> = from.iter().zip(last).map(|(x, s)| x + by * s).collect();
        slopes[stage] = slope(stage, &point);
    }
    let [a, b, c, d] = &slopes;
    (0..from.len()).map(|i| from[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i])).collect()
}

/// ∂F/∂μ of a polynomial F, with values put in for the symbols.
#[derive(Clone, Debug)]
pub(super) struct Gradient(Vec<Numeric>);

impl Gradient {
    pub(super) fn new(polynomial: &Polynomial, dim: usize, symbols: &[f64]) -> Self {
        Self(Numeric::new(polynomial, dim, symbols).gradient(dim))
    }

    /// The gradient at μ.
    pub(super) fn at(&self, mu: &[f64]) -> Vec<f64> {
        self.0.iter().map(|derivative| derivative.value(mu)).collect()
    }
}

/// The brackets of a Lie algebra.
#[derive(Clone, Debug)]
pub(super) struct Brackets {
    dim: usize,
    /// [eᵢ, eⱼ] contains c·eₖ.
    structure: Vec<(usize, usize, usize, f64)>,
}

impl Brackets {
    pub(super) fn new(algebra: &LieAlgebra) -> Self {
        Self { dim: algebra.dim(), structure: algebra.constants() }
    }

    /// [x, y].
    pub(super) fn bracket(&self, x: &[f64], y: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.dim];
        for &(i, j, k, c) in &self.structure {
            result[k] += c * x[i] * y[j];
        }
        result
    }

    /// ad\*_x μ.
    pub(super) fn ad_star(&self, x: &[f64], mu: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.dim];
        for &(i, j, k, c) in &self.structure {
            result[j] += c * x[i] * mu[k];
        }
        result
    }

    /// The spectral radius of ad_x, by ‖A^(2^m)‖^(2^−m): the rate at which x turns the algebra.
    pub(super) fn turning_rate(&self, x: &[f64]) -> f64 {
        let mut matrix = vec![0.0; self.dim * self.dim];
        for &(i, j, k, c) in &self.structure {
            matrix[k * self.dim + j] += c * x[i];
        }
        spectral_radius(self.dim, matrix)
    }
}

/// About the largest modulus of an eigenvalue of a square matrix.
pub(super) fn spectral_radius(n: usize, mut matrix: Vec<f64>) -> f64 {
    const SQUARINGS: i32 = 6;
    // The logarithm of the scale taken out so far.
    let mut logarithm = 0.0;
    let mut power = 1.0;
    for _ in 0..SQUARINGS {
        let size = matrix.iter().map(|a| a * a).sum::<f64>().sqrt();
        if size == 0.0 || !size.is_finite() {
            return if size == 0.0 { 0.0 } else { f64::INFINITY };
        }
        logarithm += size.ln() / power;
        power *= 2.0;
        let scaled: Vec<f64> = matrix.iter().map(|a| a / size).collect();
        for i in 0..n {
            for j in 0..n {
                matrix[i * n + j] = (0..n).map(|k| scaled[i * n + k] * scaled[k * n + j]).sum();
            }
        }
    }
    let size = matrix.iter().map(|a| a * a).sum::<f64>().sqrt();
    // Rounding leaves about 1e-16 of a nilpotent matrix.
    if size < 1e-14 { 0.0 } else { (logarithm + size.ln() / power).exp() }
}

/// The largest absolute entry.
pub(super) fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |a, b| f64::max(a, b.abs()))
}
