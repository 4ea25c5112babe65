//! Rows of states in memory, and what advances them: by the programs where there are any, eight side by side, or one by one.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use coadjoint_codegen::problem::{Parameter, Solver};
use coadjoint_codegen::step::{self, Invariants};
use coadjoint_native::cards::{Card, Device};
use coadjoint_program::{Precision, Trajectories, WIDTH};
use rayon::prelude::*;

use super::layout::{Attitude, Layout, Shape};
use super::march::{March, STRETCH, Way};
use crate::backend::Backend;
use crate::engine::{Compiled, Motion, Numbers, STEEP, card, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::{Derived, System};
use crate::number::{maximum, shortest};
use crate::simulate::{Maker, Stop, Warning, drifting, error_of, many};

/// The system as ensembles solve it: in lanes by Newton's method whatever the dimension, since its Hessian is then exact.
///
/// # Errors
/// Fails if it has events, which ensembles do not look for.
pub fn in_lanes(mut system: System) -> Result<System, RunError> {
    if let Some(event) = system.run.events.first() {
        let name = &event.name;
        return Err(RunError::Option(format!(
            "the event `{name}`: ensembles do not look for events; leave [[event]] out, or use simulate"
        )));
    }
    system.problem.set_solver(Solver::Newton);
    Ok(system)
}

/// A row that has no end state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejected {
    /// Its number, from 1; in a file the line of names is not counted.
    pub row: u64,
    /// The step that could not be made, from 1; 0 where the row itself is at fault.
    pub step: u64,
    /// The reason.
    pub reason: String,
}

/// Consecutive rows, numbers side by side.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// The number of the first one, from 1.
    pub first: u64,
    /// Row-major.
    pub values: Vec<f64>,
    /// Rows already known to be bad, ascending.
    pub rejected: Vec<Rejected>,
}

impl Rows {
    /// Empties it, to begin at row `first`.
    pub fn clear(&mut self, first: u64) {
        self.first = first;
        self.values.clear();
        self.rejected.clear();
    }
}

/// The largest drifts over an ensemble, each row's relative to its own [scales](coadjoint_codegen::step::Scales).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// The drifts of the quantities known to be conserved; energies are not measured.
    pub conserved: step::Drift,
    /// Rows at whose end rounding of large numbers hides a drift.
    pub unmeasured: u64,
    /// The largest ratio of the last two terms of the series at the states looked at (the start, the end, and every so
    /// many steps), where it is worth a warning; else 0.
    pub ratio: f64,
    /// The steps that the generic solver made, in place of programs that refused them.
    pub rescued: u64,
}

impl Drift {
    /// The larger of each, and the rows of both.
    pub fn max(mut self, other: Self) -> Self {
        self.conserved.raise(other.conserved);
        self.unmeasured += other.unmeasured;
        self.ratio = maximum(self.ratio, other.ratio);
        self.rescued += other.rescued;
        self
    }

    /// Warnings of drifts that rounding does not explain, and of slow steps, where each of `rows` rows made `steps` steps.
    pub fn warnings(self, rows: u64, steps: u64) -> impl Iterator<Item = Warning> {
        let slow = many(self.rescued, rows.saturating_mul(steps), || None);
        drifting(self.conserved, steps).chain(slow)
    }
}

/// The steps of each row, and the times at which its states are kept.
#[derive(Clone, Debug, Default)]
pub struct Course {
    /// Steps of every row.
    pub steps: u64,
    /// The stops at which states are kept, in order; if there are none, only the final state is kept.
    pub stops: Vec<Stop>,
}

impl Course {
    /// States kept of a row.
    pub fn kept(&self) -> usize {
        self.stops.len().max(1)
    }

    /// From step to step, with the stop that is there.
    fn legs(&self) -> impl Iterator<Item = (u64, u64, Option<Stop>)> {
        let ends = self.stops.iter().map(|stop| stop.step);
        let starts = std::iter::once(0).chain(ends.clone());
        let stops = self.stops.iter().copied().map(Some).chain([None]);
        starts.zip(ends.chain([self.steps])).zip(stops).map(|((a, b), stop)| (a, b, stop))
    }
}

