//! A line search for the strong Wolfe conditions.
//!
//! J. Nocedal and S. Wright, *Numerical Optimization*, 2nd edition, algorithms 3.5 and 3.6.

use super::lbfgs::Evaluate;
use super::row::{self, dot};
use crate::error::LearnError;

/// Sufficient decrease.
const DECREASE: f64 = 1e-4;
/// Sufficient flattening.
const FLATTENING: f64 = 0.9;
/// The most evaluations of one line search.
const SEARCH: usize = 20;

/// The loss along a direction.
pub(super) struct Line<'a> {
    pub(super) from: &'a [f64],
    pub(super) direction: &'a [f64],
    pub(super) loss: f64,
    pub(super) slope: f64,
}

/// A point of the line that has been looked at.
#[derive(Clone)]
pub(super) struct Point {
    pub(super) step: f64,
    pub(super) loss: f64,
    slope: f64,
    pub(super) gradient: Vec<f64>,
}

impl Line<'_> {
    pub(super) fn at(&self, step: f64) -> Vec<f64> {
        row::map([self.from, self.direction], |[x, d]| x + step * d)
    }

    fn look(&self, step: f64, evaluate: &mut Evaluate<'_>) -> Result<Point, LearnError> {
        let (loss, gradient) = evaluate(&self.at(step))?;
        let slope = dot(&gradient, self.direction);
        Ok(Point { step, loss, slope, gradient })
    }

    /// Too high for its step, or not a number.
    fn too_high(&self, point: &Point) -> bool {
        point.loss.is_nan() || point.loss > self.loss + DECREASE * point.step * self.slope
    }

    fn flat(&self, point: &Point) -> bool {
        point.slope.abs() <= -FLATTENING * self.slope
    }

    /// A point with the strong Wolfe conditions, or the lowest one when the budget ends; `None` if
    /// none is lower than the start.
    pub(super) fn search(
        &self,
        first: f64,
        left: &mut usize,
        evaluate: &mut Evaluate<'_>,
    ) -> Result<Option<Point>, LearnError> {
        let origin = Point { step: 0.0, loss: self.loss, slope: self.slope, gradient: Vec::new() };
        let mut low = origin;
        let mut high: Option<Point> = None;
        let mut step = first;
        for _ in 0..SEARCH {
            if *left == 0 {
                break;
            }
            *left -= 1;
            let point = self.look(step, evaluate)?;
            if self.too_high(&point) || (low.step > 0.0 && point.loss >= low.loss) {
                high = Some(point);
            } else if self.flat(&point) {
                return Ok(Some(point));
            } else {
                let ahead = high.as_ref().map_or(1.0, |h| h.step - low.step);
                if point.slope * ahead >= 0.0 {
                    high = Some(std::mem::replace(&mut low, point));
                } else {
                    low = point;
                }
            }
            step = match &high {
                Some(high) => between(&low, high),
                None => 3.0 * low.step,
            };
        }
        Ok((low.step > 0.0).then_some(low))
    }
}

/// The minimum of the cubic through two points with their slopes, kept off the ends.
fn between(low: &Point, high: &Point) -> f64 {
    let width = high.step - low.step;
    let fraction = {
        let rise = low.slope + high.slope - 3.0 * (high.loss - low.loss) / width;
        let root = (rise * rise - low.slope * high.slope).sqrt() * width.signum();
        1.0 - (high.slope + root - rise) / (high.slope - low.slope + 2.0 * root)
    };
    let fraction = if fraction.is_finite() { fraction.clamp(0.1, 0.9) } else { 0.5 };
    low.step + fraction * width
}
