//! Steps that are too long for the time dependence of a system: what moves faster than they look.

use std::path::Path;

use coadjoint_codegen::smooth::Smooth;
use coadjoint_program::collocation::nodes;

use crate::engine::{Breaks, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::Derived;
use crate::number::shortest;

/// Points of a step that are looked at.
const POINTS: usize = 10;
/// Stretches of a run that are looked at, where it is longer than all of them.
const STRETCHES: u64 = 10;
/// Steps of a stretch.
const STEPS: u64 = 50;
/// The largest share of what moves that the nodes of steps may miss.
const LARGEST_SHARE: f64 = 0.25;
/// The sum missed over a stretch that is refused: about the error of the momentum, relative to it.
const MATTERS: f64 = 0.01;
/// Halves of a step that are tried.
const HALVINGS: u32 = 24;

/// Checks that steps look often enough at what depends on time: ∂H/∂μ and a torque at the start, inputs included. In steps from all
/// over the run their mean, as the nodes have it, is compared with that at ten points; where nodes miss much of
/// what moves, and it adds up, an even motion may come out of a fast one.
///
/// # Errors
/// They do not; the error names a step that does, and the system as `file`.
fn resolve(
    file: &Path,
    (Grid { start, step }, steps): (Grid, u64),
    moving: &Moving<'_>,
) -> Result<(), RunError> {
    let seen = |shorter: f64| {
        let steps = (steps as f64 * (step / shorter)) as u64;
        moving.is_seen(Grid { start, step: shorter }, steps)
    };
    if seen(step) {
        return Ok(());
    }
    let mut shorter = step;
    let works = (0..HALVINGS).find_map(|_| {
        shorter *= 0.5;
        seen(shorter).then_some(shorter)
    });
    let advice = match works {
        Some(step) => format!("a step of {} sees them: give --step {0}", shortest(step)),
        None => "give a smaller --step".to_owned(),
    };
    Err(RunError::of(file)(format!(
        "steps of {} are too long for what depends on time: H, a torque or an input changes between the times at which they \
         look, and the motion would be another one; {advice}",
        shortest(step)
    )))
}

impl Derived {
    /// Checks that this number of steps looks often enough at what depends on time: at the start with this
    /// momentum, else with another one.
    ///
    /// # Errors
    /// They do not; the error names a step that does.
    pub fn resolves(
        &self,
        grid: Grid,
        steps: u64,
        momentum: Option<&[f64]>,
    ) -> Result<(), RunError> {
        let facts = self.facts();
        let any = (0..facts.algebra.dim()).map(|i| 1.0 / (i + 1) as f64);
        let momentum = momentum.map_or_else(|| any.collect(), <[f64]>::to_vec);
        let smooth = self.origin.smooth();
        let moving = smooth.and_then(|smooth| {
            let breaks = Breaks::new(self.origin.breaks());
            Moving::new(smooth, breaks, &self.values, &momentum)
        });
        moving.map_or(Ok(()), |moving| resolve(&self.file, (grid, steps), &moving))
    }
}

/// Values at some times, one after the other: velocities, or forces relative to the momentum.
type Values<'a> = Box<dyn Fn(&[f64]) -> Vec<f64> + 'a>;

/// A function of time, and when steps look at it.
struct Moving<'a> {
    values: Values<'a>,
    /// The times of a step, from its beginning on and in its lengths, and their weights.
    looks: Vec<(f64, f64)>,
    breaks: Breaks,
}

