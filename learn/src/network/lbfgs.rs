//! L-BFGS on a row of numbers.
//!
//! J. Nocedal and S. Wright, *Numerical Optimization*, 2nd edition, algorithm 7.4. No threshold is
//! absolute, so losses of any scale are lowered as far as rounding lets them.

use std::collections::VecDeque;

use super::line_search::{Line, dot};
use crate::error::LearnError;

/// A loss and its gradient.
pub(super) type Evaluate<'a> = dyn FnMut(&[f64]) -> Result<(f64, Vec<f64>), LearnError> + 'a;

/// Pairs of differences kept.
const MEMORY: usize = 10;

/// How a descent went.
#[derive(Clone, Debug)]
pub(super) struct Descent {
    /// The best weights found.
    pub(super) weights: Vec<f64>,
    /// The loss of every evaluation, in order.
    pub(super) losses: Vec<f64>,
    /// Whether no step could be found that lowers the loss.
    pub(super) stuck: bool,
}

/// Lowers the loss from `start`, by at most `budget` evaluations.
pub(super) fn descend(
    start: Vec<f64>,
    budget: usize,
    evaluate: &mut Evaluate<'_>,
) -> Result<Descent, LearnError> {
    let mut losses = Vec::with_capacity(budget);
    let mut evaluate = |at: &[f64]| -> Result<(f64, Vec<f64>), LearnError> {
        let found = evaluate(at)?;
        losses.push(found.0);
        Ok(found)
    };
    let mut left = budget.saturating_sub(1);
    let (mut loss, mut gradient) = evaluate(&start)?;
    let mut weights = start;
    let mut pairs: VecDeque<Pair> = VecDeque::new();
    let mut stuck = false;
    while left > 0 && !stuck {
        let mut direction = newton_like(&pairs, &gradient);
        if dot(&direction, &gradient).is_nan() || dot(&direction, &gradient) >= 0.0 {
            pairs.clear();
            direction = gradient.iter().map(|g| -g).collect();
        }
        let slope = dot(&direction, &gradient);
        if slope.is_nan() || slope >= 0.0 {
            // The gradient is zero, or not a number.
            stuck = true;
            continue;
        }
        // Without a past, the step that would lower a linear loss to 0.
        let first = if pairs.is_empty() { loss.abs() / dot(&gradient, &gradient) } else { 1.0 };
        let line = Line { from: &weights, direction: &direction, loss, slope };
        match line.search(first, &mut left, &mut evaluate)? {
            Some(found) => {
                let moved: Vec<f64> = direction.iter().map(|d| found.step * d).collect();
                let change: Vec<f64> =
                    found.gradient.iter().zip(&gradient).map(|(a, b)| a - b).collect();
                let curvature = dot(&moved, &change);
                if curvature > f64::EPSILON * norm(&moved) * norm(&change) {
                    if pairs.len() == MEMORY {
                        pairs.pop_front();
                    }
                    pairs.push_back(Pair { inverse: 1.0 / curvature, moved, change });
                }
                weights = line.at(found.step);
                (loss, gradient) = (found.loss, found.gradient);
            }
            // Once more, from the gradient alone.
            None if !pairs.is_empty() => pairs.clear(),
            None => stuck = true,
        }
    }
    Ok(Descent { weights, losses, stuck })
}

/// s = xₖ₊₁ − xₖ, y = gₖ₊₁ − gₖ and 1/(s·y).
struct Pair {
    moved: Vec<f64>,
    change: Vec<f64>,
    inverse: f64,
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn add(target: &mut [f64], factor: f64, other: &[f64]) {
    target.iter_mut().zip(other).for_each(|(t, o)| *t += factor * o);
}

/// −H g by the two loops.
fn newton_like(pairs: &VecDeque<Pair>, gradient: &[f64]) -> Vec<f64> {
    let mut direction: Vec<f64> = gradient.iter().map(|g| -g).collect();
    let mut weights = Vec::with_capacity(pairs.len());
    for pair in pairs.iter().rev() {
        let weight = pair.inverse * dot(&pair.moved, &direction);
        add(&mut direction, -weight, &pair.change);
        weights.push(weight);
    }
    if let Some(last) = pairs.back() {
        let scale = 1.0 / (last.inverse * dot(&last.change, &last.change));
        direction.iter_mut().for_each(|d| *d *= scale);
    }
    for (pair, weight) in pairs.iter().zip(weights.iter().rev()) {
        let other = pair.inverse * dot(&pair.change, &direction);
        add(&mut direction, weight - other, &pair.moved);
    }
    direction
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

    #[test]
    fn finds_the_minimum_to_rounding_whatever_the_scale_of_the_loss() {
        for scale in [1e-20, 1.0, 1e20] {
            let mut evaluate = |x: &[f64]| {
                let (f, g) = rosenbrock(x);
                Ok((scale * f, g.iter().map(|v| scale * v).collect()))
            };
            let found = descend(vec![-0.5; 10], 500, &mut evaluate).unwrap();
            let largest = found.weights.iter().map(|w| (w - 1.0).abs()).fold(0.0, f64::max);
            assert!(largest < 1e-7, "{largest:e} after {}", found.losses.len());
        }
    }

    #[test]
    fn keeps_the_budget_and_never_gets_worse() {
        for budget in [1, 2, 3, 7, 20, 50] {
            let mut evaluate = |x: &[f64]| Ok(rosenbrock(x));
            let found = descend(vec![-0.5; 10], budget, &mut evaluate).unwrap();
            assert!(found.losses.len() <= budget);
            assert!(rosenbrock(&found.weights).0 <= found.losses[0]);
        }
    }
}
