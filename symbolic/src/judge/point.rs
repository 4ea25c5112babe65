//! One x of a step, with what judging it needs more than once.

use nalgebra::DMatrix;

use super::JudgeError;
use super::branch::Branch;
use super::linear::{column, exact, maximum, norm, size};
use super::step::{Equation, RightSolution, Step, ratio};

impl Step<'_> {
    /// x, or the rates of a step by collocation, with all that is needed to judge them.
    ///
    /// # Errors
    /// [`JudgeError::OutOfRange`] where x is too large, [`JudgeError::NotFinite`], [`JudgeError::Length`].
    pub fn at(&self, x: &[f64]) -> Result<Point<'_>, JudgeError> {
        let (found, expected) = (x.len(), self.unknowns());
        if found != expected {
            return Err(JudgeError::Length { what: "x", found, expected });
        }
        if !size(x).is_finite() {
            return Err(JudgeError::NotFinite { what: "x" });
        }
        let x = column(x.iter().copied());
        let defect = self.defect(&exact(&x))?;
        Ok(Point { step: self, x, defect })
    }
}

/// An x that is to be judged, and x − ∂S(p̂) in doubled precision.
#[derive(Debug)]
pub struct Point<'a> {
    step: &'a Step<'a>,
    x: DMatrix<f64>,
    defect: DMatrix<f64>,
}

/// |x − ∂S(p̂)| and its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// |x − ∂S(p̂)|, the Euclidean norm.
    pub residual: f64,
    /// 16 n u (|x| + Σ of the absolute terms of ∂S + ‖Hess S‖ (|p̂| + |μ|)), and what numbers below the
    /// smallest normal one lose.
    pub bound: f64,
}

impl Residual {
    /// residual / bound; infinite where a number is not finite.
    pub fn relative(&self) -> f64 {
        ratio(self.residual, self.bound)
    }
}

impl Point<'_> {
    /// The residual of x = ∂S(p̂), and its bound for a scalar of this unit roundoff: 2⁻⁵³ for `f64`, 2⁻²⁴ for `f32`.
    pub fn residual(&self, unit: f64) -> Residual {
        let bound = self.step.bound(&self.x, unit).map_or(f64::NAN, |(bound, _)| bound);
        Residual { residual: norm(&self.defect), bound }
    }

    /// The ratio of the last two terms of the series in the direct factor of the group where it is largest: at p̂, of the
    /// sums of the absolute values of all monomials of their gradients; or of the bounds on these for all momenta as long
    /// as the longest part of μ in a factor, if that is less. Terms below rounding of a scalar of this unit roundoff do
    /// not count. `None` where the series has one term, and where there is none.
    pub fn series_ratio(&self, unit: f64) -> Option<f64> {
        // Nothing to compare with is no ratio, and a term below rounding of coordinates of order one is what cancels
        // (in a spherical body, say).
        let negligible = 32.0 * unit;
        let largest = |[last, before]: [Vec<f64>; 2]| {
            let ratios = last.iter().zip(before).map(|(&last, before)| {
                let compares = before > 0.0 && !(last <= negligible);
                if compares { last / before } else { 0.0 * last }
            });
            ratios.fold(0.0, maximum)
        };
        let (geometry, mu) = (self.step.geometry, &self.step.double);
        let Equation::Series(scaled) = &self.step.equation else { return None };
        let p = geometry.pull_back(geometry.chart, &self.x, mu).ok()?;
        let [here, anywhere] = scaled.series.last_two(&p, self.step.largest_factor())?;
        Some(largest(here).min(largest(anywhere)))
    }

    /// The verdict on x, and the exact solution next to x if x is the right one.
    pub fn branch(&self) -> (Branch, Option<RightSolution>) {
        self.step.branch(&self.x)
    }
}
