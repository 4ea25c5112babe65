//! The optimisers: Adam with a schedule, then L-BFGS, with checkpoints.
//!
//! D. Kingma and J. Ba, *Adam: a method for stochastic optimization* (2015), with its usual constants; J. Nocedal and
//! S. Wright, *Numerical Optimization*, 2nd edition, algorithms 7.4, 3.5 and 3.6. No threshold is absolute, so losses of
//! any scale are lowered as far as rounding allows.
//!
//! A checkpoint is a line of JSON, the numbers as little-endian 64-bit floats, and a CRC-32 of all of these. It is written
//! beside its place and moved there, so that there is always a whole one.

use super::options::{Progress, TrainingOptions};
use super::slope::SlopeFit;
use crate::error::LearnError;
use coadjoint_codegen::file;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::path::Path;

const FORMAT: &str = "coadjoint-checkpoint-4";

/// The state between two evaluations of the loss: the stage of the method, and all losses so far.
struct Iterate {
    stage: Stage,
    history: Vec<f64>,
}

/// The unknowns, with the memory of the current method.
enum Stage {
    /// Steps of Adam, with its two running means.
    Adam { weights: Vec<f64>, moments: [Vec<f64>; 2] },
    /// The memory of L-BFGS.
    Descent(Descent),
}

/// The state of a descent: the best weights found with their loss and gradient, the last steps and changes of the gradient,
/// the latest last, and a mark that no step could be found that lowers the loss.
struct Descent {
    weights: DVector<f64>,
    loss: f64,
    gradient: DVector<f64>,
    pairs: VecDeque<[DVector<f64>; 2]>,
    stuck: bool,
}

/// The first line: the state but for its numbers, which follow in lists of these lengths.
#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    task: u32,
    lengths: Vec<usize>,
    /// `None` before L-BFGS has begun; then true if it is stuck.
    descent: Option<bool>,
}

impl Iterate {
    fn new(weights: Vec<f64>) -> Self {
        let moments = [(); 2].map(|()| vec![0.0; weights.len()]);
        Self { stage: Stage::Adam { weights, moments }, history: Vec::new() }
    }

    /// Writes the state of the task with this fingerprint.
    fn save(&self, path: &Path, task: u32) -> Result<(), LearnError> {
        let fail = LearnError::file(path);
        let mut lists = vec![self.history.as_slice()];
        let descent = match &self.stage {
            Stage::Adam { weights, moments: [first, second] } => {
                lists.extend([weights.as_slice(), first, second]);
                None
            }
            Stage::Descent(now) => {
                lists.push(std::slice::from_ref(&now.loss));
                let rows = [&now.weights, &now.gradient].into_iter();
                lists.extend(rows.chain(now.pairs.iter().flatten()).map(|row| row.as_slice()));
                Some(now.stuck)
            }
        };
        let lengths = lists.iter().map(|list| list.len()).collect();
        let header = Header { format: FORMAT.into(), task, lengths, descent };
        let mut bytes = serde_json::to_vec(&header).map_err(|e| fail(e.into()))?;
        bytes.push(b'\n');
        bytes.extend(lists.into_iter().flatten().flat_map(|v| v.to_le_bytes()));
        bytes.extend(file::crc32(&bytes).to_le_bytes());
        file::write(path, &[], &bytes).map_err(fail)
    }

