//! The error at the end of a run, estimated by a second run over the whole time in steps of another size.

use std::sync::Arc;
use std::time::Instant;

use coadjoint::StepError;
use coadjoint_codegen::cancel;

use super::march::Pace;
use super::milestone::{Milestone, part};
use super::recorder::Outcome;
use super::sink::Sink;
use super::tally::Warning;
use super::unknown::Unknown;
use crate::engine::{Compiled, Motion, Numbers};
use crate::grid::Grid;
use crate::load::Derived;

/// The steps of the second run as multiples of those of the run, and those of a third one where steps of the second are refused,
/// or it ends farther away than [`LARGE`]: it may pass over what the run sees. Neither is near a ratio of small numbers, so that
/// no jump in time lies at the same place in steps of both.
const RATIOS: [f64; 2] = [2.13, 0.78];
/// Runs of fewer steps are judged by shorter ones alone.
const FEW: f64 = 3.0;
/// Two runs that are this far apart do not say where the motion ends.
const UNRESOLVED: f64 = 0.1;
/// The share of a unit of rounding by which each step may add to the error.
const ROUNDING: f64 = 0.5;
/// An error above this is worth a warning.
pub const LARGE: f64 = 0.01;

/// A run beside another.
struct Beside {
    /// The times between its steps.
    grid: Grid,
    /// The state at its end.
    end: Numbers,
    /// States on its way.
    way: Vec<Milestone>,
}

/// A system with values of the parameters that are kept, and its programs where there are any.
#[derive(Clone, Copy)]
pub(crate) struct Maker<'a> {
    pub system: &'a Derived,
    pub parameters: &'a [f64],
    pub compiled: Option<&'a Arc<Compiled>>,
}

impl<'a> Maker<'a> {
    /// Steps of this grid.
    ///
    /// # Errors
    /// Fails if the step or the parameters make no sense.
    pub(crate) fn steps(self, grid: Grid) -> Result<Motion<'a>, StepError> {
        self.system.with_parameters(grid, self.parameters, self.compiled)
    }
}

/// A run that has been made.
pub(crate) struct Made<'a, 's> {
    /// What makes steps of any size.
    pub maker: Maker<'a>,
    /// The steps of the run.
    pub motion: &'a Motion<'s>,
    /// The states at its start and end.
    pub ends: [&'a Numbers; 2],
    /// The states on the way, as far as they are known.
    pub kept: &'a [Milestone],
    /// The number of steps between two of them.
    pub part: u64,
    /// The number of steps, which is not whole where an event has ended the run.
    pub steps: f64,
    /// Asked from time to time whether to stop.
    pub stop: &'a dyn Fn() -> bool,
}

impl Made<'_, '_> {
    /// Estimates the error at the end: the larger of the relative errors of μ and of the matrix of g, in Euclidean norms.
    ///
    /// Beside the run goes one over the whole time, and Richardson's extrapolation of the difference at the end is the error
    /// (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.4). So it grows on the way as the motion lets
    /// it grow. Below the rounding of one unit a step, truncation is not seen. Knots of inputs inside steps leave errors of
    /// either sign, which longer steps, whose own are much larger, do not tell.
    ///
    /// # Errors
    /// The reason if it is not known.
    pub(crate) fn error(&self) -> Result<f64, Unknown> {
        let first = usize::from(self.steps < FEW || !self.maker.system.signals().is_empty());
        let order = self.maker.system.order() as i32;
        let (mut found, mut states) = (Err(Unknown::REFUSED), Vec::new());
        for (number, &ratio) in RATIOS.iter().enumerate().skip(first) {
            // The last one also says when the two part.
            if number > 0 {
                states = self.states()?;
            }
            let Some(Beside { grid, end, way }) = self.beside(ratio, &states)? else { continue };
            let ratio = grid.step / self.motion.grid().step;
            let difference = self.apart(self.ends[1], &end);
            found = if difference <= UNRESOLVED {
                let truncation = difference / (ratio.powi(order) - 1.0).abs();
                let rounding = ROUNDING * self.steps.ceil() * f64::EPSILON;
                let moved = difference > 0.0 || self.apart(self.ends[0], self.ends[1]) > 0.0;
                let least = if moved { 0.5 * f64::EPSILON } else { 0.0 };
                Ok(truncation.max(difference.min(rounding)).max(least))
            } else {
                let mut until = 0;
                for ((place, kept), (at, state)) in states.iter().zip(&way) {
                    let part = *place as f64 * self.motion.grid().step - *at as f64 * grid.step;
                    // A refusal of this one step says nothing of the run.
                    let Ok(here) = self.motion.beside(state, grid.time(*at), part) else {
                        continue;
                    };
                    if self.apart(kept, &here) > UNRESOLVED {
                        break;
                    }
                    until = *place;
                }
                Err(Unknown::Unresolved { until: self.motion.grid().time(until) })
            };
            if difference <= LARGE {
                break;
            }
        }
        found
    }

