//! A motion in doubled precision: the right solution of each step, with bounds on what rounding may do.

use super::linear::multiply;
use super::norm::norm;
use super::{Branch, DoubleDouble, End, JudgeError, RightSolution, Setting};

/// Why a motion stops.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// The right solution was not found: [`Branch::Folds`] or [`Branch::CannotTell`].
    Branch(Branch),
    /// The step cannot be judged.
    Judge(JudgeError),
}

/// Where a motion has come to, and how far rounding may have taken another one from it.
#[derive(Clone, Debug)]
pub struct Motion {
    momentum: Vec<DoubleDouble>,
    scale: i64,
    /// The product of the steps' elements, row by row; none before the first step.
    element: Option<Vec<DoubleDouble>>,
    momentum_bound: f64,
    element_bound: f64,
}

impl Motion {
    /// From a momentum.
    #[must_use]
    pub fn new(mu: &[f64]) -> Self {
        let momentum = mu.iter().map(|&m| DoubleDouble::from(m)).collect();
        Self { momentum, scale: 0, element: None, momentum_bound: 0.0, element_bound: 0.0 }
    }

    /// The step from where the motion has come to.
    ///
    /// # Errors
    /// As [`Setting::step_from`].
    pub fn here<'s>(&self, setting: &'s mut Setting<'_>) -> Result<super::Step<'s>, JudgeError> {
        setting.step_from(&self.momentum, self.scale)
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
        let step = setting.step_from(&self.momentum, self.scale).map_err(Stop::Judge)?;
        let right = match known {
            Some(right) => right,
            None => step.right_solution().map_err(Stop::Branch)?,
        };
        let end = step.end(&right, unit).map_err(Stop::Judge)?;
        let length = norm(&doubles(&self.momentum));
        let relative = if length == 0.0 { 0.0 } else { self.momentum_bound / length };
        let shift = DoubleDouble::from(self.momentum_bound).scaled(self.scale - end.scale);
        self.momentum_bound = end.growth * shift.to_f64() + end.momentum_bound;
        let factor = norm(&doubles(&end.element));
        self.element_bound =
            factor * (self.element_bound + end.growth * relative) + end.element_bound;
        let size = matrix_size(end.element.len());
        self.element = Some(match &self.element {
            None => end.element,
            Some(element) => multiply(size, element, &end.element),
        });
        (self.momentum, self.scale) = (end.momentum, end.scale);
        Ok(())
    }

    /// The momentum, rounded.
    #[must_use]
    pub fn momentum(&self) -> Vec<f64> {
        self.momentum.iter().map(|m| m.scaled(self.scale).to_f64()).collect()
    }

    /// The group element that this motion has led to from `before`, rounded.
    #[must_use]
    pub fn element_from(&self, before: &[f64]) -> Vec<f64> {
        let exact: Vec<_> = before.iter().map(|&g| DoubleDouble::from(g)).collect();
        match &self.element {
            Some(element) => doubles(&multiply(matrix_size(before.len()), &exact, element)),
            None => before.to_vec(),
        }
    }

    /// Whether the motion and its bounds are numbers, so that a deviation means something: turns of hundreds of radians are
    /// bounded by what exceeds all numbers.
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        let element = self.element.iter().flatten().all(|entry| entry.is_finite());
        let momentum = self.momentum.iter().all(|entry| entry.is_finite());
        element && momentum && self.momentum_bound.is_finite() && self.element_bound.is_finite()
    }

    /// How far a momentum is from this one over the bound of both motions' difference.
    #[must_use]
    pub fn momentum_deviation(&self, momentum: &[f64]) -> f64 {
        let difference = self.momentum.iter().zip(momentum).map(|(&exact, &found)| {
            (exact - DoubleDouble::from(found).scaled(-self.scale)).to_f64()
        });
        over(norm(&difference.collect::<Vec<_>>()), self.momentum_bound)
    }

    /// How far a group element is from `before` times the steps' elements, over the bound.
    #[must_use]
    pub fn element_deviation(&self, before: &[f64], after: &[f64]) -> f64 {
        let before_exact: Vec<_> = before.iter().map(|&g| DoubleDouble::from(g)).collect();
        let product = match &self.element {
            Some(element) => multiply(matrix_size(before.len()), &before_exact, element),
            None => before_exact,
        };
        let difference =
            product.iter().zip(after).map(|(&e, &f)| (e - DoubleDouble::from(f)).to_f64());
        over(norm(&difference.collect::<Vec<_>>()), norm(before) * self.element_bound)
    }
}

fn doubles(v: &[DoubleDouble]) -> Vec<f64> {
    v.iter().map(|v| v.to_f64()).collect()
}

fn matrix_size(entries: usize) -> usize {
    (0..=entries).find(|n| n * n >= entries).unwrap_or(0)
}

/// error / bound; infinite where that is no number.
fn over(error: f64, bound: f64) -> f64 {
    if error == 0.0 {
        return 0.0;
    }
    let ratio = error / bound;
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}

impl End {
    /// The momentum after the step, rounded.
    #[must_use]
    pub fn rounded(&self) -> Vec<f64> {
        self.momentum.iter().map(|m| m.scaled(self.scale).to_f64()).collect()
    }
}
