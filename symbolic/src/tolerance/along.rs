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
use crate::poly::{Numeric, Polynomial, Products};

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
    /// The gradient of each coordinate of ∂H.
    pub(super) curvature: &'a [Gradient],
    /// ∂S_j.
    pub(super) terms: &'a [Gradient],
}

impl Flow<'_> {
    /// Follows the run from `start` for `duration`.
    pub(super) fn follow(&self, start: &[f64], duration: f64) -> Along {
        let (n, count) = (start.len(), self.terms.len());
        let size = largest(start).max(f64::MIN_POSITIVE);
        // Of each term ν, then η.
        let mut errors = vec![0.0; 2 * n * count];
        let mut mu = start.to_vec();
        let mut along =
            Along { rates: vec![0.0; count], errors: vec![0.0; count], radius: 0.0, turning: 0.0 };
        let forcing = |mu: &[f64]| self.terms.iter().flat_map(|term| term.at(mu)).collect();
        let mut before: Vec<f64> = forcing(&mu);
        let (mut time, mut steps, mut step) = (0.0, 0, 0.0);
        while time < duration && steps < MOST_STEPS {
            let mut points = Vec::with_capacity(4);
            let here = self.point(&mu);
            self.look(&mut along, &mu, (&here, &before));
            // The rates change slowly compared with the step.
            if steps % 16 == 0 {
                step = here.step();
            }
            let h = f64::min(step, duration - time);
            points.push(here);
            let next = runge_kutta(&mu, h, |stage, mu, slope| {
                if stage > 0 {
                    points.push(self.point(mu));
                }
                slope.copy_from_slice(&self.brackets.ad_star(&points[stage].velocity, mu));
            });
            let after: Vec<f64> = forcing(&next);
            let middle: Vec<f64> = before.iter().zip(&after).map(|(a, b)| 0.5 * (a + b)).collect();
            let e = [&before, &middle, &middle, &after];
            errors = runge_kutta(&errors, h, |stage, errors, slopes| {
                let terms = errors.chunks(2 * n).zip(slopes.chunks_mut(2 * n));
                for ((error, slope), e) in terms.zip(e[stage].chunks(n)) {
                    points[stage].error_slope(error, e, slope);
                }
            });
            if next.iter().chain(&after).any(|value| !value.is_finite()) {
                // The motion leaves every bound: no step is small enough.
                along.errors.fill(f64::INFINITY);
                return along;
            }
            (mu, before) = (next, after);
            time += h;
            steps += 1;
            for (largest_so_far, error) in along.errors.iter_mut().zip(errors.chunks(2 * n)) {
                let now = (largest(&error[..n]) / size).max(largest(&error[n..]));
                let finite = error.iter().all(|value| value.is_finite());
                *largest_so_far = largest_so_far.max(if finite { now } else { f64::INFINITY });
            }
        }
        self.look(&mut along, &mu, (&self.point(&mu), &before));
        // Beyond what was followed: in proportion to time.
        for error in &mut along.errors {
            *error *= (duration / time).max(1.0);
        }
        along
    }

    fn look(&self, along: &mut Along, mu: &[f64], (here, forcing): (&Point, &[f64])) {
        for (largest_so_far, e) in along.rates.iter_mut().zip(forcing.chunks(mu.len())) {
            *largest_so_far = largest_so_far.max(rate(self.brackets, e, mu));
        }
        let norm = mu.iter().map(|x| x * x).sum::<f64>().sqrt();
        along.radius = along.radius.max(norm);
        along.turning = along.turning.max(here.turning());
    }

    fn point(&self, mu: &[f64]) -> Point {
        let velocity = self.energy.at(mu);
        let curvature = self.curvature.iter().flat_map(|row| row.at(mu)).collect();
        let (pushed, carried) = (self.brackets.pushed(mu), self.brackets.carried(&velocity));
        Point { velocity, curvature, pushed, carried }
    }
}

/// A momentum μ of the run, with square matrices row by row.
struct Point {
    /// ξ = ∂H
    velocity: Vec<f64>,
    /// H″
    curvature: Vec<f64>,
    /// v ↦ ad\*_v μ
    pushed: Vec<f64>,
    /// ν ↦ ad\*_ξ ν, the transpose of η ↦ [ξ, η].
    carried: Vec<f64>,
}

impl Point {
    /// A step in which nothing turns by more than a seventh.
    fn step(&self) -> f64 {
        let n = self.velocity.len();
        let mut jacobian = self.carried.clone();
        for (row, pushed) in jacobian.chunks_mut(n).zip(self.pushed.chunks(n)) {
            for (entry, column) in row.iter_mut().zip(self.curvature.chunks(n)) {
                *entry += dot(pushed, column);
            }
        }
        0.15 / spectral_radius(n, jacobian).max(self.turning()).max(1e-9)
    }