/// Callbacks while rows are advanced.
pub struct Watch<'a> {
    /// Is told, again and again, how many steps every row has made.
    pub made: &'a dyn Fn(u64),
    /// Is looked at every few milliseconds; set it to stop.
    pub stop: &'a AtomicBool,
}

/// The device that makes the steps.
#[derive(Clone, Debug)]
pub struct Use {
    /// Which.
    pub device: Device,
    /// Its name.
    pub name: String,
    /// Its numbers.
    pub precision: Precision,
    /// True if the device is this machine's processor.
    pub processor: bool,
    /// Rows of which it has refused steps.
    pub redone: u64,
}

impl std::fmt::Display for Use {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}) in {} precision", self.device, self.name, self.precision)
    }
}

/// The means by which steps are made.
#[derive(Clone, Copy, Debug)]
pub struct How {
    /// The backend that evaluates programs.
    pub backend: Backend,
    /// About how many steps all lanes together make.
    pub work: f64,
    /// The device, where one is named, and its numbers.
    pub device: Option<(Device, Precision)>,
}

/// Advances rows of states of one system by the steps of a grid.
pub struct Engine<'a> {
    system: &'a Derived,
    /// The values of the parameters that are kept, as the file has them.
    parameters: Vec<f64>,
    grid: Grid,
    /// With the parameters as the file has them.
    motion: Motion<'a>,
    compiled: Option<Arc<Compiled>>,
    card: Option<Mutex<Card>>,
    /// Rows of which the device has refused a step.
    redone: AtomicU64,
    invariants: Invariants,
    /// The numbers of the identity, where rows that give no attitude start.
    identity: Vec<f64>,
}

impl<'a> Engine<'a> {
    /// Of a system that is meant for [lanes](in_lanes). Parameters that its integrator keeps vary from row to row.
    ///
    /// # Errors
    /// Fails if the step makes no sense, or the backend or device that the user named cannot be had.
    pub fn new(system: &'a Derived, grid: Grid, how: How) -> Result<Self, RunError> {
        // Lanes have their coefficients in common.
        let alike = system.facts().parameters.is_empty();
        let (trajectories, work) = if alike && system.alike() {
            (Trajectories::Lanes, how.work)
        } else if how.device.is_some() {
            let what = match alike {
                true => {
                    "--device: steps with damping, or that call a function, are not made on devices"
                }
                false => "--device: parameters that vary from row to row are not made on devices",
            };
            return Err(RunError::Option(what.to_owned()));
        } else {
            (Trajectories::One, how.work * WIDTH as f64)
        };
        let compiled = system.compiled(grid.step, how.backend, work, trajectories)?;
        let asked = how.device.zip(system.origin());
        let card = asked.map(|((device, precision), origin)| card(origin, grid, device, precision));
        let card = card.transpose()?.map(Mutex::new);
        let motion = system.steps(grid, compiled.as_ref()).map_err(RunError::unmade)?;
        let identity = motion.space().numbers(&identity(motion.space().size()));
        // Energies are not measured.
        let invariants = system.invariants.clone().without_energy();
        let redone = AtomicU64::new(0);
        let parameters = system.facts().defaults();
        Ok(Self { system, parameters, grid, motion, compiled, card, redone, invariants, identity })
    }

    /// The shape of a row.
    pub fn shape(&self) -> Shape {
        let algebra = self.system.facts().algebra;
        Shape { matrix_size: self.motion.space().size(), ..Shape::of(algebra) }
    }

    /// The number of Casimirs watched.
    pub fn casimirs(&self) -> usize {
        self.invariants.casimirs
    }

    /// The device that makes the steps, and what it has left to others; `None` where this processor makes them.
    pub fn device(&self) -> Option<Use> {
        let card = self.card.as_ref()?.lock().unwrap_or_else(PoisonError::into_inner);
        Some(Use {
            device: card.device,
            name: card.name.clone(),
            precision: card.precision,
            processor: card.is_processor,
            redone: self.redone.load(Ordering::Relaxed),
        })
    }