    /// Runs beside the run in steps of about this ratio, and keeps the last state before each of these on the way. None if a step
    /// is refused.
    fn beside(&self, ratio: f64, states: &[Milestone]) -> Result<Option<Beside>, Unknown> {
        let mut count = (self.steps / ratio).ceil() as u64;
        let whole = self.steps.fract() == 0.0 && count > 2;
        while whole && common(self.steps as u64, count) > 1 {
            count += 1;
        }
        let ratio = self.steps / count as f64;
        let grid = Grid { step: ratio * self.motion.grid().step, ..self.motion.grid() };
        let Ok(motion) = self.maker.steps(grid) else { return Ok(None) };
        let steps = (&motion, ratio < 1.0);
        let (mut end, mut at, mut way) = (self.ends[0].clone(), 0, Vec::new());
        let places = states.iter().map(|(place, _)| (*place as f64 / ratio) as u64);
        for next in places.chain([count]) {
            if self.go(steps, &mut end, [at, next])?.is_err() {
                return Ok(None);
            }
            at = next;
            way.push((at, end.clone()));
        }
        Ok(Some(Beside { grid, end, way }))
    }

    /// The states on the way: those kept, and before them, where a run was resumed, those that are made anew.
    fn states(&self) -> Result<Vec<Milestone>, Unknown> {
        let first = self.kept.first().map_or(self.steps.ceil() as u64, |(place, _)| *place);
        let (mut state, mut at, mut states) = (self.ends[0].clone(), 0, Vec::new());
        while at + self.part < first {
            let made = self.go((self.motion, true), &mut state, [at, at + self.part])?;
            made.map_err(|_| Unknown::REFUSED)?;
            at += self.part;
            states.push((at, state.clone()));
        }
        states.extend_from_slice(self.kept);
        Ok(states)
    }

    /// Makes steps `first` to `end`, in groups between which it may be stopped, up to one that is refused. Steps that programs
    /// refuse are made by other means, which take long, only if `patient`.
    fn go(
        &self,
        (motion, patient): (&Motion<'_>, bool),
        state: &mut Numbers,
        [first, end]: [u64; 2],
    ) -> Result<Result<(), StepError>, Unknown> {
        let (mut at, mut pace) = (first, Pace::new());
        while at < end {
            if (self.stop)() {
                return Err(Unknown::STOPPED);
            }
            let (count, begun) = (pace.steps().min(end - at), Instant::now());
            let made = match patient {
                true => motion.advance(state, at, count).map(drop),
                false => motion.advance_unrescued(state, at, count),
            };
            if let Err((_, refused)) = made {
                return Ok(Err(refused));
            }
            pace.took(count, begun.elapsed());
            at += count;
        }
        Ok(Ok(()))
    }

    /// The difference of two states, relative to the first; infinite where it is no number.
    fn apart(&self, here: &Numbers, beside: &Numbers) -> f64 {
        let space = self.motion.space();
        let [a, b] = [here, beside].map(|state| space.matrix(&state.g));
        let found = relative(&here.mu, &beside.mu).max(relative(&a, &b));
        if here.mu.iter().chain(&beside.mu).chain(&a).chain(&b).all(|x| x.is_finite()) {
            found
        } else {
            f64::INFINITY
        }
    }
}

/// Makes a run from this state in this number of steps, and estimates the error at its end. What its programs refuse is made by
/// other means, which take long, only if `patient`.
///
/// # Errors
/// The reason if it is not known.
pub(crate) fn error_of(
    maker: Maker<'_>,
    start: &Numbers,
    (steps, grid): (u64, Grid),
    patient: bool,
) -> Result<f64, Unknown> {
    const REFUSED: Unknown = Unknown::Other("not known: a step of the run is refused");
    let stop = || {
        cancel::check();
        false
    };
    let motion = maker.steps(grid).map_err(|_| REFUSED)?;
    let part = part(steps);
    let count = steps as f64;
    let mut end = start.clone();
    let run = Made {
        maker,
        motion: &motion,
        ends: [start, start],
        kept: &[],
        part,
        steps: count,
        stop: &stop,
    };
    let (mut kept, mut at) = (Vec::new(), 0);
    while at < steps {
        let next = steps.min(at + part);
        run.go((&motion, patient), &mut end, [at, next])?.map_err(|_| REFUSED)?;
        kept.extend((next < steps).then(|| (next, end.clone())));
        at = next;
    }
    Made { ends: [start, &end], kept: &kept, ..run }.error()
}

impl Outcome {
    /// Takes note of an estimate, with a warning where it is large, above the tolerance asked for, or where the end is not
    /// resolved.
    pub(crate) fn estimated(
        &mut self,
        found: Result<f64, Unknown>,
        tolerance: Option<f64>,
        sink: &mut dyn Sink,
    ) {
        let warning = match &found {
            Ok(error) if *error > LARGE => Some(Warning::Inaccurate { error: *error }),
            Ok(error) => tolerance
                .filter(|tolerance| error > tolerance)
                .map(|tolerance| Warning::AboveTolerance { error: *error, tolerance }),
            Err(Unknown::Unresolved { until }) => Some(Warning::Unresolved { until: *until }),
            Err(_) => None,
        };
        self.estimated_error = found;
        if let Some(warning) = warning {
            sink.warn(&warning.text());
            self.warnings.push(warning);
        }
    }
}

/// The greatest common divisor.
fn common(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common(b, a % b) }
}

/// The difference of two vectors, relative to the first.
fn relative(a: &[f64], b: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    let difference = norm(&mut a.iter().zip(b).map(|(a, b)| a - b));
    if difference == 0.0 { 0.0 } else { difference / norm(&mut a.iter().copied()) }
}