    /// Reads the state of the task with this fingerprint; `None` if there is no file.
    fn load(path: &Path, task: u32) -> Result<Option<Self>, LearnError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(LearnError::file(path)(error)),
        };
        let fail = |reason: &str| LearnError::Checkpoint(path.into(), reason.into());
        let (bytes, sum) = bytes.split_last_chunk::<4>().unwrap_or((&[], &[0; 4]));
        if file::crc32(bytes) != u32::from_le_bytes(*sum) {
            return Err(fail("it is damaged, or not a checkpoint of this version"));
        }
        let end = bytes.iter().position(|&b| b == b'\n').unwrap_or(0);
        let header = serde_json::from_slice(&bytes[..end]).ok();
        let header = header.filter(|header: &Header| header.format == FORMAT);
        let header = header.ok_or_else(|| fail("it is not a checkpoint of this version"))?;
        if header.task != task {
            return Err(fail("it belongs to other data or other options"));
        }
        let mut numbers = bytes[end + 1..].as_chunks().0.iter().map(|&c| f64::from_le_bytes(c));
        let lists = header.lengths.iter().map(|&n| numbers.by_ref().take(n).collect());
        Self::of(lists, header.descent).map(Some).ok_or_else(|| fail("it is cut off"))
    }

    fn of(mut lists: impl Iterator<Item = Vec<f64>>, descent: Option<bool>) -> Option<Self> {
        let history = lists.next()?;
        let stage = match descent {
            None => Stage::Adam { weights: lists.next()?, moments: [lists.next()?, lists.next()?] },
            Some(stuck) => {
                let loss = *lists.next()?.first()?;
                let (weights, gradient) = (lists.next()?.into(), lists.next()?.into());
                let rows: Vec<DVector<f64>> = lists.map(DVector::from_vec).collect();
                let pairs = rows.as_chunks().0.iter().cloned().collect();
                Stage::Descent(Descent { weights, loss, gradient, pairs, stuck })
            }
        };
        Some(Self { stage, history })
    }
}

/// Evaluations between two looks at the validation data.
const WATCH: usize = 10;
/// Evaluations between two checkpoints, which hold up to 22 rows of unknowns.
const SAVE: usize = 100;
const MEMORY: usize = 10;
/// The strong Wolfe conditions: sufficient decrease and sufficient flattening.
const WOLFE: (f64, f64) = (1e-4, 0.9);
/// The most evaluations of one line search.
const SEARCH: usize = 20;

type Evaluate<'a> = dyn FnMut(&[f64]) -> (f64, Vec<f64>) + 'a;

struct Point {
    step: f64,
    loss: f64,
    slope: f64,
    gradient: DVector<f64>,
}

impl Descent {
    /// Begins at `weights`, by one evaluation.
    fn begin(weights: Vec<f64>, evaluate: &mut Evaluate<'_>) -> Self {
        let (loss, gradient) = evaluate(&weights);
        let (weights, gradient) = (DVector::from_vec(weights), DVector::from_vec(gradient));
        Self { weights, loss, gradient, pairs: VecDeque::new(), stuck: false }
    }

    /// Searches along one direction, by at most `left` evaluations.
    fn advance(&mut self, left: &mut usize, evaluate: &mut Evaluate<'_>) {
        let direction = self.newton_like();
        let slope = direction.dot(&self.gradient);
        let found = if slope < 0.0 { self.search(&direction, slope, left, evaluate) } else { None };
        let Some(found) = found else {
            // Once more, from the gradient alone, unless this was it.
            self.stuck = self.pairs.is_empty();
            self.pairs.clear();
            return;
        };
        let moved = direction * found.step;
        let change = &found.gradient - &self.gradient;
        self.weights += &moved;
        (self.loss, self.gradient) = (found.loss, found.gradient);
        if moved.dot(&change) > f64::EPSILON * moved.norm() * change.norm() {
            self.pairs.push_back([moved, change]);
            if self.pairs.len() > MEMORY {
                self.pairs.pop_front();
            }
        }
    }

    /// −H g by the two loops.
    fn newton_like(&self) -> DVector<f64> {
        let mut direction = -&self.gradient;
        let mut weights = Vec::with_capacity(self.pairs.len());
        for [moved, change] in self.pairs.iter().rev() {
            let weight = moved.dot(&direction) / moved.dot(change);
            direction.axpy(-weight, change, 1.0);
            weights.push(weight);
        }
        if let Some([moved, change]) = self.pairs.back() {
            direction *= moved.dot(change) / change.norm_squared();
        }
        for ([moved, change], weight) in self.pairs.iter().zip(weights.iter().rev()) {
            direction.axpy(weight - change.dot(&direction) / moved.dot(change), moved, 1.0);
        }
        direction
    }

