//! The error at the end of a run, estimated by a second run over the whole time in steps of another size.

use std::cell::OnceCell;
use std::time::Instant;

use coadjoint::StepError;
use coadjoint_codegen::cancel;

use super::march::Pace;
use super::milestone::{Milestone, part};
use super::recorder::Outcome;
use super::sink::Sink;
use super::tally::Warning;
use super::unknown::Unknown;
use crate::engine::{Motion, Numbers, Space};
use crate::grid::Grid;

/// The steps of the second run as multiples of those of the run; the second size is for runs that are too far off to be judged
/// by the first. Neither is near a ratio of small numbers, so that no jump in time lies at the same place in steps of both.
const RATIOS: [f64; 2] = [2.13, 1.29];
/// Runs of fewer steps are judged by shorter steps: longer ones would be too few.
const FEW: f64 = 3.0;
/// Two runs that are this far apart do not say where the motion ends; the first is near enough only if it is much nearer, since
/// a difference that grows fast may be small again by chance.
const UNRESOLVED: f64 = 0.1;
const NEAR: f64 = 0.03;
/// The highest order at which smooth motions are taken to follow it in steps twice as long as those of a run.
const STEADY: u32 = 8;
/// The parts of a run in which most of the error arises.
const WORST: usize = 3;
/// Pieces in which a step is made that is refused at its full length.
const PIECES: [u64; 3] = [2, 4, 8];
/// After refused steps in a row, up to this many are made in pieces before the next is tried at full length.
const STRETCH: u64 = 16;
/// The share of a unit of rounding by which each step may add to the error.
const ROUNDING: f64 = 0.125;
/// An error above this is worth a warning.
pub const LARGE: f64 = 0.01;

/// A run that has been made.
pub(crate) struct Made<'a, 'm> {
    /// The steps of the run.
    pub motion: &'a dyn Motion,
    /// Makes steps of a size that is given as a multiple of the run's.
    pub other: &'a dyn Fn(f64) -> Result<Box<dyn Motion + 'm>, StepError>,
    /// The states at its start and end.
    pub ends: [&'a Numbers; 2],
    /// The states on the way, as far as they are known.
    pub kept: &'a [Milestone],
    /// The number of steps between two of them.
    pub part: u64,
    /// The number of steps, which is not whole where an event has ended the run.
    pub steps: f64,
    /// The times between the steps.
    pub grid: Grid,
    /// The order of the method.
    pub order: u32,
    /// True if the equations depend on the time other than through the state.
    pub moves: bool,
    /// Asked from time to time whether to stop.
    pub stop: &'a dyn Fn() -> bool,
}

/// The comparison of a run with another.
struct Compared {
    /// The size of the other's steps, as a multiple of the run's.
    ratio: f64,
    /// The difference at the end.
    difference: f64,
    /// The differences on the way, with the numbers of the run's steps.
    way: Vec<(u64, f64)>,
}

impl<'m> Made<'_, 'm> {
    /// Estimates the error at the end: the larger of the relative errors of μ and of the matrix of g, in Euclidean norms.
    ///
    /// Beside the run goes one over the whole time, and Richardson's extrapolation of the difference at the end is the error
    /// (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.4). So it grows on the way as the motion lets
    /// it grow. Where the equations depend on the time, which they may do with jumps and knots inside of steps, the power of
    /// the step that the error follows is measured where most of it arises. Below the rounding of one unit a step, truncation
    /// is not seen.
    ///
    /// # Errors
    /// The reason if it is not known.
    pub(crate) fn error(&self) -> Result<f64, Unknown> {
        let sizes: &[f64] = if self.steps < FEW { &[1.0 / RATIOS[0]] } else { &RATIOS };
        let (mut why, mut states) = (Unknown::REFUSED, None);
        for (number, &ratio) in sizes.iter().enumerate() {
            // A second run that does not come near either says when the two part.
            let last = number + 1 == sizes.len();
            if states.is_none() && (last || self.moves || self.order > STEADY) {
                states = Some(self.states()?);
            }
            let states = states.as_deref().unwrap_or_default();
            let compared = match self.compare(ratio, last, states) {
                Err(unknown @ Unknown::Other(_)) if unknown != Unknown::STOPPED => {
                    why = unknown;
                    continue;
                }
                compared => compared?,
            };
            if compared.difference <= if last { UNRESOLVED } else { NEAR } {
                return Ok(self.extrapolated(&compared, states));
            }
            let near = |(_, difference): &&(u64, f64)| *difference <= UNRESOLVED;
            let until = compared.way.iter().take_while(near).last().map_or(0, |(place, _)| *place);
            why = Unknown::Unresolved { until: self.grid.time(until) };
        }
        Err(why)
    }