    /// The backend that evaluates steps now, in a few words: it may change while a compiler works.
    pub fn backend(&self) -> String {
        Compiled::maker(self.compiled.as_deref())
    }

    /// Notes on backends that are not available so far.
    pub fn notes(&self) -> Vec<String> {
        self.compiled.as_ref().map_or_else(Vec::new, |compiled| compiled.code().notes())
    }

    /// Rows taken at a time: enough for all threads, little enough to be noted often. A card has as many threads as rows.
    pub fn piece(&self, width: usize, steps: u64) -> u64 {
        if self.device().is_some_and(|by| !by.processor) {
            return ((256 << 20) / (width as u64 * 8)).clamp(512, 1 << 20);
        }
        let memory = (8 << 20) / (width as u64 * 8);
        (2_000_000 / steps.max(1)).min(memory).clamp(512, 65_536)
    }

    /// Advances every row: its values become those of the states kept, one after the other, each with the row's parameters.
    /// States that are not reached are NaN, and their rows are added to `rows.rejected`. The bits do not depend on how rows
    /// are cut into pieces or on threads.
    ///
    /// # Errors
    /// Fails if a device fails, or [`RunError::Halted`] where the watch asks to stop; nothing is known of the rows then.
    pub fn advance(
        &self,
        layout: &Layout,
        course: &Course,
        rows: &mut Rows,
        watch: &Watch<'_>,
    ) -> Result<Drift, RunError> {
        let (width, state) = (layout.width(), layout.state());
        if self.card.is_some() && !course.stops.is_empty() {
            let what = "--device: devices make states at the end alone; leave out --at or --device";
            return Err(RunError::Option(what.to_owned()));
        }
        let read: Vec<_> =
            rows.values.par_chunks(width).map(|row| self.read(layout, row)).collect();
        let known: Vec<u64> = rows.rejected.iter().map(|r| r.row).collect();
        let (mut places, mut before) = (Vec::new(), Vec::new());
        for ((place, state), row) in read.into_iter().enumerate().zip(rows.first..) {
            match state {
                _ if known.binary_search(&row).is_ok() => {}
                Ok(state) => {
                    places.push(place);
                    before.push(state);
                }
                Err(reason) => rows.rejected.push(Rejected { row, step: 0, reason }),
            }
        }
        let ways = if layout.parameters.is_empty() && self.system.alike() {
            self.march(before.clone(), course, watch)?
        } else {
            let own = places.iter().map(|place| &rows.values[place * width..][state..width]);
            let own: Vec<&[f64]> = own.collect();
            self.march_varied(layout, before.clone(), &own, course, watch)
        };
        if watch.stop.load(Ordering::Relaxed) {
            return Err(RunError::Halted { time: self.grid.start, step: 0 });
        }
        // Every state kept of a row has the row's parameters.
        let long = course.kept() * width;
        let mut values = vec![f64::NAN; rows.values.len() * course.kept()];
        for (row, given) in values.chunks_mut(long).zip(rows.values.chunks(width)) {
            row.chunks_mut(width).for_each(|one| one[state..].copy_from_slice(&given[state..]));
        }
        rows.values = values;
        // The states kept, and the drift, or the step that was not made and why.
        let drifts = before.par_chunks(WIDTH).zip(ways.par_chunks(WIDTH));
        let drifts: Vec<Drift> =
            drifts.flat_map_iter(|(before, ways)| self.drifts(before, ways)).collect();
        let end = |(drift, way): (&Drift, &Way)| {
            let kept: Vec<_> = way.kept.iter().map(|kept| self.row(layout, kept)).collect();
            let bad = kept.iter().zip(&course.stops).find_map(|(kept, stop)| {
                Some((stop.step, format!("{} on the way", kept.as_ref().err()?)))
            });
            let stopped = bad.or_else(|| way.stopped.clone());
            let end = self.row(layout, &way.state);
            let end = end.map_err(|what| (course.steps, format!("{what} at the end")));
            let ended = stopped.map_or(end, Err);
            let drift = ended.as_ref().map(|_| *drift).map_err(Clone::clone);
            let kept = if course.stops.is_empty() {
                vec![ended.ok()]
            } else {
                kept.into_iter().map(Result::ok).collect()
            };
            (kept, drift)
        };
        let ends: Vec<_> = drifts.par_iter().zip(&ways).map(end).collect();
        let ratio = ways.iter().map(|way| way.ratio).fold(0.0, maximum);
        let ratio = if ratio <= STEEP { 0.0 } else { ratio };
        let rescued = ways.iter().map(|way| way.rescued).sum();
        let mut largest = Drift { ratio, rescued, ..Drift::default() };
        for (place, (kept, drift)) in places.into_iter().zip(ends) {
            for (one, kept) in rows.values[place * long..].chunks_mut(width).zip(kept) {
                kept.iter().for_each(|kept| one[..state].copy_from_slice(kept));
            }
            match drift {
                Ok(drift) => largest = largest.max(drift),
                Err((step, reason)) => {
                    let row = rows.first + place as u64;
                    rows.rejected.push(Rejected { row, step, reason });
                }
            }
        }
        rows.rejected.sort_by_key(|r| r.row);
        Ok(largest)
    }