    /// A point with the strong Wolfe conditions, or the lowest one when the budget ends; `None` if none is below the start.
    fn search(
        &self,
        direction: &DVector<f64>,
        slope: f64,
        left: &mut usize,
        evaluate: &mut Evaluate<'_>,
    ) -> Option<Point> {
        let mut low = Point { step: 0.0, loss: self.loss, slope, gradient: DVector::zeros(0) };
        let mut high: Option<Point> = None;
        // Without a past, the step that would lower a linear loss to 0.
        let mut step = if self.pairs.is_empty() { self.loss.abs() / -slope } else { 1.0 };
        for _ in 0..SEARCH.min(*left) {
            *left -= 1;
            let (loss, gradient) = evaluate((&self.weights + direction * step).as_slice());
            let gradient = DVector::from_vec(gradient);
            let point = Point { step, loss, slope: gradient.dot(direction), gradient };
            // Too high for its step, or not a number.
            let too_high = loss.is_nan() || loss > self.loss + WOLFE.0 * step * slope;
            if too_high || (low.step > 0.0 && loss >= low.loss) {
                high = Some(point);
            } else if point.slope.abs() <= -WOLFE.1 * slope {
                return Some(point);
            } else {
                let ahead = high.as_ref().map_or(1.0, |high| high.step - low.step);
                let before = std::mem::replace(&mut low, point);
                if low.slope * ahead >= 0.0 {
                    high = Some(before);
                }
            }
            step = high.as_ref().map_or(3.0 * low.step, |high| between(&low, high));
        }
        (low.step > 0.0).then_some(low)
    }
}

/// The minimum of the cubic through two points with their slopes, kept off the ends.
fn between(low: &Point, high: &Point) -> f64 {
    let width = high.step - low.step;
    let rise = low.slope + high.slope - 3.0 * (high.loss - low.loss) / width;
    let root = (rise * rise - low.slope * high.slope).sqrt() * width.signum();
    let fraction = 1.0 - (high.slope + root - rise) / (high.slope - low.slope + 2.0 * root);
    let fraction = if fraction.is_finite() { fraction.clamp(0.1, 0.9) } else { 0.5 };
    low.step + fraction * width
}

/// Makes Adam's step number `step`, from 0, of size `rate`, with the running means of the gradient and of its squares.
fn adam(
    [first, second]: &mut [Vec<f64>; 2],
    step: usize,
    rate: f64,
    weights: &mut [f64],
    gradient: &[f64],
) {
    let count = i32::try_from(step).unwrap_or(i32::MAX - 1) + 1;
    let (beta, unbias) = ([0.9, 0.999], [0.9_f64, 0.999].map(|beta| 1.0 - beta.powi(count)));
    for ((w, g), (m, v)) in weights.iter_mut().zip(gradient).zip(first.iter_mut().zip(second)) {
        *m = beta[0] * *m + (1.0 - beta[0]) * g;
        *v = beta[1] * *v + (1.0 - beta[1]) * g * g;
        *w -= rate * (*m / unbias[0]) / ((*v / unbias[1]).sqrt() + 1e-8);
    }
}

