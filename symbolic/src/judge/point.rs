//! One x of a step, with what judging it needs more than once.

use super::branch::Branch;
use super::norm::{maximum, norm};
use super::step::{RightSolution, Step};
use super::{DoubleDouble, JudgeError};

/// An x that is to be judged, p̂ = (d^R τ_x)ᵀ μ, and x − ∂S(p̂) in doubled precision.
#[derive(Debug)]
pub struct Point<'a> {
    step: &'a Step<'a>,
    x: &'a [f64],
    p: Vec<f64>,
    defect: Vec<f64>,
    /// The sums of the absolute values of the terms of ∂S at p̂, and those of its last two orders by direct factors.
    terms: Vec<f64>,
    last_two: [Vec<f64>; 2],
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
    #[must_use]
    pub fn relative(&self) -> f64 {
        if self.residual == 0.0 {
            return 0.0;
        }
        let ratio = self.residual / self.bound;
        if ratio.is_nan() { f64::INFINITY } else { ratio }
    }
}

impl<'a> Point<'a> {
    pub(super) fn new(step: &'a Step<'a>, x: &'a [f64]) -> Result<Self, JudgeError> {
        step.check(x)?;
        let exact: Vec<_> = x.iter().map(|&x| DoubleDouble::from(x)).collect();
        let (p, defect) = step.defect(&exact)?;
        let p: Vec<f64> = p.iter().map(|p| p.to_f64()).collect();
        let (terms, last_two) = step.folded.series.absolute(&p);
        Ok(Self { step, x, p, defect, terms, last_two })
    }

    /// Whether x solves x = ∂S(p̂): the residual and its bound for a scalar of this unit roundoff, 2⁻⁵³ for
    /// `f64` and 2⁻²⁴ for `f32`.
    #[must_use]
    pub fn residual(&self, unit: f64) -> Residual {
        let (bound, _) = self.step.bound(self.x, &self.p, &self.terms, unit);
        Residual { residual: norm(&self.defect), bound }
    }

    /// The ratio of the last two terms of the series in the direct factor of the group where it is largest: at p̂, of the
    /// sums of the absolute values of all monomials of their gradients; or of the bounds on these for all momenta as long
    /// as the longest part of μ in a factor, if that is less. Terms below rounding of a scalar of this unit roundoff do
    /// not count. `None` where the series has one term.
    #[must_use]
    pub fn series_ratio(&self, unit: f64) -> Option<f64> {
        let series = &self.step.folded.series;
        if !series.has_two() {
            return None;
        }
        // Nothing to compare with is no ratio, and a term below rounding of coordinates of order one is what cancels
        // (in a spherical body, say).
        let negligible = 32.0 * unit;
        let ratio = |[last, before]: &[Vec<f64>; 2]| {
            let ratios = last.iter().zip(before).map(|(&last, &before)| {
                let compares = before > 0.0 && !(last <= negligible);
                if compares { last / before } else { 0.0 * last }
            });
            ratios.fold(0.0, |a: f64, b| if b.is_nan() { b } else { maximum(a, b) })
        };
        let anywhere = series.last_two_anywhere(self.step.largest_factor());
        Some(ratio(&self.last_two).min(ratio(&anywhere)))
    }

    /// Whether x is the right solution, and that solution: the exact one next to x.
    #[must_use]
    pub fn branch(&self) -> (Branch, Option<RightSolution>) {
        self.step.branch_of(self.x, Some(&self.defect))
    }
}

impl Step<'_> {
    /// x with all that is needed to judge it.
    ///
    /// # Errors
    /// As [`pull_back`](Self::pull_back).
    pub fn at<'x>(&'x self, x: &'x [f64]) -> Result<Point<'x>, JudgeError> {
        Point::new(self, x)
    }

    /// Whether x solves x = ∂S(p̂): see [`Point::residual`].
    ///
    /// # Errors
    /// As [`pull_back`](Self::pull_back).
    pub fn residual(&self, x: &[f64], unit: f64) -> Result<Residual, JudgeError> {
        Ok(self.at(x)?.residual(unit))
    }

    /// The ratio of the last two terms of the series: see [`Point::series_ratio`].
    #[must_use]
    pub fn series_ratio(&self, x: &[f64], unit: f64) -> Option<f64> {
        self.at(x).ok()?.series_ratio(unit)
    }
}