    /// Advances all rows, piece by piece; the values of [`Engine::advance`]. The watch is told the steps of all rows together.
    ///
    /// # Errors
    /// As [`Engine::advance`].
    pub fn advance_all(
        &self,
        layout: &Layout,
        course: &Course,
        values: &[f64],
        watch: &Watch<'_>,
    ) -> Result<(Vec<f64>, Vec<Rejected>, Drift), RunError> {
        let width = layout.width();
        let length = self.piece(width * course.kept(), course.steps) as usize;
        let mut rows = Rows::default();
        let (mut kept, mut rejected, mut drift) = (Vec::new(), Vec::new(), Drift::default());
        kept.reserve(values.len() * course.kept());
        for (number, own) in values.chunks(length * width).enumerate() {
            let first = (number * length) as u64;
            rows.clear(first + 1);
            rows.values.extend_from_slice(own);
            let count = (own.len() / width) as u64;
            let made = |made: u64| (watch.made)(first.saturating_mul(course.steps) + count * made);
            let found =
                self.advance(layout, course, &mut rows, &Watch { made: &made, ..*watch })?;
            drift = drift.max(found);
            kept.append(&mut rows.values);
            rejected.append(&mut rows.rejected);
        }
        Ok((kept, rejected, drift))
    }

    /// The columns of a state, without parameters.
    ///
    /// # Errors
    /// The name of a number that is not finite.
    fn row(&self, layout: &Layout, state: &Numbers) -> Result<Vec<f64>, String> {
        let mut row = vec![0.0; layout.state()];
        let (mu, attitude) = row.split_at_mut(state.mu.len());
        mu.copy_from_slice(&state.mu);
        if layout.attitude == Attitude::Quaternion && state.g.len() == attitude.len() {
            attitude.copy_from_slice(&state.g);
        } else if !attitude.is_empty() {
            layout.write_attitude(&self.motion.space().matrix(&state.g), attitude);
        }
        check(layout, &row)?;
        Ok(row)
    }

    /// The place of each parameter among the columns of those that vary, where it does.
    fn places(&self, layout: &Layout) -> Vec<Option<usize>> {
        let names = self.system.facts().parameters.iter().flat_map(Parameter::scalar_names);
        names.map(|name| layout.parameters.iter().position(|column| *column == name)).collect()
    }

    /// The values of all parameters with those of a row.
    fn parameters(&self, places: &[Option<usize>], own: &[f64]) -> Vec<f64> {
        let values = self.parameters.iter().zip(places);
        values.map(|(&value, place)| place.map_or(value, |place| own[place])).collect()
    }