    /// The rate at which the motion turns the algebra.
    fn turning(&self) -> f64 {
        spectral_radius(self.velocity.len(), self.carried.clone())
    }

    /// (ν̇, η̇) of an error (ν, η).
    fn error_slope(&self, error: &[f64], e: &[f64], slope: &mut [f64]) {
        let n = self.velocity.len();
        let (nu, eta) = error.split_at(n);
        let (nu_slope, eta_slope) = slope.split_at_mut(n);
        for ((change, row), e) in eta_slope.iter_mut().zip(self.curvature.chunks(n)).zip(e) {
            *change = dot(row, nu) + e;
        }
        let rows = self.pushed.chunks(n).zip(self.carried.chunks(n));
        for (slope, (pushed, carried)) in nu_slope.iter_mut().zip(rows) {
            *slope = dot(pushed, eta_slope) + dot(carried, nu);
        }
        for (carried, eta) in self.carried.chunks(n).zip(eta) {
            eta_slope.iter_mut().zip(carried).for_each(|(slope, entry)| *slope -= entry * eta);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A step of the classical method of Runge and Kutta; `slope` is given the number of the stage, its point, and a place for the slope.
fn runge_kutta(from: &[f64], h: f64, mut slope: impl FnMut(usize, &[f64], &mut [f64])) -> Vec<f64> {
    let mut slopes = [(); 4].map(|()| vec![0.0; from.len()]);
    let mut point = from.to_vec();
    for (stage, by) in [0.0, 0.5 * h, 0.5 * h, h].into_iter().enumerate() {
        let last = &slopes[stage.saturating_sub(1)];
        point.iter_mut().zip(from).zip(last).for_each(|((at, x), s)| *at = x + by * s);
        slope(stage, &point, &mut slopes[stage]);
    }
    let [a, b, c, d] = &slopes;
    (0..from.len()).map(|i| from[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i])).collect()
}

/// ∂F/∂μ of a polynomial F, with values put in for the symbols.
#[derive(Clone, Debug)]
pub(super) struct Gradient {
    dim: usize,
    /// (earlier product, variable) of each product but that of 1.
    products: Vec<(u32, u32)>,
    /// The coefficient of each product.
    coefficients: Vec<f64>,
}

impl Gradient {
    pub(super) fn new(polynomial: &Polynomial, dim: usize, symbols: &[f64]) -> Self {
        let (mut products, mut terms) = (Products::default(), Vec::new());
        for (value, factors) in Numeric::new(polynomial, dim, symbols).terms() {
            let mut powers = vec![0; dim];
            factors.iter().for_each(|&(i, power)| powers[i] = power.unsigned_abs());
            terms.push((value, products.add(&powers)));
        }
        let products = products.into_made();
        let mut coefficients = vec![0.0; products.len() + 1];
        terms.into_iter().for_each(|(value, product)| coefficients[product as usize] += value);
        Self { dim, products, coefficients }
    }

    /// The gradient at μ, by the derivatives of F in its products, from the last one back to the first.
    pub(super) fn at(&self, mu: &[f64]) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.coefficients.len());
        values.push(1.0);
        for &(of, variable) in &self.products {
            values.push(values[of as usize] * mu[variable as usize]);
        }
        let (mut slopes, mut gradient) = (self.coefficients.clone(), vec![0.0; self.dim]);
        for (number, &(of, variable)) in self.products.iter().enumerate().rev() {
            let slope = slopes[number + 1];
            gradient[variable as usize] += slope * values[of as usize];
            slopes[of as usize] += slope * mu[variable as usize];
        }
        gradient
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

    /// ad\*_x μ.
    pub(super) fn ad_star(&self, x: &[f64], mu: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; self.dim];
        for &(i, j, k, c) in &self.structure {
            result[j] += c * x[i] * mu[k];
        }
        result
    }

    /// The matrix of v ↦ ad\*_v μ, row by row.
    fn pushed(&self, mu: &[f64]) -> Vec<f64> {
        let mut matrix = vec![0.0; self.dim * self.dim];
        for &(i, j, k, c) in &self.structure {
            matrix[j * self.dim + i] += c * mu[k];
        }
        matrix
    }

    /// The matrix of ν ↦ ad\*_x ν, row by row.
    fn carried(&self, x: &[f64]) -> Vec<f64> {
        let mut matrix = vec![0.0; self.dim * self.dim];
        for &(i, j, k, c) in &self.structure {
            matrix[j * self.dim + k] += c * x[i];
        }
        matrix
    }

    /// The spectral radius of ad_x, by ‖A^(2^m)‖^(2^−m): the rate at which x turns the algebra.
    pub(super) fn turning_rate(&self, x: &[f64]) -> f64 {
        spectral_radius(self.dim, self.carried(x))
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