/// Fits `train`; returns the unknowns and the loss of every evaluation. `task` is the fingerprint of everything the
/// outcome depends on; the loss on `watched` is only reported.
pub(super) fn minimise(
    (train, watched): (&SlopeFit, Option<&SlopeFit>),
    task: u32,
    options: &TrainingOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Vec<f64>, Vec<f64>), LearnError> {
    let path = options.checkpoint.as_deref();
    let kept = path.map_or(Ok(None), |path| Iterate::load(path, task))?;
    let mut state = kept.unwrap_or_else(|| Iterate::new(train.draw(options.seed)));
    let save = |state: &Iterate| path.map_or(Ok(()), |path| state.save(path, task));
    let total = options.adam_steps + options.lbfgs_steps;
    let mut saved = state.history.len();
    loop {
        let step = state.history.len();
        let mut left = total.saturating_sub(step);
        let history = &mut state.history;
        let mut tell = |at: &[f64]| {
            let (step, (loss, gradient)) = (history.len(), train.value_and_gradient(at));
            let watched = watched.filter(|_| step % WATCH == 0);
            let validation = watched.map(|fit| fit.value_and_gradient(at).0);
            progress(Progress { step, total, loss, validation });
            history.push(loss);
            (loss, gradient)
        };
        match &mut state.stage {
            Stage::Adam { weights, moments } if step < options.adam_steps => {
                let (loss, gradient) = tell(weights);
                if !loss.is_finite() && step == 0 {
                    let reason = "the loss is not finite at the first weights";
                    return Err(LearnError::NotConverged(reason.into()));
                }
                adam(moments, step, options.rate(step), weights, &gradient);
            }
            Stage::Adam { weights, .. } if left >= 2 => {
                let weights = std::mem::take(weights);
                state.stage = Stage::Descent(Descent::begin(weights, &mut tell));
            }
            Stage::Descent(descent) if left >= 1 && !descent.stuck => {
                descent.advance(&mut left, &mut tell);
            }
            _ => break,
        }
        if state.history.len() >= saved + SAVE {
            save(&state)?;
            saved = state.history.len();
        }
    }
    save(&state)?;
    let weights = match state.stage {
        Stage::Descent(descent) => descent.weights.as_slice().to_vec(),
        Stage::Adam { weights, .. } => weights,
    };
    state.history.push(train.value_and_gradient(&weights).0);
    Ok((weights, state.history))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: after bias correction the first step is −rate·sign(g), and a constant gradient keeps it so.
    #[test]
    fn the_first_steps_of_adam_go_against_the_sign() {
        let (mut moments, mut weights) = ([vec![0.0; 2], vec![0.0; 2]], [1.0, 1.0]);
        (0..3).for_each(|step| adam(&mut moments, step, 0.1, &mut weights, &[2.0, -0.5]));
        assert!((weights[0] - 0.7).abs() < 1e-7 && (weights[1] - 1.3).abs() < 1e-7, "{weights:?}");
    }

    /// The chained Rosenbrock function in ten variables: minimum 0 at (1, …, 1).
    fn rosenbrock(x: &[f64]) -> (f64, Vec<f64>) {
        let (mut sum, mut gradient) = (0.0, vec![0.0; x.len()]);
        for i in 0..x.len() - 1 {
            let (a, b) = (x[i + 1] - x[i] * x[i], 1.0 - x[i]);
            sum += 100.0 * a * a + b * b;
            gradient[i] -= 400.0 * a * x[i] + 2.0 * b;
            gradient[i + 1] += 200.0 * a;
        }
        (sum, gradient)
    }

    /// Descends from −½ by at most `budget` evaluations of `scale` times the function; also returns their number.
    fn descend(scale: f64, budget: usize) -> (Descent, usize) {
        let mut count = 0;
        let mut evaluate = |x: &[f64]| {
            count += 1;
            let (f, g) = rosenbrock(x);
            (scale * f, g.iter().map(|v| scale * v).collect())
        };
        let mut descent = Descent::begin(vec![-0.5; 10], &mut evaluate);
        let mut left = budget - 1;
        while left > 0 && !descent.stuck {
            descent.advance(&mut left, &mut evaluate);
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
            let (loss, gradient) = rosenbrock(found.weights.as_slice());
            assert_eq!((loss, gradient.as_slice()), (found.loss, found.gradient.as_slice()));
            assert!(found.loss <= rosenbrock(&[-0.5; 10]).0);
        }
    }
}
