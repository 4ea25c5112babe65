//! The right solution of x = ∂S(p̂(x)): the one continued from x = s ∂S(p̂(x)), s from 0 to 1.

use super::geometry::{apply, size};
use super::linear::{Lu, identity, multiply};
use super::norm::norm;
use super::step::{RightSolution, Step, spacing};
use super::{DoubleDouble, JudgeError};

/// Whether a given x is the right solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Branch {
    /// Proven: s ∂S∘p̂ contracts a ball about 0 that holds x, for every s from 0 to 1.
    Proven,
    /// Tested: the continuation in s ends at x.
    Right,
    /// The continuation in s ends elsewhere: at this distance, relative to |x|.
    Another(f64),
    /// The continuation folds back before s = 1, at about this s: there is no right solution.
    Folds(f64),
    /// The continuation went on in steps too small to be trusted, or numbers left their range.
    CannotTell,
}

/// The longest step in s, so that none goes over two folds at once, and the shortest.
const LONGEST: f64 = 1.0 / 64.0;
const SHORTEST: f64 = 1e-6;
/// Corrections of one step in s at most.
const CORRECTIONS: usize = 6;
/// Solutions nearer than this, relative to |x|, are the same; farther than [`APART`], different.
const SAME: f64 = 1e-9;
const APART: f64 = 1e-6;

/// F(x) = x − s ∂S(p̂(x)), ∂S(p̂(x)), and the factors of ∂F/∂x.
struct Model {
    residual: Vec<f64>,
    gradient: Vec<f64>,
    jacobian: Lu<f64>,
}

