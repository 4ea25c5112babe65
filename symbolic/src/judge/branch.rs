//! The right solution of x = G(x), with G = ∂S∘p̂ or that of the rates of collocation: the one continued from x = s G(x),
//! s from 0 to 1.

use nalgebra::{DMatrix, Dyn, LU};

use super::linear::{doubles, exact, norm, size, spectral};
use super::step::{RightSolution, Step, ratio};
use super::{DoubleDouble, JudgeError};

/// The verdict on a given x as a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Branch {
    /// It is: the continuation in s ends at x.
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
/// Steps in s at most, and corrections of one.
const STEPS: usize = 2000;
/// Iterations of x ↦ G(x) from 0 at most, and the change, relative to |x|, from which Newton's method goes on.
const ITERATIONS: usize = 40;
const NEXT_TO: f64 = 1e-6;
const CORRECTIONS: usize = 6;
/// Solutions nearer than this, relative to |x|, are the same; farther than [`APART`], different.
const SAME: f64 = 1e-9;
const APART: f64 = 1e-6;

/// F(x) = x − s G(x), G(x), whether G contracts next to x, and what solves with ∂F/∂x, with the sign of its determinant.
struct Probe {
    residual: DMatrix<f64>,
    value: DMatrix<f64>,
    contracts: bool,
    jacobian: Jacobian,
    sign: f64,
}

/// ∂F/∂x by its inverse, where G contracts, or by its factors.
enum Jacobian {
    Inverse(DMatrix<f64>),
    Factors(LU<f64, Dyn, Dyn>),
}

impl Probe {
    fn solve(&self, right: &DMatrix<f64>) -> Result<DMatrix<f64>, JudgeError> {
        let solution = match &self.jacobian {
            Jacobian::Inverse(inverse) => Some(inverse * right),
            Jacobian::Factors(factors) => factors.solve(right),
        };
        solution.filter(|solution| size(solution).is_finite()).ok_or(JudgeError::OutOfRange)
    }

    /// A bound on ‖(∂F/∂x)⁻¹‖.
    fn response(&self) -> f64 {
        match &self.jacobian {
            Jacobian::Inverse(inverse) => spectral(inverse),
            Jacobian::Factors(factors) => {
                factors.try_inverse().map_or(f64::INFINITY, |inverse| spectral(&inverse))
            }
        }
    }

    /// The smallest pivot over the largest; 1 where G contracts.
    fn pivots(&self) -> f64 {
        let Jacobian::Factors(factors) = &self.jacobian else { return 1.0 };
        let pivots = factors.u().diagonal().abs();
        pivots.min() / pivots.max()
    }
}