impl<'a> Moving<'a> {
    /// ∂H/∂μ, and what a drive adds at the identity, at this momentum, where they depend on time.
    fn new(smooth: &'a Smooth, breaks: Breaks, parameters: &[f64], mu: &'a [f64]) -> Option<Self> {
        if !smooth.is_function() && !smooth.depends_on_time() {
            return None;
        }
        let symbols = smooth.symbols_at(parameters);
        let driven = smooth.drive.as_ref().map(|_| identity(smooth.algebra.matrix_size()));
        let size = mu.iter().fold(0.0, |most: f64, mu| most.max(mu.abs()));
        let values = Box::new(move |times: &[f64]| {
            let omega = smooth.gradients(&symbols, times, mu);
            let Some(entries) = &driven else { return omega };
            let state = times.iter().zip(omega.chunks(mu.len()));
            let all = state.flat_map(|(&time, omega)| {
                let [own, torque] = smooth.acting(&symbols, time, entries, [mu, omega]);
                let torque = torque.into_iter().map(move |torque| torque / size);
                omega.iter().zip(own).map(|(a, b)| a + b).chain(torque).collect::<Vec<_>>()
            });
            all.collect()
        });
        let splitting = smooth.kicks.as_ref().map(|kicks| kicks.splitting);
        let flows: Vec<f64> = splitting.map_or(vec![1.0], |splitting| splitting.flows().collect());
        let (mut start, mut looks) = (0.0, Vec::new());
        for flow in flows {
            let own = nodes(smooth.nodes());
            looks.extend(own.map(|(at, weight)| (flow.mul_add(at, start), flow * weight)));
            start += flow;
        }
        Some(Self { values, looks, breaks })
    }

    /// True if this number of steps sees what moves.
    fn is_seen(&self, grid: Grid, steps: u64) -> bool {
        let stretches = if steps <= STRETCHES * STEPS { 1 } else { STRETCHES };
        let long = if stretches == 1 { steps } else { STEPS };
        let (mut points, mut width): (Vec<f64>, usize) = (Vec::new(), 0);
        let (mut missed, mut worst) = (0.0, 0.0);
        for stretch in 0..stretches {
            let first = (steps - long) / (stretches - 1).max(1) * stretch;
            // Points at the same places of every step would be blind as nodes may be.
            let shift = |number: u64| (number as f64 * 0.618_033_988_749_894_9).fract();
            let fine =
                |number| (0..POINTS).map(move |i| (i as f64 + shift(number)) / POINTS as f64);
            let looks = || self.looks.iter().map(|(at, _)| *at);
            // Steps with breaks are made in parts.
            let whole = |number: &u64| self.breaks.next(grid, *number) != Some(*number);
            let numbers: Vec<u64> = (first..first + long).filter(whole).collect();
            let long = numbers.len();
            if long == 0 {
                continue;
            }
            let times = numbers.into_iter().flat_map(|number| {
                let start = grid.time(number);
                looks().chain(fine(number)).map(move |at| at.mul_add(grid.step, start))
            });
            let values = (self.values)(&times.collect::<Vec<_>>());
            if values.iter().any(|value| !value.is_finite()) {
                // The run says where this is.
                return true;
            }
            width = values.len() / (long * (self.looks.len() + POINTS));
            let weights = self.looks.iter().map(|(_, weight)| *weight);
            let weights: Vec<f64> = weights.chain([-1.0 / POINTS as f64; POINTS]).collect();
            let mut sum = vec![0.0; width];
            for step in values.chunks(width * weights.len()) {
                let mut difference = vec![0.0; width];
                for (values, weight) in step.chunks(width).zip(&weights) {
                    difference.iter_mut().zip(values).for_each(|(sum, v)| *sum += weight * v);
                }
                points.extend_from_slice(&step[width * self.looks.len()..]);
                missed += largest(&difference);
                sum.iter_mut().zip(&difference).for_each(|(sum, d)| *sum += d * grid.step);
                worst = f64::max(worst, largest(&sum));
            }
        }
        if points.is_empty() {
            return true;
        }
        let count = (points.len() / width) as f64;
        let mut mean = vec![0.0; width];
        for point in points.chunks(width) {
            mean.iter_mut().zip(point).for_each(|(mean, value)| *mean += value / count);
        }
        let apart = |point: &[f64]| {
            point.iter().zip(&mean).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
        };
        let moves = points.chunks(width).map(apart).sum::<f64>() / POINTS as f64;
        worst <= MATTERS || missed <= LARGEST_SHARE * moves
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}