    /// The error of the run, from its difference to another.
    fn extrapolated(&self, compared: &Compared, states: &[Milestone]) -> f64 {
        let Compared { ratio, difference, ref way } = *compared;
        let gain = |power: f64| 1.0 / (power - 1.0).abs();
        let mut by = gain(ratio.powi(self.order as i32));
        if (self.moves || self.order > STEADY)
            && let Some(power) = self.measured(way, states)
        {
            by = by.max(gain(power.powf(ratio.log2().abs()).max(2.0)));
        }
        let [start, end] = self.ends;
        let moved = difference > 0.0 || self.apart(start, end) > 0.0;
        let rounding = ROUNDING * self.steps.ceil() * f64::EPSILON;
        let least = if moved { 0.5 * f64::EPSILON } else { 0.0 };
        (difference * by).max(difference.min(rounding)).max(least)
    }

    /// Runs beside the run in steps of about this ratio to the end, and compares the two in these states on the way; not further
    /// than to where they part if `early`.
    fn compare(&self, ratio: f64, early: bool, states: &[Milestone]) -> Result<Compared, Unknown> {
        let mut count = (self.steps / ratio).round().max(1.0) as u64;
        let whole = self.steps.fract() == 0.0 && count > 2;
        while whole && common(self.steps as u64, count) > 1 {
            count += 1;
        }
        let ratio = self.steps / count as f64;
        let motion = (self.other)(ratio).map_err(|_| Unknown::REFUSED)?;
        let grid = Grid { step: ratio * self.grid.step, ..self.grid };
        let (pieces, stretch) = Default::default();
        let mut beside = Beside { made: self, motion, ratio, grid, pieces, stretch };
        let (mut state, mut at, mut way) = (self.ends[0].clone(), 0, Vec::new());
        for (place, kept) in states {
            let next = (*place as f64 / ratio) as u64;
            beside.go(&mut state, at, next)?;
            at = next;
            let part = (*place as f64 - next as f64 * ratio) * self.grid.step;
            let time = beside.grid.time(next);
            let here = beside.motion.beside(&state, time, part);
            // A refusal of this one step says nothing of the run.
            let Ok(here) = here else { continue };
            let difference = self.apart(kept, &here);
            way.push((*place, difference));
            if early && difference > UNRESOLVED {
                return Ok(Compared { ratio, difference, way });
            }
        }
        beside.go(&mut state, at, count)?;
        Ok(Compared { ratio, difference: self.apart(self.ends[1], &state), way })
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

    /// 2^q, where q is the power of the step that the error follows in the parts of the run in which most of it arises;
    /// none where rounding hides it.
    fn measured(&self, way: &[(u64, f64)], states: &[Milestone]) -> Option<f64> {
        let before = std::iter::once(&(0, 0.0)).chain(way);
        let mut parts: Vec<_> = before.zip(way).collect();
        let whole = (&(0, 0.0), &(self.steps as u64 / 2 * 2, 0.0));
        parts.sort_by(|(a, b), (c, d)| (d.1 - c.1).total_cmp(&(b.1 - a.1)));
        if parts.is_empty() {
            parts.push(whole);
        }
        let [double, half] = [(self.other)(2.0).ok()?, (self.other)(0.5).ok()?];
        let (mut long, mut short, mut count) = (0.0, 0.0, 0);
        for (&(from, _), &(to, _)) in parts.into_iter().take(WORST) {
            let kept = states.iter().find(|(place, _)| *place == from);
            let state = kept.map_or(self.ends[0], |(_, state)| state);
            let after = |motion: &dyn Motion, first, count| {
                let mut state = state.clone();
                motion.advance(&mut state, first, count).ok().map(|_| state)
            };
            let own = after(self.motion, from, to - from)?;
            long += self.apart(&own, &after(double.as_ref(), from / 2, (to - from) / 2)?);
            short += self.apart(&own, &after(half.as_ref(), 2 * from, 2 * (to - from))?);
            count += to - from;
        }
        (short > 2.0 * count as f64 * f64::EPSILON).then_some(long / short)
    }

    /// Makes steps `first` to `end`, in groups between which it may be stopped; the number of those made before one that
    /// is refused. What programs refuse is made by other means, which take long, only if `patient`.
    fn go(
        &self,
        (motion, patient): (&dyn Motion, bool),
        state: &mut Numbers,
        [first, end]: [u64; 2],
    ) -> Result<Result<(), u64>, Unknown> {
        let (mut at, mut pace) = (first, Pace::new());
        while at < end {
            if (self.stop)() {
                return Err(Unknown::STOPPED);
            }
            let (count, begun) = (pace.steps().min(end - at), Instant::now());
            let refuse = |_: &mut Numbers, _| Err(StepError::InvalidStep { step: f64::NAN });
            let made = match motion.lanes().filter(|_| !patient) {
                Some(programs) => {
                    programs.advance(state, self.grid.start, [at, count], refuse).map(drop)
                }
                None => motion.advance(state, at, count).map(drop),
            };
            if let Err((made, _)) = made {
                return Ok(Err(at - first + made));
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

/// Steps in a number of pieces, and in twice as many.
type Pieces<'a> = Option<[Box<dyn Motion + 'a>; 2]>;

/// A run beside another.
struct Beside<'a, 'm> {
    made: &'a Made<'a, 'm>,
    motion: Box<dyn Motion + 'm>,
    ratio: f64,
    grid: Grid,
    /// Steps of the sizes of [`PIECES`], once they were needed.
    pieces: [OnceCell<Pieces<'m>>; PIECES.len()],
    /// The steps made in pieces when last one was refused, and the number of the step after them.
    stretch: [u64; 2],
}

impl Beside<'_, '_> {
    /// Makes steps; those that are refused are made in pieces.
    fn go(&mut self, state: &mut Numbers, first: u64, end: u64) -> Result<(), Unknown> {
        let mut at = first;
        while at < end {
            let motion = (self.motion.as_ref(), self.ratio < 1.0);
            let Err(made) = self.made.go(motion, state, [at, end])? else { break };
            at += made;
            let [before, after] = self.stretch;
            let count = if at == after { (2 * before).clamp(1, STRETCH) } else { 1 };
            let count = count.min(end - at);
            self.in_pieces(state, at, count)?;
            at += count;
            self.stretch = [count, at];
        }
        Ok(())
    }

    /// Makes steps in pieces, and puts in the error that they would have at full length: that of the pieces of the first one, which
    /// follows from pieces of half the size, times the power of their number and the number of steps.
    fn in_pieces(&mut self, state: &mut Numbers, at: u64, count: u64) -> Result<(), Unknown> {
        for (kept, pieces) in self.pieces.iter().zip(PIECES) {
            let motions = kept.get_or_init(|| {
                let size = |pieces| (self.made.other)(self.ratio / pieces as f64).ok();
                Some([size(pieces)?, size(2 * pieces)?])
            });
            let Some([whole, half]) = motions else { continue };
            let [mut own, mut fine] = [&*state, &*state].map(Clone::clone);
            let (first, rest) = ([at * pieces, pieces], [(at + 1) * pieces, (count - 1) * pieces]);
            let mut make = || -> Result<(), (u64, StepError)> {
                whole.advance(&mut own, first[0], first[1])?;
                half.advance(&mut fine, 2 * first[0], 2 * first[1])?;
                let power = |base: u64| (base as f64).powi(self.made.order as i32);
                let gain = (power(pieces) - 1.0) * power(2) / (power(2) - 1.0);
                beyond(self.made.motion.space(), &mut own, &fine, gain * count as f64);
                whole.advance(&mut own, rest[0], rest[1]).map(drop)
            };
            if make().is_ok() {
                *state = own;
                return Ok(());
            }
        }
        Err(Unknown::REFUSED)
    }
}

/// Moves a state away from another by a multiple of their difference.
fn beyond(space: &dyn Space, state: &mut Numbers, other: &Numbers, times: f64) {
    let away = |(a, b): (&f64, &f64)| a + times * (a - b);
    let mu = state.mu.iter().zip(&other.mu).map(away).collect();
    let [a, b] = [&*state, other].map(|state| space.matrix(&state.g));
    let matrix: Vec<f64> = a.iter().zip(&b).map(away).collect();
    *state = Numbers { g: space.settled(&space.numbers(&matrix)), mu };
}

/// Makes a run from this state in this number of steps, and estimates the error at its end. `other` makes steps of a size that is given
/// as a multiple of those of the run. What its programs refuse is made by other means, which take long, only if `patient`.
///
/// # Errors
/// The reason if it is not known.
pub(crate) fn error_of<'m>(
    other: &dyn Fn(f64) -> Result<Box<dyn Motion + 'm>, StepError>,
    start: &Numbers,
    (steps, grid): (u64, Grid),
    (order, moves, patient): (u32, bool, bool),
) -> Result<f64, Unknown> {
    const REFUSED: Unknown = Unknown::Other("not known: a step of the run is refused");
    let stop = || {
        cancel::check();
        false
    };
    let motion = other(1.0).map_err(|_| REFUSED)?;
    let part = part(steps);
    let count = steps as f64;
    let mut end = start.clone();
    let run = Made {
        motion: motion.as_ref(),
        other,
        ends: [start, start],
        kept: &[],
        part,
        steps: count,
        grid,
        order,
        moves,
        stop: &stop,
    };
    let (mut kept, mut at) = (Vec::new(), 0);
    while at < steps {
        let next = steps.min(at + part);
        run.go((motion.as_ref(), patient), &mut end, [at, next])?.map_err(|_| REFUSED)?;
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