    /// The errors at the end of these rows, estimated as those of runs are; or why a row has none.
    pub fn estimates(
        &self,
        layout: &Layout,
        steps: u64,
        rows: &[&[f64]],
    ) -> Vec<Result<f64, String>> {
        let places = self.places(layout);
        let estimate = |row: &&[f64]| {
            let start = self.read(layout, row)?;
            let parameters = self.parameters(&places, &row[layout.state()..]);
            let compiled = self.compiled.as_ref();
            let maker = Maker { system: self.system, parameters: &parameters, compiled };
            let found = error_of(maker, &start, (steps, self.grid), true);
            found.map_err(|why| why.to_string())
        };
        rows.par_iter().map(estimate).collect()
    }

    /// The state of a row, or what is wrong with it.
    fn read(&self, layout: &Layout, row: &[f64]) -> Result<Numbers, String> {
        check(layout, row)?;
        let (mu, attitude) = row[..layout.state()].split_at(layout.shape.dim);
        let space = self.motion.space();
        let g = match layout.attitude {
            Attitude::None => self.identity.clone(),
            // Rotations are put on the group; programs have them as quaternions.
            _ if layout.shape.quaternions => {
                let rotation = layout.read_rotation(attitude)?;
                match self.identity.len() {
                    4 => vec![rotation.w, rotation.i, rotation.j, rotation.k],
                    _ => {
                        space.numbers(rotation.to_rotation_matrix().transpose().matrix().as_slice())
                    }
                }
            }
            _ => {
                let off = |_| "the attitude is no element of the group".to_owned();
                space.numbers(&space.nearest(attitude).map_err(off)?)
            }
        };
        Ok(Numbers { g, mu: mu.to_vec() })
    }

    /// The drifts of rows, from their states before and after.
    fn drifts(&self, before: &[Numbers], ways: &[Way]) -> Vec<Drift> {
        let (invariants, space) = (&self.invariants, self.motion.space());
        // Energies alone depend on the time, and are not measured.
        let time = self.grid.start;
        let after: Vec<&Numbers> = ways.iter().map(|way| &way.state).collect();
        let (_, after) = space.conserved(invariants, time, &after);
        let starts = space.observe(&before.iter().collect::<Vec<_>>());
        let known = invariants.directions.as_ref().is_none_or(|known| !known.is_empty());
        let drift = |(row, [now, beside]): (usize, &[Vec<f64>; 2])| {
            let start = invariants.start(time, starts.seen(row, &before[row].mu));
            let conserved = start.measured(now, beside);
            let hidden = known && conserved.spatial_momentum.is_none()
                || invariants.casimirs > 0 && conserved.casimirs.is_none();
            Drift { conserved, unmeasured: hidden.into(), ..Drift::default() }
        };
        after.iter().enumerate().map(drift).collect()
    }

    /// Makes the steps of all states.
    fn march(
        &self,
        states: Vec<Numbers>,
        course: &Course,
        watch: &Watch<'_>,
    ) -> Result<Vec<Way>, RunError> {
        let march = March { motion: &self.motion, stop: watch.stop };
        let mut ways: Vec<Way> = states.into_iter().map(Way::from).collect();
        ways.par_chunks_mut(WIDTH).for_each(|ways| march.look(ways));
        match &self.card {
            None => {
                for (first, end, stop) in course.legs() {
                    march.march(&mut ways, first, end, watch.made);
                    let Some(stop) = stop else { continue };
                    ways.par_iter_mut().for_each(|way| march.keep(way, stop));
                }
            }
            Some(card) => {
                // A thread that panicked has left a whole card: its rows are its own.
                let mut card = card.lock().unwrap_or_else(PoisonError::into_inner);
                let redone = march.march_on(&mut card, &mut ways, course.steps, watch.made);
                self.redone.fetch_add(redone.map_err(RunError::Device)?, Ordering::Relaxed);
            }
        }
        ways.par_iter_mut().for_each(|way| march.end(way, course.steps));
        Ok(ways)
    }

