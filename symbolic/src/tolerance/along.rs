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

use super::field::{Brackets, Gradient, largest, spectral_radius};

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

/// How fast e changes a state: the larger of its own coordinates and those of ad\*_e μ relative
/// to μ.
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

/// The error (ν, η) that one term makes.
#[derive(Clone)]
struct Error {
    nu: Vec<f64>,
    eta: Vec<f64>,
}

impl Flow<'_> {
    /// Follows the run from `start` for `duration`.
    pub(super) fn follow(&self, start: &[f64], duration: f64) -> Along {
        let count = self.terms.len();
        let zero = Error { nu: vec![0.0; start.len()], eta: vec![0.0; start.len()] };
        let size = largest(start).max(f64::MIN_POSITIVE);
        let mut mu = start.to_vec();
        let mut errors = vec![zero; count];
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
            let stages = self.stages(&mu, h);
            let next = combine(&mu, h, &stages.map(|(_, slope)| slope));
            let after: Vec<Vec<f64>> = self.terms.iter().map(|term| term.at(&next)).collect();
            let points = self.stages(&mu, h).map(|(point, _)| point);
            for ((error, before), after) in errors.iter_mut().zip(&forcing).zip(&after) {
                self.advance(error, &points, h, before, after);
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
                let now = (largest(&error.nu) / size).max(largest(&error.eta));
                let finite = error.nu.iter().chain(&error.eta).all(|value| value.is_finite());
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

    /// The four points of the classical Runge–Kutta method, and μ̇ there.
    fn stages(&self, mu: &[f64], h: f64) -> [(Vec<f64>, Vec<f64>); 4] {
        let at = |slope: &[f64], by: f64| {
            let point: Vec<f64> = mu.iter().zip(slope).map(|(m, s)| m + by * s).collect();
            let slope = self.slope(&point);
            (point, slope)
        };
        let first = (mu.to_vec(), self.slope(mu));
        let second = at(&first.1, 0.5 * h);
        let third = at(&second.1, 0.5 * h);
        let fourth = at(&third.1, h);
        [first, second, third, fourth]
    }

    /// One step of the error's equations.
    fn advance(
        &self,
        error: &mut Error,
        points: &[Vec<f64>; 4],
        h: f64,
        before: &[f64],
        after: &[f64],
    ) {
        let middle: Vec<f64> = before.iter().zip(after).map(|(a, b)| 0.5 * (a + b)).collect();
        let mut slopes: Vec<Error> = Vec::with_capacity(4);
        for (stage, point) in points.iter().enumerate() {
            let by = [0.0, 0.5 * h, 0.5 * h, h][stage];
            let here = match slopes.last() {
                None => error.clone(),
                Some(slope) => Error {
                    nu: error.nu.iter().zip(&slope.nu).map(|(v, s)| v + by * s).collect(),
                    eta: error.eta.iter().zip(&slope.eta).map(|(v, s)| v + by * s).collect(),
                },
            };
            let e = [before, &middle, &middle, after][stage];
            slopes.push(self.error_slope(&here, point, e));
        }
        let of = |part: fn(&Error) -> &Vec<f64>| -> [Vec<f64>; 4] {
            std::array::from_fn(|stage| part(&slopes[stage]).clone())
        };
        error.nu = combine(&error.nu, h, &of(|slope| &slope.nu));
        error.eta = combine(&error.eta, h, &of(|slope| &slope.eta));
    }

    fn error_slope(&self, error: &Error, mu: &[f64], e: &[f64]) -> Error {
        let xi = self.energy.at(mu);
        // H″ν + e, by a difference in the direction of ν: exact for quadratic H up to rounding.
        let size = largest(&error.nu);
        let mut change = e.to_vec();
        if size > 0.0 {
            let by = 1e-5 * largest(mu).max(1e-3) / size;
            let moved = |by: f64| {
                let moved: Vec<f64> = mu.iter().zip(&error.nu).map(|(m, v)| m + by * v).collect();
                self.energy.at(&moved)
            };
            let (up, down) = (moved(by), moved(-by));
            for (i, value) in change.iter_mut().enumerate() {
                *value += (up[i] - down[i]) / (2.0 * by);
            }
        }
        let turned = self.brackets.bracket(&xi, &error.eta);
        let eta = change.iter().zip(&turned).map(|(c, t)| c - t).collect();
        let pushed = self.brackets.ad_star(&change, mu);
        let carried = self.brackets.ad_star(&xi, &error.nu);
        let nu = pushed.iter().zip(&carried).map(|(a, b)| a + b).collect();
        Error { nu, eta }
    }
}

/// The classical weights 1/6, 1/3, 1/3, 1/6.
fn combine(from: &[f64], h: f64, slopes: &[Vec<f64>; 4]) -> Vec<f64> {
    let [a, b, c, d] = slopes;
    (0..from.len()).map(|i| from[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i])).collect()
}
