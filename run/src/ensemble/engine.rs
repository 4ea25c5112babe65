//! Rows of states in memory, and what advances them: by the programs where there are any, eight side by side, or one by one.

use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use coadjoint_codegen::problem::{Parameter, Solver};
use coadjoint_codegen::step::{self, DriftPrograms};
use coadjoint_native::cards::{Card, Device};
use coadjoint_program::states::{States, into_lane};
use coadjoint_program::{Precision, Trajectories, WIDTH};
use rayon::prelude::*;

use super::course::Course;
use super::disturbed::{Disturbance, Disturbed};
use super::layout::{Attitude, Layout, Shape};
use super::march::{March, Overall, Way, Ways, stop};
use crate::backend::Backend;
use crate::engine::{Compiled, Motion, Numbers, STEEP, card, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::{Derived, System};
use crate::number::{maximum, shortest};
use crate::simulate::{Maker, Warning, drifting, error_of, many};

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
    /// The time for which it has run.
    pub running: Duration,
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
    /// Samples of inputs that rows have of their own.
    disturbed: Disturbed,
    card: Option<Mutex<Card>>,
    /// Rows of which the device has refused a step.
    redone: AtomicU64,
    /// The nanoseconds for which the device has run.
    running: AtomicU64,
    drifts: DriftPrograms,
    /// The numbers of the identity, where rows that give no attitude start.
    identity: Vec<f64>,
}

impl<'a> Engine<'a> {
    /// Of a system that is meant for [lanes](in_lanes). Parameters that its integrator keeps vary from row to row.
    ///
    /// # Errors
    /// Fails if the step makes no sense, or the backend or device that the user named cannot be had.
    pub fn new(system: &'a Derived, grid: Grid, how: How) -> Result<Self, RunError> {
        Self::disturbed(system, grid, how, (Vec::new(), 0))
    }