impl Step<'_> {
    fn model(&self, x: &DMatrix<f64>, s: f64) -> Result<Probe, JudgeError> {
        let n = x.nrows();
        let value = self.right_side(x)?;
        let slope = self.slope(x, &value)?;
        let (contracts, slope) = (contracts(&slope), slope * s);
        let residual = x - &value * s;
        if !(size(&residual).is_finite() && size(&slope).is_finite()) {
            return Err(JudgeError::OutOfRange);
        }
        if contracts {
            let jacobian = Jacobian::Inverse(inverse(slope));
            return Ok(Probe { residual, value, contracts, jacobian, sign: 1.0 });
        }
        let factors = (DMatrix::identity(n, n) - slope).lu();
        let sign = factors.determinant().signum();
        Ok(Probe { residual, value, contracts, jacobian: Jacobian::Factors(factors), sign })
    }

    /// The solution that iteration from the first guess leads to, where G contracts at 0, there and half way: then it is the
    /// right one. (Tested at these points, not proven between them.)
    fn near(&self) -> Result<Option<RightSolution>, JudgeError> {
        let mut x = DMatrix::zeros(self.unknowns(), 1);
        for at in 0..ITERATIONS {
            let next = self.right_side(&x)?;
            if at == 0 && !contracts(&self.slope(&x, &next)?) {
                return Ok(None);
            }
            let moved = norm(&(&next - &x));
            x = next;
            if moved <= NEXT_TO * norm(&x) {
                break;
            }
        }
        let (solution, there) = self.polished(&x)?;
        let half = doubles(&solution.x) * 0.5;
        let half_way = || -> Result<bool, JudgeError> {
            Ok(contracts(&self.slope(&half, &self.right_side(&half)?)?))
        };
        Ok((there && half_way()?).then_some(solution))
    }

    /// Follows the solution from s = 0 to 1 in double precision. A step in s is taken where Newton's method
    /// from the tangent contracts fast from the first correction on (θ ≤ 1/8; a tested condition of Newton and
    /// Kantorovich's kind, not a proof) and the determinant keeps its sign.
    fn follow(&self) -> Result<DMatrix<f64>, Branch> {
        let cannot_tell = |_| Branch::CannotTell;
        let (mut s, mut by) = (0.0, LONGEST);
        let mut x = DMatrix::zeros(self.unknowns(), 1);
        let mut model = self.model(&x, s).map_err(cannot_tell)?;
        for _ in 0..STEPS {
            if by < SHORTEST {
                // Near a fold ∂F/∂x becomes singular as the root of what is left to it.
                let response = model.response();
                let folds = response > 30.0
                    && model.pivots() < 0.05
                    && response * self.grain(&x) < 3e-5 * norm(&x);
                return Err(if folds { Branch::Folds(s) } else { Branch::CannotTell });
            }
            let end = if by < 1.0 - s { s + by } else { 1.0 };
            let tangent = model.solve(&model.value).map_err(cannot_tell)? * (end - s);
            match self.correct(&x + &tangent, end, norm(&tangent), model.sign) {
                Some((found, _)) if end == 1.0 => return Ok(found),
                Some((found, next)) => {
                    (x, s, model) = (found, end, next);
                    by = f64::min(2.0 * by, LONGEST);
                }
                None => by = 0.5 * (end - s),
            }
        }
        Err(Branch::CannotTell)
    }

    /// Newton's method from a tangent's guess.
    fn correct(
        &self,
        mut x: DMatrix<f64>,
        s: f64,
        moved: f64,
        sign: f64,
    ) -> Option<(DMatrix<f64>, Probe)> {
        let mut last = 0.25 * moved;
        // On the way a few digits will do; at its end rounding's size.
        let enough = if s < 1.0 { 1e-5 } else { 1e-12 };
        for _ in 0..CORRECTIONS {
            let model = self.model(&x, s).ok().filter(|model| model.sign == sign)?;
            let correction = model.solve(&model.residual).ok()?;
            let length = norm(&correction);
            x -= correction;
            if length <= enough * norm(&x) || length == 0.0 {
                let model = self.model(&x, s).ok().filter(|model| model.sign == sign)?;
                return Some((x, model));
            }
            if length > last {
                return None;
            }
            last = length * 0.125;
        }
        None
    }

    /// Newton's method in doubled precision with factors of double precision.
    pub(super) fn polish(&self, x: &DMatrix<f64>) -> Result<RightSolution, JudgeError> {
        self.polished(x).map(|(solution, _)| solution)
    }

    /// The polished solution, and true if G contracts where the last factors were taken, which is next to the solution.
    fn polished(&self, x: &DMatrix<f64>) -> Result<(RightSolution, bool), JudgeError> {
        let mut last = f64::INFINITY;
        let mut model = self.model(x, 1.0)?;
        let mut response = model.response();
        let mut x = exact(x);
        for _ in 0..30 {
            let correction = model.solve(&self.defect(&x)?)?;
            let length = norm(&correction);
            x -= exact(&correction);
            let whole = norm(&x);
            // Factors taken next to the solution gain seven digits at least where they are well conditioned.
            let fresh = last.is_infinite() && length <= 1e-15 * whole && response <= 1e2;
            if fresh
                || length <= 1e-28 * whole
                || length == 0.0
                || (length < 1e-24 * whole && length >= last)
            {
                return Ok((RightSolution { x, response }, model.contracts));
            }
            if !length.is_finite() || (length > last && length > whole) {
                return Err(JudgeError::OutOfRange);
            }
            // Factors are kept as long as a correction gains three digits.
            if length > 1e-3 * last || last.is_infinite() && length > 1e-6 * whole {
                model = self.model(&doubles(&x), 1.0)?;
                response = model.response();
            }
            last = length;
        }
        Err(JudgeError::OutOfRange)
    }

    /// The right solution: the one of a ball in which there is no other, or by continuation.
    ///
    /// # Errors
    /// [`Branch::Folds`] where there is none, [`Branch::CannotTell`] where it was not found.
    pub fn right_solution(&self) -> Result<RightSolution, Branch> {
        if let Ok(Some(solution)) = self.near() {
            return Ok(solution);
        }
        let x = self.follow()?;
        let solution = self.polish(&x).ok().filter(|end| distance(&end.x, &x) <= SAME);
        solution.ok_or(Branch::CannotTell)
    }

    /// The verdict on x, and the exact solution next to x if x is the right one.
    pub(super) fn branch(&self, x: &DMatrix<f64>) -> (Branch, Option<RightSolution>) {
        let right = match self.right_solution() {
            Ok(right) => doubles(&right.x),
            Err(branch) => return (branch, None),
        };
        // The solution that x belongs to: the one that Newton's method finds from it.
        let own = self.polish(x).ok();
        let away = norm(&(&right - x));
        let apart = match &own {
            Some(own) => distance(&own.x, &right),
            None => away / norm(&right),
        };
        match own {
            Some(own) if apart <= SAME => (Branch::Right, Some(own)),
            // Numbers of double precision that are next to nothing tell no nearer solutions apart.
            _ if apart > APART && away > self.grain(x) => (Branch::Another(apart), None),
            _ => (Branch::CannotTell, None),
        }
    }

    /// The part of x − G(x) that may be rounding in double precision.
    fn grain(&self, x: &DMatrix<f64>) -> f64 {
        self.bound(x, 0.5 * f64::EPSILON).map_or(f64::INFINITY, |(bound, _)| bound)
    }
}

/// True if no eigenvalue of a slope is larger than a half: it is that small itself, or its second, fourth or eighth power is.
fn contracts(slope: &DMatrix<f64>) -> bool {
    let mut power = slope.clone();
    spectral(slope) < 0.5
        || [2, 4, 8].into_iter().any(|exponent| {
            power = &power * &power;
            norm(&power) < 0.5_f64.powi(exponent)
        })
}

/// (1 − S)⁻¹ = (1 + S)(1 + S²)(1 + S⁴) … of a slope that contracts.
fn inverse(mut power: DMatrix<f64>) -> DMatrix<f64> {
    let n = power.nrows();
    let mut inverse = DMatrix::identity(n, n) + &power;
    while norm(&power) > f64::EPSILON {
        power = &power * &power;
        inverse += &power * &inverse;
    }
    inverse
}

/// |a − b| / |a|; infinite where that is not a number.
fn distance(a: &DMatrix<DoubleDouble>, b: &DMatrix<f64>) -> f64 {
    ratio(norm(&(a - exact(b))), norm(a))
}