impl Step<'_> {
    fn model(&self, x: &[f64], s: f64) -> Result<Model, JudgeError> {
        let n = x.len();
        let (p, derivative) = self.geometry.pull_back_derivative(x, &self.double)?;
        let (gradient, hessian) = self.folded.derivatives(&p);
        let product = multiply(n, &hessian, &derivative);
        let mut matrix = identity::<f64>(n);
        for (entry, product) in matrix.iter_mut().zip(product) {
            *entry -= s * product;
        }
        let residual: Vec<f64> = x.iter().zip(&gradient).map(|(x, g)| x - s * g).collect();
        if !size(&residual).is_finite() {
            return Err(JudgeError::OutOfRange);
        }
        let jacobian = Lu::new(n, matrix).ok_or(JudgeError::OutOfRange)?;
        Ok(Model { residual, gradient, jacobian })
    }

    /// Proves by Banach's fixed-point theorem that x is near the right solution. With r the radius of a ball,
    /// |p̂| ≤ |μ| φ(ar) and ‖∂p̂/∂x‖ ≤ |μ| a φ′(ar) on it (exponential chart; φ(z) = (eᶻ − 1)/z), and degree by
    /// degree |∂S| ≤ Σ G_d |p̂|^(d−1), ‖Hess S‖ ≤ Σ H_d |p̂|^(d−2). Where the first is at most r and the product of
    /// the Hessian's bound and that of ∂p̂/∂x less than one, s ∂S∘p̂ has exactly one fixed point in the ball for
    /// every s in \[0, 1\], which moves continuously from 0: it is the right solution, and an x in the ball with a
    /// residual ρ is within ρ/(1 − q) of it. The bounds are evaluated in double precision with a margin for
    /// its rounding.
    pub(super) fn contracts(&self, x: &[f64]) -> bool {
        const LIPSCHITZ: f64 = 0.9;
        let mu = norm(&self.double);
        let length = norm(x);
        let mut r = length * 1.01;
        for _ in 0..6 {
            let Some((p, slope)) = self.geometry.pull_back_bounds(r) else { return false };
            let (p, slope) = (p * mu, slope * mu);
            let (mut gradient, mut hessian) = (0.0, 0.0);
            for &(degree, g, h) in &self.folded.growth {
                let degree = degree as i32;
                if degree > 0 {
                    gradient += g * p.powi(degree - 1);
                }
                if degree > 1 {
                    hessian += h * p.powi(degree - 2);
                }
            }
            if !(hessian * slope < LIPSCHITZ) {
                return false;
            }
            if gradient < r * (1.0 - 1e-9) {
                return true;
            }
            r = gradient * 1.05;
        }
        false
    }

    /// Follows the solution from s = 0 to 1 in double precision. A step in s is taken where Newton's method
    /// from the tangent contracts fast from the first correction on (θ ≤ 1/8; a tested condition of Newton and
    /// Kantorovich's kind, not a proof) and the determinant keeps its sign.
    fn follow(&self) -> Result<Vec<f64>, Branch> {
        let n = self.double.len();
        let mut x = vec![0.0; n];
        let mut s = 0.0;
        let mut by = LONGEST;
        let mut model = self.model(&x, s).map_err(|_| Branch::CannotTell)?;
        let mut steps = 0;
        while s < 1.0 {
            steps += 1;
            if by < SHORTEST || steps > 2000 {
                // Near a fold ∂F/∂x becomes singular as the root of what is left to it.
                let ratio = model.jacobian.smallest / model.jacobian.largest;
                let response = model.jacobian.inverse_norm();
                let folds = by < SHORTEST
                    && response > 30.0
                    && ratio < 0.05
                    && response * self.noise(&x) < 1e-6 * norm(&x);
                return Err(if folds { Branch::Folds(s) } else { Branch::CannotTell });
            }
            let by_now = f64::min(by, 1.0 - s);
            let tangent = model.jacobian.solve(&model.gradient);
            let Ok(tangent) = tangent else { return Err(Branch::CannotTell) };
            let end = if by_now == 1.0 - s { 1.0 } else { s + by_now };
            let guess: Vec<f64> = x.iter().zip(&tangent).map(|(x, t)| x + by_now * t).collect();
            match self.correct(guess, end, by_now * norm(&tangent), model.jacobian.sign) {
                Some((found, next)) => {
                    (x, s, model) = (found, end, next);
                    by = f64::min(2.0 * by, LONGEST);
                }
                None => by = 0.5 * by_now,
            }
        }
        Ok(x)
    }

    /// Newton's method from a tangent's guess.
    fn correct(&self, mut x: Vec<f64>, s: f64, moved: f64, sign: f64) -> Option<(Vec<f64>, Model)> {
        let mut last = 0.25 * moved;
        for _ in 0..CORRECTIONS {
            let model = self.model(&x, s).ok()?;
            if model.jacobian.sign != sign {
                return None;
            }
            let correction = model.jacobian.solve(&model.residual).ok()?;
            let length = norm(&correction);
            x.iter_mut().zip(&correction).for_each(|(x, c)| *x -= c);
            // On the way a few digits will do; at its end rounding's size.
            let enough = if s < 1.0 { 1e-5 } else { 1e-12 };
            if length <= enough * norm(&x) || length == 0.0 {
                if s >= 1.0 {
                    return Some((x, model));
                }
                let model = self.model(&x, s).ok()?;
                return (model.jacobian.sign == sign).then_some((x, model));
            }
            if length > last {
                return None;
            }
            last = length * 0.125;
        }
        None
    }

    /// Newton's method in doubled precision with factors of double precision, from an x whose defect may be known.
    pub(super) fn polish(
        &self,
        mut x: Vec<DoubleDouble>,
        known: Option<&[f64]>,
    ) -> Result<RightSolution, JudgeError> {
        let mut last = f64::INFINITY;
        let double = |x: &[DoubleDouble]| x.iter().map(|x| x.to_f64()).collect::<Vec<_>>();
        let mut jacobian = self.model(&double(&x), 1.0)?.jacobian;
        let mut response = jacobian.inverse_norm();
        let mut known = known;
        for _ in 0..30 {
            let correction = match known.take() {
                Some(defect) => jacobian.solve(defect)?,
                None => jacobian.solve(&self.defect(&x)?.1)?,
            };
            let length = norm(&correction);
            for (x, c) in x.iter_mut().zip(&correction) {
                *x = *x - DoubleDouble::from(*c);
            }
            let whole = norm(&double(&x));
            // Factors taken within 1e-13 of the solution gain ten digits at least where they are well conditioned.
            let fresh = last.is_infinite() && length <= 1e-13 * whole && response <= 1e4;
            if fresh
                || length <= 1e-28 * whole
                || length == 0.0
                || (length < 1e-24 * whole && length >= last)
            {
                return Ok(RightSolution { x, response });
            }
            if !length.is_finite() || (length > last && length > whole) {
                return Err(JudgeError::OutOfRange);
            }
            // The same factors as long as they gain three digits.
            if length > 1e-3 * last || last.is_infinite() && length > 1e-6 * whole {
                jacobian = self.model(&double(&x), 1.0)?.jacobian;
                response = jacobian.inverse_norm();
            }
            last = length;
        }
        Err(JudgeError::OutOfRange)
    }

    /// p̂(x), and x − ∂S(p̂(x)) computed in doubled precision.
    pub(super) fn defect(
        &self,
        x: &[DoubleDouble],
    ) -> Result<(Vec<DoubleDouble>, Vec<f64>), JudgeError> {
        let p = self.geometry.pull_back(x, &self.momentum)?;
        let gradient = self.folded.series.gradient(&p);
        let defect = x.iter().zip(gradient).map(|(&x, g)| (x - g).to_f64()).collect();
        Ok((p, defect))
    }

    /// The right solution: the one of a ball in which there is no other, or by continuation.
    ///
    /// # Errors
    /// [`Branch::Folds`] where there is none, [`Branch::CannotTell`] where it was not found.
    pub fn right_solution(&self) -> Result<RightSolution, Branch> {
        let exact = |x: &[f64]| x.iter().map(|&x| DoubleDouble::from(x)).collect();
        let (first, _) = self.folded.derivatives(&self.double);
        if self.contracts(&first)
            && let Ok(solution) = self.polish(exact(&first), None)
            && self.contracts(&solution.x.iter().map(|x| x.to_f64()).collect::<Vec<_>>())
        {
            return Ok(solution);
        }
        let x = self.follow()?;
        let solution = self.polish(exact(&x), None).map_err(|_| Branch::CannotTell)?;
        match distance(&solution.x, &x) {
            d if d <= SAME => Ok(solution),
            _ => Err(Branch::CannotTell),
        }
    }

    /// Whether x is the right solution, and that solution: the exact one next to x.
    #[must_use]
    pub fn branch(&self, x: &[f64]) -> (Branch, Option<RightSolution>) {
        self.branch_of(x, None)
    }

    /// The same of an x whose defect may be known.
    pub(super) fn branch_of(
        &self,
        x: &[f64],
        defect: Option<&[f64]>,
    ) -> (Branch, Option<RightSolution>) {
        let exact = x.iter().map(|&x| DoubleDouble::from(x)).collect();
        let own = self.polish(exact, defect).ok();
        if self.contracts(x) {
            return (Branch::Proven, own);
        }
        let right = match self.follow() {
            Ok(right) => right,
            Err(branch) => return (branch, None),
        };
        // To which solution x belongs: the one that Newton's method finds from it.
        let apart = match &own {
            Some(own) => distance(&own.x, &right),
            None => norm(&difference(&right, x)) / norm(&right),
        };
        if apart <= SAME && own.is_some() {
            return (Branch::Right, own);
        }
        if norm(&difference(&right, x)) <= self.grain(x) {
            return (Branch::CannotTell, None);
        }
        // Where rounding of double precision moves solutions, the end of the continuation is none.
        let exact = right.iter().map(|&x| DoubleDouble::from(x)).collect();
        match self.polish(exact, None) {
            Ok(end) if distance(&end.x, &right) <= SAME && apart > APART => {
                (Branch::Another(apart), None)
            }
            _ => (Branch::CannotTell, None),
        }
    }

    /// The part of x − ∂S(p̂) that is rounding in double precision.
    fn noise(&self, x: &[f64]) -> f64 {
        let Ok((p, _)) = self.geometry.pull_back_derivative(x, &self.double) else {
            return f64::INFINITY;
        };
        let momenta = norm(&p) + norm(&self.double);
        f64::EPSILON * (norm(x) + self.hessian_norm(&p) * momenta)
    }

    /// How far apart the solutions are that numbers of double precision tell apart where they are next to nothing.
    fn grain(&self, x: &[f64]) -> f64 {
        let Ok((p, _)) = self.geometry.pull_back_derivative(x, &self.double) else {
            return f64::INFINITY;
        };
        self.spaced(x.len(), self.hessian_norm(&p), spacing(0.5 * f64::EPSILON))
    }

    /// ‖Hess S‖ at p, the smaller of Frobenius' norm and the row sum: both bound the spectral norm.
    pub(super) fn hessian_norm(&self, p: &[f64]) -> f64 {
        let n = p.len();
        let (_, hessian) = self.folded.derivatives(p);
        let signs: Vec<f64> = hessian.iter().map(|h| h.abs()).collect();
        let rows = size(&apply(n, &signs, &vec![1.0; n]));
        let whole = norm(&hessian);
        if rows < whole { rows } else { whole }
    }
}

/// |a − b| / |a|; infinite where that is not a number.
fn distance(a: &[DoubleDouble], b: &[f64]) -> f64 {
    let difference: Vec<f64> =
        a.iter().zip(b).map(|(&a, &b)| (a - DoubleDouble::from(b)).to_f64()).collect();
    let whole: Vec<f64> = a.iter().map(|a| a.to_f64()).collect();
    let (difference, whole) = (norm(&difference), norm(&whole));
    if difference == 0.0 {
        return 0.0;
    }
    let ratio = difference / whole;
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
