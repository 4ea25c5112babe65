//! L-BFGS on a row of numbers.
//!
//! J. Nocedal and S. Wright, *Numerical Optimization*, 2nd edition, algorithm 7.4. No threshold is
//! absolute, so losses of any scale are lowered as far as rounding lets them.

use std::collections::VecDeque;

use super::line_search::Line;
use super::row::{self, add_and_dot, dot, norm};
use crate::error::LearnError;

/// A loss and its gradient.
pub(super) type Evaluate<'a> = dyn FnMut(&[f64]) -> Result<(f64, Vec<f64>), LearnError> + 'a;

/// Pairs of differences kept.
const MEMORY: usize = 10;

/// Where a descent stands, and what it remembers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Descent {
    /// The best weights found.
    pub(super) weights: Vec<f64>,
    /// The loss there.
    pub(super) loss: f64,
    /// The gradient there.
    pub(super) gradient: Vec<f64>,
    /// The last steps, the latest last.
    pub(super) pairs: VecDeque<Pair>,
    /// Whether no step could be found that lowers the loss.
    pub(super) stuck: bool,
}

/// s = xₖ₊₁ − xₖ, y = gₖ₊₁ − gₖ, 1/(s·y) and (s·y)/(y·y).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pair {
    pub(super) moved: Vec<f64>,
    pub(super) change: Vec<f64>,
    inverse: f64,
    scale: f64,
}

impl Pair {
    pub(super) fn new(moved: Vec<f64>, change: Vec<f64>) -> Self {
        let product = dot(&moved, &change);
        let scale = product / dot(&change, &change);
        Self { moved, change, inverse: 1.0 / product, scale }
    }
}

impl Descent {
    /// Begins at `weights`, by one evaluation.
    pub(super) fn begin(
        weights: Vec<f64>,
        evaluate: &mut Evaluate<'_>,
    ) -> Result<Self, LearnError> {
        let (loss, gradient) = evaluate(&weights)?;
        Ok(Self { weights, loss, gradient, pairs: VecDeque::new(), stuck: false })
    }

    /// Searches along one direction, by at most `left` evaluations.
    pub(super) fn advance(
        &mut self,
        left: &mut usize,
        evaluate: &mut Evaluate<'_>,
    ) -> Result<(), LearnError> {
        let mut direction = self.newton_like();
        let mut slope = dot(&direction, &self.gradient);
        if slope.is_nan() || slope >= 0.0 {
            self.pairs.clear();
            direction = row::map([&self.gradient], |[g]| -g);
            slope = dot(&direction, &self.gradient);
        }
        if slope.is_nan() || slope >= 0.0 {
            // The gradient is zero, or not a number.
            self.stuck = true;
            return Ok(());
        }
        // Without a past, the step that would lower a linear loss to 0.
        let first = if self.pairs.is_empty() { self.loss.abs() / -slope } else { 1.0 };
        let line = Line { from: &self.weights, direction: &direction, loss: self.loss, slope };
        match line.search(first, left, evaluate)? {
            Some(found) => {
                let weights = line.at(found.step);
                let moved = row::map([&direction], |[d]| found.step * d);
                let change = row::map([&found.gradient, &self.gradient], |[a, b]| a - b);
                if dot(&moved, &change) > f64::EPSILON * norm(&moved) * norm(&change) {
                    if self.pairs.len() == MEMORY {
                        self.pairs.pop_front();
                    }
                    self.pairs.push_back(Pair::new(moved, change));
                }
                (self.weights, self.loss, self.gradient) = (weights, found.loss, found.gradient);
            }
            // Once more, from the gradient alone.
            None if !self.pairs.is_empty() => self.pairs.clear(),
            None => self.stuck = true,
        }
        Ok(())
    }

    /// −H g by the two loops. Every walk along the direction also makes the product that the next
    /// pair begins with.
    fn newton_like(&self) -> Vec<f64> {
        let mut direction = row::map([&self.gradient], |[g]| -g);
        let (Some(first), Some(last)) = (self.pairs.front(), self.pairs.back()) else {
            return direction;
        };
        let before = self.pairs.iter().rev().skip(1).map(|pair| &pair.moved).chain([&first.change]);
        let mut weights = Vec::with_capacity(self.pairs.len());
        let mut product = dot(&last.moved, &direction);
        for (pair, next) in self.pairs.iter().rev().zip(before) {
            let weight = pair.inverse * product;
            product = add_and_dot(&mut direction, 1.0, -weight, &pair.change, next);
            weights.push(weight);
        }
        let mut scale = last.scale;
        product *= scale;
        // The last product is used by nobody.
        let after = self.pairs.iter().skip(1).map(|pair| &pair.change).chain([&last.change]);
        for ((pair, weight), next) in self.pairs.iter().zip(weights.iter().rev()).zip(after) {
            let factor = weight - pair.inverse * product;
            product = add_and_dot(&mut direction, scale, factor, &pair.moved, next);
            scale = 1.0;
        }
        direction
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// The chained Rosenbrock function in ten variables: minimum 0 at (1, …, 1).
    fn rosenbrock(x: &[f64]) -> (f64, Vec<f64>) {
        let mut gradient = vec![0.0; x.len()];
        let mut sum = 0.0;
        for i in 0..x.len() - 1 {
            let (a, b) = (x[i + 1] - x[i] * x[i], 1.0 - x[i]);
            sum += 100.0 * a * a + b * b;
            gradient[i] -= 400.0 * a * x[i] + 2.0 * b;
            gradient[i + 1] += 200.0 * a;
        }
        (sum, gradient)
    }

    /// From −½ by at most `budget` evaluations of `scale` times the function; also their number.
    fn descend(scale: f64, budget: usize) -> (Descent, usize) {
        let mut count = 0;
        let mut evaluate = |x: &[f64]| {
            count += 1;
            let (f, g) = rosenbrock(x);
            Ok((scale * f, g.iter().map(|v| scale * v).collect()))
        };
        let mut descent = Descent::begin(vec![-0.5; 10], &mut evaluate).unwrap();
        let mut left = budget - 1;
        while left > 0 && !descent.stuck {
            descent.advance(&mut left, &mut evaluate).unwrap();
        }
        (descent, count)
    }

    #[test]
    fn finds_the_minimum_to_rounding_whatever_the_scale_of_the_loss() {
        for scale in [1e-20, 1.0, 1e20] {
            let (found, count) = descend(scale, 500);
            let largest = found.weights.iter().map(|w| (w - 1.0).abs()).fold(0.0, f64::max);
            assert!(largest < 1e-7, "{largest:e} after {count}");
        }
    }

    #[test]
    fn keeps_the_budget_and_never_gets_worse() {
        for budget in [1, 2, 3, 7, 20, 50] {
            let (found, count) = descend(1.0, budget);
            assert!(count <= budget);
            assert_eq!(rosenbrock(&found.weights), (found.loss, found.gradient));
            assert!(found.loss <= rosenbrock(&[-0.5; 10]).0);
        }
    }
}