    /// As [`Engine::new`], for this many rows, with samples of inputs that each has of its own.
    ///
    /// # Errors
    /// As [`Engine::new`], and where the samples do not fit.
    pub fn disturbed(
        system: &'a Derived,
        grid: Grid,
        how: How,
        (given, rows): (Vec<Disturbance>, usize),
    ) -> Result<Self, RunError> {
        let disturbed = Disturbed::new(system.signals(), given, rows)?;
        // Lanes have their coefficients in common.
        let alike = system.facts().parameters.is_empty() && disturbed.is_empty();
        let (trajectories, work) = if alike && system.alike() {
            (Trajectories::Lanes, how.work)
        } else if how.device.is_some() {
            let what = match alike {
                true => "--device: steps that call a function are not made on devices",
                false => {
                    "--device: parameters or inputs that vary from row to row are not made on devices"
                }
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
        let drifts = motion.space().drifts(&system.invariants);
        let (redone, running) = Default::default();
        let parameters = system.values.clone();
        Ok(Self {
            system,
            parameters,
            grid,
            motion,
            compiled,
            disturbed,
            card,
            redone,
            running,
            drifts,
            identity,
        })
    }

    /// The shape of a row.
    pub fn shape(&self) -> Shape {
        let algebra = self.system.facts().algebra;
        Shape { matrix_size: self.motion.space().size(), ..Shape::of(algebra) }
    }

    /// The number of Casimirs watched.
    pub fn casimirs(&self) -> usize {
        self.system.invariants.casimirs
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
            running: Duration::from_nanos(self.running.load(Ordering::Relaxed)),
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
        let width = layout.width();
        if self.card.is_some() && !course.stops.is_empty() {
            let what = "--device: devices make states at the end alone; leave out --at or --device";
            return Err(RunError::Option(what.to_owned()));
        }
        let count = rows.values.len() / width;
        let mut states = States::new(self.identity.len(), layout.shape.dim, count);
        let mut ways = vec![None; count];
        let length = states.length();
        let given = || rows.values.par_chunks(WIDTH * width);
        let blocks = states.blocks_mut().par_chunks_mut(length).zip(ways.par_chunks_mut(WIDTH));
        blocks.zip(given()).for_each(|((block, ways), rows)| {
            self.read_block(layout, rows, block, |lane, why| stop(&mut ways[lane], Some((0, why))));
        });
        let known: Vec<usize> =
            rows.rejected.iter().map(|r| (r.row - rows.first) as usize).collect();
        for &place in &known {
            stop(&mut ways[place], Some((0, String::new())));
        }
        let (overall, before) = (Overall::default(), states.clone());
        if layout.parameters.is_empty() && self.disturbed.is_empty() && self.system.alike() {
            self.march(&mut ways, &mut states, &overall, course, watch)?;
        } else {
            let all = (&mut ways[..], &mut states, &overall);
            self.march_varied(layout, all, (&rows.values, rows.first), course, watch);
        }
        if watch.stop.load(Ordering::Relaxed) {
            return Err(RunError::Halted { time: self.grid.start, step: 0 });
        }
        let long = course.kept() * width;
        let mut values = vec![0.0; count * long];
        let known_momenta =
            self.system.invariants.directions.as_ref().is_none_or(|known| !known.is_empty());
        let blocks = before.blocks().par_chunks(length).zip(states.blocks().par_chunks(length));
        let found = blocks.zip(ways.par_chunks_mut(WIDTH));
        let found = found.zip(values.par_chunks_mut(WIDTH * long).zip(given()));
        let gauge = || self.drifts.gauge();
        let largest = found.map_init(gauge, |gauge, (((before, after), ways), (values, given))| {
            let space = self.motion.space();
            let drifts = gauge
                .drifts([before, after], |block, spatial| space.spatial_momenta(block, spatial));
            let rows = ways.iter_mut().zip(values.chunks_mut(long)).zip(given.chunks(width));
            let mut largest = Drift::default();
            for ((lane, ((way, kept), given)), conserved) in rows.enumerate().zip(drifts) {
                match self.write(layout, course, (way, after, lane), given, kept) {
                    Ok(()) => {
                        let hidden = known_momenta && conserved.spatial_momentum.is_none()
                            || self.casimirs() > 0 && conserved.casimirs.is_none();
                        let unmeasured = hidden.into();
                        largest = largest.max(Drift { conserved, unmeasured, ..Drift::default() });
                    }
                    Err(stopped) => way.get_or_insert_default().stopped = Some(stopped),
                }
            }
            largest
        });
        let mut largest = largest.reduce(Drift::default, Drift::max);
        rows.values = values;
        let ratio = overall.ratio();
        largest.ratio = if ratio <= STEEP { 0.0 } else { ratio };
        largest.rescued = overall.rescued();
        for (place, way) in ways.into_iter().enumerate() {
            if let Some((step, reason)) = way.and_then(|way| way.stopped)
                && known.binary_search(&place).is_err()
            {
                rows.rejected.push(Rejected { row: rows.first + place as u64, step, reason });
            }
        }
        rows.rejected.sort_by_key(|r| r.row);
        Ok(largest)
    }

    /// Reads rows into a block. Those that are no states are NaN there; `refuse` is told their lanes, and what is wrong.
    fn read_block(
        &self,
        layout: &Layout,
        rows: &[f64],
        block: &mut [f64],
        mut refuse: impl FnMut(usize, String),
    ) {
        block.fill(f64::NAN);
        for (lane, row) in rows.chunks(layout.width()).enumerate() {
            match self.read(layout, row) {
                Ok((g, mu)) => into_lane(block, lane, [&g, mu]),
                Err(reason) => refuse(lane, reason),
            }
        }
    }

    /// Writes the states kept of a row, each with the row's parameters; NaN for those that were not reached.
    ///
    /// # Errors
    /// The step that was not made, and the reason.
    fn write(
        &self,
        layout: &Layout,
        course: &Course,
        (way, after, lane): (&mut Option<Box<Way>>, &[f64], usize),
        given: &[f64],
        values: &mut [f64],
    ) -> Result<(), (u64, String)> {
        let (width, state) = (layout.width(), layout.state());
        for one in values.chunks_mut(width) {
            one[..state].fill(f64::NAN);
            one[state..].copy_from_slice(&given[state..]);
        }
        let end = |i: usize| after[i * WIDTH + lane];
        let mut bad = None;
        let kept = way.iter().flat_map(|way| &way.kept);
        for ((kept, stop), one) in kept.zip(&course.stops).zip(values.chunks_mut(width)) {
            let [g, mu] = kept.parts();
            let number = |i: usize| if i < g.len() { g[i] } else { mu[i - g.len()] };
            if let Err(what) = self.row(layout, number, &mut one[..state]) {
                bad.get_or_insert((stop.step, format!("{what} on the way")));
            }
        }
        if let Some(stopped) = bad.or_else(|| way.as_mut()?.stopped.take()) {
            return Err(stopped);
        }
        let mut last = vec![0.0; if course.stops.is_empty() { 0 } else { state }];
        let last = if last.is_empty() { &mut values[..state] } else { &mut last[..] };
        let written = self.row(layout, end, last);
        written.map_err(|what| (course.steps, format!("{what} at the end")))
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

    /// Writes the numbers of a state, given by their places, into the columns of a row without parameters; leaves them NaN where one is not finite.
    ///
    /// # Errors
    /// The name of a number that is not finite.
    fn row(
        &self,
        layout: &Layout,
        number: impl Fn(usize) -> f64,
        row: &mut [f64],
    ) -> Result<(), String> {
        let (mu, attitude) = row.split_at_mut(layout.shape.dim);
        let element = self.identity.len();
        if layout.attitude == Attitude::Quaternion && element == attitude.len() {
            attitude.iter_mut().enumerate().for_each(|(i, place)| *place = number(i));
        } else if !attitude.is_empty() {
            let g: Vec<f64> = (0..element).map(&number).collect();
            layout.write_attitude(&self.motion.space().matrix(&g), attitude);
        }
        mu.iter_mut().enumerate().for_each(|(i, place)| *place = number(element + i));
        let checked = check(layout, row);
        if checked.is_err() {
            row.fill(f64::NAN);
        }
        checked
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
            let (g, mu) = self.read(layout, row)?;
            let start = Numbers { g: g.into_owned(), mu: mu.to_vec() };
            let parameters = self.parameters(&places, &row[layout.state()..]);
            let compiled = self.compiled.as_ref();
            let maker = Maker { system: self.system, parameters: &parameters, compiled };
            let found = error_of(maker, &start, (steps, self.grid), true);
            found.map_err(|why| why.to_string())
        };
        rows.par_iter().map(estimate).collect()
    }

    /// The state of a row, or what is wrong with it.
    fn read<'r>(
        &'r self,
        layout: &Layout,
        row: &'r [f64],
    ) -> Result<(Cow<'r, [f64]>, &'r [f64]), String> {
        check(layout, row)?;
        let (mu, attitude) = row[..layout.state()].split_at(layout.shape.dim);
        let space = self.motion.space();
        let g = match layout.attitude {
            Attitude::None => return Ok((Cow::Borrowed(&self.identity), mu)),
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
        Ok((Cow::Owned(g), mu))
    }

    /// Makes the steps of all states.
    fn march(
        &self,
        ways: &mut Ways,
        states: &mut States,
        overall: &Overall,
        course: &Course,
        watch: &Watch<'_>,
    ) -> Result<(), RunError> {
        let march = March { motion: &self.motion, stop: watch.stop, overall };
        states.blocks().par_chunks(states.length()).for_each(|block| march.look(block));
        match &self.card {
            None => {
                for (first, end, stop) in course.legs() {
                    march.march(ways, states, first, end, watch.made);
                    let Some(stop) = stop else { continue };
                    march.each(ways, states, |way, state| march.keep(way, &state(), stop));
                }
            }
            Some(card) => {
                // A thread that panicked has left a whole card: its rows are its own.
                let mut card = card.lock().unwrap_or_else(PoisonError::into_inner);
                let moved = march.march_on(&mut card, ways, states, course.steps, watch.made);
                let (redone, running) = moved.map_err(RunError::Device)?;
                let running = u64::try_from(running.as_nanos()).unwrap_or(u64::MAX);
                self.redone.fetch_add(redone, Ordering::Relaxed);
                self.running.fetch_add(running, Ordering::Relaxed);
            }
        }
        if self.motion.may_be_undefined() {
            march.each(ways, states, |way, state| march.end(way, &state(), course.steps));
        }
        Ok(())
    }

    /// Makes the steps of the row of this number, from 0, with this momentum at the start, with its own inputs.
    ///
    /// # Errors
    /// The reason for which there are none.
    fn with_inputs(
        &self,
        (row, momentum): (usize, &[f64]),
        parameters: &[f64],
        course: &Course,
        follow: impl FnOnce(&Motion<'_>),
    ) -> Result<(), String> {
        let system = self.system;
        let signals = self.disturbed.of_row(system.signals(), row)?;
        let compiled = self.compiled.as_ref().map(|own| own.with_signals(&signals));
        let system = system.with_signals(signals);
        let said = |error: RunError| error.to_string();
        system.resolves(self.grid, course.steps, Some(momentum)).map_err(said)?;
        let motion = system.with_parameters(self.grid, parameters, compiled.as_ref());
        follow(&motion.map_err(|error| error.to_string())?);
        Ok(())
    }

    /// Makes the steps of all states, each with the values of its own of the parameters that vary, and with its own inputs.
    fn march_varied(
        &self,
        layout: &Layout,
        (ways, states, overall): (&mut Ways, &mut States, &Overall),
        (values, first): (&[f64], u64),
        course: &Course,
        watch: &Watch<'_>,
    ) {
        let places = self.places(layout);
        let compiled = self.compiled.as_ref();
        let motion = || self.system.steps(self.grid, compiled).ok();
        let (width, state, length) = (layout.width(), layout.state(), states.length());
        let advance = |motion: &mut Option<Motion<'_>>, (row, ((ways, block), rows)): Piece<'_>| {
            let Some(motion) = motion else { return };
            let own = || rows.chunks(width).map(|row| &row[state..]);
            let parameters: Vec<Vec<f64>> =
                own().map(|own| self.parameters(&places, own)).collect();
            let folded = compiled.map(|own| own.fold_rows(self.grid.step, &parameters));
            let mut folded = folded.unwrap_or_default().into_iter();
            let lanes = ways.iter_mut().zip(own()).zip(&parameters).enumerate();
            for (lane, ((way, own), parameters)) in lanes {
                let folded = folded.next().transpose();
                if way.is_some() {
                    continue;
                }
                match folded {
                    Ok(folded) => {
                        let mut follow = |motion: &Motion<'_>| {
                            let march = March { motion, stop: watch.stop, overall };
                            let mut state = march.state(block, lane);
                            march.follow(way, &mut state, course);
                            into_lane(block, lane, state.parts());
                        };
                        if self.disturbed.is_empty() {
                            motion.vary(parameters, folded);
                            follow(motion);
                        } else {
                            let row = (row + lane, &rows[lane * width..][..layout.shape.dim]);
                            let made = self.with_inputs(row, parameters, course, follow);
                            stop(way, made.err().map(|why| (0, why)));
                        }
                    }
                    Err(error) => {
                        let values = layout.parameters.iter().zip(own);
                        let values: Vec<String> =
                            values.map(|(name, x)| format!("{name} = {}", shortest(*x))).collect();
                        let why = format!("with {}: {error}", values.join(", "));
                        stop(way, Some((0, why)));
                    }
                }
            }
        };
        let (count, mut made) = (ways.len() as u64, 0);
        let first = first.saturating_sub(1) as usize;
        let blocks = states.blocks_mut().chunks_mut(ROWS / WIDTH * length);
        for ((ways, blocks), values) in
            ways.chunks_mut(ROWS).zip(blocks).zip(values.chunks(ROWS * width))
        {
            let before = first + made as usize;
            made += ways.len() as u64;
            let pieces = ways.par_chunks_mut(WIDTH).zip(blocks.par_chunks_mut(length));
            let pieces = pieces.zip(values.par_chunks(WIDTH * width)).enumerate();
            let pieces = pieces.map(|(piece, own)| (before + piece * WIDTH, own));
            pieces.for_each_init(motion, advance);
            // As many steps as all rows had made if they had gone together.
            (watch.made)(course.steps * made / count);
        }
    }
}

/// Some rows: the number of the first one, from 0, what is known of each, their states, and their values.
type Piece<'a> = (usize, ((&'a mut Ways, &'a mut [f64]), &'a [f64]));

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
