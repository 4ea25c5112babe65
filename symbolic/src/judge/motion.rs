//! A motion in doubled precision: the right solution of each step, with bounds on what rounding may do.

use nalgebra::DMatrix;

use super::linear::{column, doubles, norm};
use super::step::ratio;
use super::{Branch, DoubleDouble, JudgeError, RightSolution, Setting, Step};

/// Reasons for which a motion stops.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// The right solution was not found: [`Branch::Folds`] or [`Branch::CannotTell`].
    Branch(Branch),
    /// The step cannot be judged.
    Judge(JudgeError),
}

/// The state of a motion, with bounds on the distance to which rounding may have taken another motion from it.
#[derive(Clone, Debug)]
pub struct Enclosure {
    momentum: DMatrix<DoubleDouble>,
    scale: i64,
    /// The product of the steps' elements; none before the first step.
    element: Option<DMatrix<DoubleDouble>>,
    momentum_bound: f64,
    element_bound: f64,
}

impl Enclosure {
    /// A motion that starts from a momentum.
    pub fn new(mu: &[f64]) -> Self {
        let momentum = column(mu.iter().map(|&m| DoubleDouble::from(m)));
        Self { momentum, scale: 0, element: None, momentum_bound: 0.0, element_bound: 0.0 }
    }

    /// The step from where the motion has come to.
    ///
    /// # Errors
    /// As [`Setting::step`].
    pub fn here<'s>(&self, setting: &'s mut Setting<'_>) -> Result<Step<'s>, JudgeError> {
        setting.step_from(&self.momentum, self.scale)
    }

    /// The right solution of the next step that Newton's method finds from that of a motion next to this one, which has it in
    /// units of 2^scale; none where it has other units.
    pub fn beside(
        &self,
        setting: &mut Setting<'_>,
        right: &RightSolution,
        scale: i64,
    ) -> Option<RightSolution> {
        let step = self.here(setting).ok().filter(|step| step.scale == scale)?;
        step.polish(&doubles(&right.x)).ok()
    }

    /// One step, by its right solution if that is known, for a scalar of this unit roundoff.
    ///
    /// # Errors
    /// [`Stop`], the motion being left as it was.
    pub fn step(
        &mut self,
        setting: &mut Setting<'_>,
        known: Option<RightSolution>,
        unit: f64,
    ) -> Result<(), Stop> {
        let step = self.here(setting).map_err(Stop::Judge)?;
        let right = known.map_or_else(|| step.right_solution(), Ok).map_err(Stop::Branch)?;
        let end = step.end(&right, unit).map_err(Stop::Judge)?;
        let length = norm(&self.momentum);
        let relative = if length == 0.0 { 0.0 } else { self.momentum_bound / length };
        let shift = DoubleDouble::from(self.momentum_bound).scaled(self.scale - end.scale);
        self.momentum_bound = end.growth * shift.to_f64() + end.momentum_bound;
        self.element_bound =
            norm(&end.element) * (self.element_bound + end.growth * relative) + end.element_bound;
        self.element = Some(match &self.element {
            None => end.element,
            Some(element) => element * end.element,
        });
        (self.momentum, self.scale) = (end.momentum, end.scale);
        Ok(())
    }

    /// The momentum, rounded.
    pub fn momentum(&self) -> Vec<f64> {
        self.momentum.iter().map(|m| m.scaled(self.scale).to_f64()).collect()
    }

    /// The group element, row by row, that this motion has led to from `before`, rounded.
    pub fn element_from(&self, before: &[f64]) -> Vec<f64> {
        self.exact_element_from(before).transpose().iter().map(|g| g.to_f64()).collect()
    }

    fn exact_element_from(&self, before: &[f64]) -> DMatrix<DoubleDouble> {
        let size = before.len().isqrt();
        let before = before.iter().map(|&g| DoubleDouble::from(g));
        let before = DMatrix::from_row_iterator(size, size, before);
        self.element.as_ref().map_or_else(|| before.clone(), |element| &before * element)
    }

    /// True if the motion and its bounds are finite, so that a deviation has a meaning. The bounds of turns of hundreds of
    /// radians overflow.
    pub fn is_bounded(&self) -> bool {
        let mut numbers = self.momentum.iter().chain(self.element.iter().flatten());
        let bounds = self.momentum_bound.is_finite() && self.element_bound.is_finite();
        bounds && numbers.all(|number| number.is_finite())
    }

    /// The distance of a momentum from this one, divided by the bound on the difference of both motions.
    pub fn momentum_deviation(&self, momentum: &[f64]) -> f64 {
        let found = column(momentum.iter().map(|&m| DoubleDouble::from(m).scaled(-self.scale)));
        ratio(norm(&(&self.momentum - found)), self.momentum_bound)
    }

    /// The distance of a group element from `before` times the steps' elements, divided by the bound.
    pub fn element_deviation(&self, before: &[f64], after: &[f64]) -> f64 {
        let product = self.exact_element_from(before);
        let found = after.iter().map(|&g| DoubleDouble::from(g));
        let found = DMatrix::from_row_iterator(product.nrows(), product.ncols(), found);
        ratio(norm(&(product - found)), norm(before) * self.element_bound)
    }
}