    /// Makes the steps of all states, each with the values of its own of the parameters that vary.
    fn march_varied(
        &self,
        layout: &Layout,
        states: Vec<Numbers>,
        own: &[&[f64]],
        course: &Course,
        watch: &Watch<'_>,
    ) -> Vec<Way> {
        let places = self.places(layout);
        let (compiled, stop) = (self.compiled.as_ref(), watch.stop);
        let motion = || self.system.steps(self.grid, compiled).ok();
        let advance = |motion: &mut Option<Motion<'_>>, (ways, own): (&mut [Way], &[&[f64]])| {
            let Some(motion) = motion else { return };
            let parameters = own.iter().map(|own| self.parameters(&places, own));
            let parameters: Vec<Vec<f64>> = parameters.collect();
            let folded = compiled.map(|own| own.fold_rows(self.grid.step, &parameters));
            let mut folded = folded.unwrap_or_default().into_iter();
            for ((way, own), parameters) in ways.iter_mut().zip(own).zip(&parameters) {
                match folded.next().transpose() {
                    Ok(folded) => {
                        motion.vary(parameters, folded);
                        follow(motion, way, course, stop);
                    }
                    Err(error) => {
                        let values = layout.parameters.iter().zip(*own);
                        let values: Vec<String> =
                            values.map(|(name, x)| format!("{name} = {}", shortest(*x))).collect();
                        let why = format!("with {}: {error}", values.join(", "));
                        way.stopped = Some((0, why));
                    }
                }
            }
        };
        let mut ways: Vec<Way> = states.into_iter().map(Way::from).collect();
        let (count, mut made) = (ways.len() as u64, 0);
        for (ways, own) in ways.chunks_mut(ROWS).zip(own.chunks(ROWS)) {
            made += ways.len() as u64;
            let pieces = ways.par_chunks_mut(WIDTH).zip(own.par_chunks(WIDTH));
            pieces.for_each_init(motion, advance);
            // As many steps as all rows had made if they had gone together.
            (watch.made)(course.steps * made / count);
        }
        ways
    }
}

/// Makes the steps of a row alone.
fn follow(motion: &Motion<'_>, way: &mut Way, course: &Course, stop: &AtomicBool) {
    let march = March { motion, stop };
    march.look(std::slice::from_mut(way));
    for (first, end, at) in course.legs() {
        let mut done = first;
        while done < end && way.stopped.is_none() && !stop.load(Ordering::Relaxed) {
            let next = end.min(done + STRETCH);
            march.alone(way, done, next);
            march.look(std::slice::from_mut(way));
            done = next;
        }
        if let Some(at) = at {
            march.keep(way, at);
        }
    }
    if !stop.load(Ordering::Relaxed) {
        march.end(way, course.steps);
    }
}

/// Rows with parameters of their own that are followed to their ends before the next.
const ROWS: usize = 4096;

/// Refuses a row with a number that is not finite.
fn check(layout: &Layout, row: &[f64]) -> Result<(), String> {
    let Some(place) = row.iter().position(|value| !value.is_finite()) else { return Ok(()) };
    Err(format!("{} is {}", layout.names().swap_remove(place), row[place]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_that_is_not_finite_becomes_an_end_state() {
        let shape = Shape { dim: 3, matrix_size: 3, quaternions: true };
        let parameters = vec!["I1".to_owned()];
        let layout = Layout { shape, attitude: Attitude::Quaternion, parameters };
        let row = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 4.0];
        assert_eq!(check(&layout, &row), Ok(()));
        for (place, value, expected) in [
            (1, f64::NAN, "mu_2 is NaN"),
            (5, f64::INFINITY, "q_y is inf"),
            (7, f64::NAN, "I1 is NaN"),
        ] {
            let mut wrong = row;
            wrong[place] = value;
            assert!(check(&layout, &wrong).unwrap_err().starts_with(expected));
        }
    }
}
