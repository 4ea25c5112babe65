//! The derivatives of runs: forwards, backwards, over a period, and their growth.

mod ending;
#[cfg(test)]
mod tests;

use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_codegen::signal::{Gathered, Signal};
use nalgebra::{DMatrix, DVector};

use self::ending::{Ending, Slope};
use crate::engine::{Carried, Motion, Numbers, Read, Reading, Sense, Tangents};
use crate::error::RunError;
use crate::load::Derived;
use crate::simulate::{Event, Schedule, Setup};

/// The numbers of states that a backward run keeps, 64 MiB.
const MOST_KEPT: usize = 1 << 23;

/// The derivatives of a run of N steps.
///
/// A tangent to a state (g, μ) is the column (ξ, ν) of 2n numbers, ξ = g⁻¹δg in the basis of 𝔤 and ν = δμ; a cotangent is
/// the column (λ, κ) of the factors of ξ and ν. q is the number of parameters that the system keeps, in their order, each
/// flattened; the samples of an input are the values of its table. The steps are those of a run to rounding, and derivatives those of
/// the steps, not of the flow: without a velocity or a torque the tangent map is symplectic to rounding.
pub struct Derivatives<'a> {
    motion: Motion<'a>,
    /// The tangents of steps, where there are any.
    tangents: Option<Tangents>,
    signals: &'a [Signal],
    start: Numbers,
    schedule: Schedule,
    algebra: &'a LieAlgebra,
    /// The event that ends the run, which is then the state after one step more than the whole ones.
    ending: Option<Ending>,
    /// The numbers of states that a backward run keeps.
    room: usize,
}

/// k changes of what a run depends on.
#[derive(Clone, Debug)]
pub struct Changes {
    /// Tangents at the start, 2n×k.
    pub state: DMatrix<f64>,
    /// Changes of the parameters, q×k.
    pub parameters: DMatrix<f64>,
    /// Changes of the samples of each input, a row a sample; none where no input changes.
    pub inputs: Vec<DMatrix<f64>>,
}

/// The derivatives of k numbers that depend on a run.
#[derive(Clone, Debug)]
pub struct Adjoint {
    /// In the state at the start, 2n×k.
    pub state: DMatrix<f64>,
    /// In the parameters, q×k.
    pub parameters: DMatrix<f64>,
    /// In the samples of each input, a row a sample; no rows of one that is a function.
    pub inputs: Vec<DMatrix<f64>>,
    /// The most states that were kept at a time: all, or about 2√N.
    pub kept: usize,
}

impl<'a> Derivatives<'a> {
    /// Of the run of a system with these settings, of which records, events and times are not looked at.
    ///
    /// # Errors
    /// Settings that make no sense.
    pub fn new(system: &'a Derived, setup: &Setup) -> Result<Self, RunError> {
        let (_, motion, start) = system.begin(setup)?;
        let schedule = setup.schedule;
        let tangents = motion.tangents(setup.backend, schedule.steps as f64);
        let tangents = tangents.map_err(RunError::unmade)?;
        let (signals, algebra, ending) = (system.signals(), system.facts().algebra, None);
        let room = MOST_KEPT;
        Ok(Self { motion, tangents, signals, start, schedule, algebra, ending, room })
    }

    /// Of the run that this event ends at this time, within the step after those of the settings. The number of steps there is one
    /// more than theirs, and tangents and cotangents have one row more, of the event's time: the others are of the state where the event
    /// occurs. Of the event's function and of the motion there differences are taken.
    pub fn until(mut self, event: Event, time: f64) -> Self {
        self.ending = Some(Ending { event, time });
        self
    }

    /// The number of the last state.
    fn last(&self) -> u64 {
        self.schedule.steps + u64::from(self.ending.is_some())
    }

    /// True if the step after `done` is that up to the event.
    fn ends(&self, done: u64) -> bool {
        self.ending.is_some() && done == self.schedule.steps
    }

    /// The rows of a tangent after this number of steps.
    pub fn rows(&self, at: u64) -> usize {
        2 * self.dim() + usize::from(at > self.schedule.steps)
    }

    /// When the parts of the step after `done` begin, and their sizes.
    fn parts_of(&self, done: u64) -> Vec<[f64; 2]> {
        let from = self.schedule.time(done);
        match self.ending.as_ref().filter(|_| self.ends(done)) {
            Some(Ending { time, .. }) if *time == from => Vec::new(),
            Some(Ending { time, .. }) => self.motion.parts_of([from, time - from]),
            None => self.motion.parts(done),
        }
    }

    /// The event to first order at the state where it occurs.
    fn slope(&self, ending: &Ending, state: &Numbers) -> Result<Slope, RunError> {
        ending.slope(&self.motion, self.algebra, state).map_err(RunError::Option)
    }

    /// # Errors
    /// Fails where derivatives are not known.
    fn known(&self) -> Result<&Tangents, RunError> {
        let what = "no derivatives are known of learned maps, of functions of the user's, and of systems too large for programs";
        self.tangents.as_ref().ok_or_else(|| RunError::Option(what.to_owned()))
    }

    /// The inputs of the system.
    pub fn signals(&self) -> &'a [Signal] {
        self.signals
    }

    /// n, the dimension of the group.
    pub fn dim(&self) -> usize {
        self.start.mu.len()
    }

    /// q, the number of parameters.
    pub fn parameters(&self) -> usize {
        self.tangents.as_ref().map_or(0, |own| own.parameters)
    }

    /// The error of a step after `done` steps.
    fn failed(&self, done: u64, error: &coadjoint::StepError) -> RunError {
        let time = self.schedule.time(done);
        RunError::Run { time, step: done + 1, what: error.to_string() }
    }

    /// Makes `count` steps after `done`.
    fn advance(&self, state: &mut Numbers, done: u64, count: u64) -> Result<(), RunError> {
        let made = self.motion.advance(state, done, count);
        made.map(drop).map_err(|(more, error)| self.failed(done + more, &error))
    }

    /// The error of a step, after `done` others, that has no derivative.
    fn too_long(&self, done: u64) -> RunError {
        let what = "this step is too long for its derivative: take smaller steps".to_owned();
        RunError::Run { time: self.schedule.time(done), step: done + 1, what }
    }

    /// Makes `count` steps after `done` of a state with tangents.
    fn carry(
        &self,
        carried: &mut Carried<'_>,
        [done, count]: [u64; 2],
        changes: Option<&Reading<'_>>,
    ) -> Result<(), RunError> {
        let whole = count.min(self.schedule.steps.saturating_sub(done));
        let made = self.motion.carry(carried, [done, whole], changes);
        let made = made.map_err(|(more, error)| self.failed(done + more, &error))?;
        if made < whole {
            return Err(self.too_long(done + made));
        }
        let parts = if whole < count { self.parts_of(done + whole) } else { Vec::new() };
        for part in parts {
            let failed = |error| self.failed(done + whole, &error);
            if let Some(changes) = changes {
                carried.reading(&changes(&self.motion.read(part).map_err(failed)?));
            }
            if !self.motion.carry_part(carried, part).map_err(failed)? {
                return Err(self.too_long(done + whole));
            }
        }
        self.finite(done + count, [&carried.columns])
    }

    /// These tangents, 2n×k, with these changes of the parameters, q×k, at the start.
    fn begin(
        &self,
        tangents: &DMatrix<f64>,
        parameters: &DMatrix<f64>,
    ) -> Result<Carried<'_>, RunError> {
        let (own, two_n, k) = (self.known()?, 2 * self.dim(), tangents.ncols());
        let mut columns = DMatrix::zeros(two_n + own.parameters + own.reads, k);
        columns.rows_mut(0, two_n).copy_from(tangents);
        columns.rows_mut(two_n, own.parameters).copy_from(parameters);
        self.forward_from(self.start.clone(), columns)
    }

    /// These tangents with this state.
    fn forward_from(&self, state: Numbers, columns: DMatrix<f64>) -> Result<Carried<'_>, RunError> {
        let carried = self.known()?.carry(Sense::Forward, state, columns)?;
        // There are steps with tangents wherever there are tangents.
        carried.ok_or_else(|| self.too_long(0))
    }

    /// # Errors
    /// Fails if a number is not finite after `done` steps.
    fn finite<'m>(
        &self,
        done: u64,
        numbers: impl IntoIterator<Item = &'m DMatrix<f64>>,
    ) -> Result<(), RunError> {
        if numbers.into_iter().flatten().all(|number| number.is_finite()) {
            return Ok(());
        }
        let what = "a derivative is not finite: take a shorter run".to_owned();
        Err(RunError::Run { time: self.schedule.time(done), step: done + 1, what })
    }

    /// # Errors
    /// Fails if numbers of steps do not ascend, or the last is not in the run.
    fn ascending(&self, at: impl Iterator<Item = u64> + Clone) -> Result<(), RunError> {
        let in_run = at.clone().all(|step| step <= self.last());
        if in_run && at.clone().zip(at.skip(1)).all(|(a, b)| a < b) {
            return Ok(());
        }
        let what = format!("numbers of steps must ascend from 0 to {}", self.last());
        Err(RunError::Option(what))
    }

    /// The tangents (2n×k) after these numbers of steps, which ascend, of k changes.
    ///
    /// # Errors
    /// Fails if the shapes do not fit, and why the run stopped.
    pub fn forward(&self, changes: &Changes, at: &[u64]) -> Result<Vec<DMatrix<f64>>, RunError> {
        let Changes { state, parameters, inputs } = changes;
        let (n, q, k) = (self.dim(), self.known()?.parameters, state.ncols());
        if state.nrows() != 2 * n || parameters.shape() != (q, k) {
            return Err(RunError::Option(format!(
                "{k} tangents are {}×{k} numbers of the state and {q}×{k} of the parameters",
                2 * n
            )));
        }
        let samples = |signal: &Signal| signal.table()[0].len();
        let fits = |(own, signal): (&DMatrix<f64>, &Signal)| own.shape() == (samples(signal), k);
        let all = inputs.is_empty() || inputs.len() == self.signals.len();
        if !all || !inputs.iter().zip(self.signals).all(fits) {
            let rows = self.signals.iter().map(|signal| format!("{}×{k}", samples(signal)));
            let rows = rows.collect::<Vec<_>>().join(", ");
            let what = format!("changes of the samples of the inputs are {rows} numbers");
            return Err(RunError::Option(what));
        }
        let changed = |(signal, own): (&Signal, &DMatrix<f64>)| -> Vec<Signal> {
            let columns = own.column_iter().filter(|_| own.nrows() > 0);
            columns
                .map(|column| signal.with_values(&column.iter().copied().collect::<Vec<_>>()))
                .collect()
        };
        let changed: Vec<_> = self.signals.iter().zip(inputs).map(changed).collect();
        self.ascending(at.iter().copied())?;
        let read = |read: &[Read]| {
            DMatrix::from_fn(read.len(), k, |row, column| {
                let Read { input, time } = read[row];
                changed[input].get(column).map_or(0.0, |signal| signal.at(time))
            })
        };
        let changes: Option<&Reading<'_>> = if changed.is_empty() { None } else { Some(&read) };
        let (mut carried, mut done) = (self.begin(state, parameters)?, 0);
        let mut found = Vec::new();
        for &at in at {
            self.carry(&mut carried, [done, at - done], changes)?;
            let fixed = carried.tangents().into_owned();
            found.push(match self.ending.as_ref().filter(|_| at == self.last()) {
                None => fixed,
                Some(ending) => {
                    let slope = self.slope(ending, &carried.state)?;
                    let times = slope.times(&fixed);
                    let mut moved = (fixed + &slope.motion * &times).insert_row(2 * n, 0.0);
                    moved.row_mut(2 * n).copy_from(&times);
                    moved
                }
            });
            done = at;
        }
        Ok(found)
    }

    /// The parts of the step after `done` from this state, with the states before them.
    fn parts(&self, done: u64, mut state: Numbers) -> Result<Vec<([f64; 2], Numbers)>, RunError> {
        let mut found = Vec::new();
        let parts = self.parts_of(done);
        for (number, &part) in parts.iter().enumerate() {
            found.push((part, state.clone()));
            if number + 1 < parts.len() {
                let made = self.motion.part(&mut state, part);
                made.map_err(|error| self.failed(done, &error))?;
            }
        }
        Ok(found)
    }

    /// Takes the cotangents, and the sums of derivatives in the parameters below them, from after the step after `done`, or a part of it, to
    /// the state before it: by the transpose of the step or, where it has none, by its derivative. Returns the derivatives in the values of inputs
    /// that it reads.
    fn back(
        &self,
        carried: &mut Carried<'_>,
        (done, part): (u64, Option<[f64; 2]>),
        state: Numbers,
        columns: &mut DMatrix<f64>,
    ) -> Result<DMatrix<f64>, RunError> {
        let rows = columns.nrows();
        carried.state = state;
        carried.columns = match carried.sense {
            Sense::Backward => columns.clone(),
            Sense::Forward => DMatrix::identity(rows, rows),
        };
        let made = match part {
            None => self.motion.carry(carried, [done, 1], None).map_err(|(_, error)| error),
            Some(part) => self.motion.carry_part(carried, part).map(u64::from),
        };
        if made.map_err(|error| self.failed(done, &error))? == 0 {
            return Err(self.too_long(done));
        }
        self.finite(done, [&carried.columns])?;
        let (two_n, q) = (2 * self.dim(), self.parameters());
        if carried.sense == Sense::Backward {
            columns.copy_from(&carried.columns);
        } else {
            let weights = carried.tangents().tr_mul(&columns.rows(0, two_n));
            columns.rows_mut(0, two_n).copy_from(&weights.rows(0, two_n));
            let mut others = columns.rows_range_mut(two_n..);
            others += weights.rows_range(two_n..);
        }
        let mut own = columns.rows_range_mut(two_n + q..);
        let read = own.clone_owned();
        own.fill(0.0);
        Ok(read)
    }

    /// The cotangent, at a fixed time, of what has this one where the event occurs, from the state after all whole steps.
    fn at_fixed_time(
        &self,
        ending: &Ending,
        state: &Numbers,
        own: &DMatrix<f64>,
    ) -> Result<DMatrix<f64>, RunError> {
        let (two_n, done) = (2 * self.dim(), self.schedule.steps);
        let mut state = state.clone();
        for part in self.parts_of(done) {
            let made = self.motion.part(&mut state, part);
            made.map_err(|error| self.failed(done, &error))?;
        }
        let slope = self.slope(ending, &state)?;
        let fixed = own.rows(0, two_n);
        // The derivatives in the event's time.
        let times = slope.motion.transpose() * fixed + own.row(two_n);
        Ok(fixed - &slope.function * (times / slope.rate))
    }

    /// The adjoint: the derivatives, in the start, in the parameters and in the samples of inputs, of k sums over the run, given as cotangents (2n×k)
    /// of the states after these numbers of steps, which ascend.
    ///
    /// All states are kept where they take no more than 64 MiB. In longer runs every ⌊√N⌋th is, and those between two of them while they are
    /// gone through: steps are made twice.
    ///
    /// # Errors
    /// Fails if the shapes do not fit, and why the run stopped.
    pub fn backward(&self, cotangents: &[(u64, DMatrix<f64>)]) -> Result<Adjoint, RunError> {
        let tangents = self.known()?;
        let (q, reads) = (tangents.parameters, tangents.reads);
        let (n, count) = (self.dim(), cotangents.last().map_or(0, |&(last, _)| last));
        let k = cotangents.first().map_or(0, |(_, first)| first.ncols());
        if cotangents.iter().any(|(at, own)| own.shape() != (self.rows(*at), k)) {
            let what = format!(
                "cotangents are {}×{k} numbers each, of an event that ends the run {}×{k}",
                2 * n,
                2 * n + 1
            );
            return Err(RunError::Option(what));
        }
        self.ascending(cotangents.iter().map(|&(step, _)| step))?;
        let mut state = self.start.clone();
        let fits = count as usize * (state.g.len() + state.mu.len()) <= self.room;
        let stretch = if fits { 1 } else { count.isqrt().max(1) };
        let mut checkpoints = Vec::new();
        for first in (0..count).step_by(stretch as usize) {
            checkpoints.push(state.clone());
            if first + stretch < count {
                self.advance(&mut state, first, stretch)?;
            }
        }
        let (mut left, mut kept) = (cotangents.iter().rev().peekable(), 0);
        let gathered = |signal| (0..k).map(|_| Gathered::new(signal)).collect::<Vec<_>>();
        let mut inputs: Vec<_> = self.signals.iter().map(gathered).collect();
        let mut columns = DMatrix::zeros(2 * n + q + reads, k);
        let backward = tangents.carry(Sense::Backward, self.start.clone(), columns.clone())?;
        let mut carried = backward.map_or_else(
            || {
                let unit = DMatrix::identity(columns.nrows(), columns.nrows());
                self.forward_from(self.start.clone(), unit)
            },
            Ok,
        )?;
        while let Some(mut state) = checkpoints.pop() {
            let first = checkpoints.len() as u64 * stretch;
            let last = count.min(first + stretch);
            let mut states = Vec::new();
            for done in first..last {
                states.push(state.clone());
                if done + 1 < last {
                    self.advance(&mut state, done, 1)?;
                }
            }
            kept = kept.max(checkpoints.len() + states.len());
            for (number, state) in states.into_iter().enumerate().rev() {
                let done = first + number as u64;
                if let Some((_, own)) = left.next_if(|(step, _)| *step == done + 1) {
                    let mut now = columns.rows_mut(0, 2 * n);
                    match self.ending.as_ref().filter(|_| self.ends(done)) {
                        None => now += own,
                        Some(ending) => now += self.at_fixed_time(ending, &state, own)?,
                    }
                }
                let parts = self.parts(done, state)?;
                let divided = parts.len() > 1 || self.ends(done);
                for (part, state) in parts.into_iter().rev() {
                    let own = (done, divided.then_some(part));
                    let weights = self.back(&mut carried, own, state, &mut columns)?;
                    if reads == 0 {
                        continue;
                    }
                    let read = self.motion.read(part).map_err(|error| self.failed(done, &error))?;
                    for (&Read { input, time }, row) in read.iter().zip(weights.row_iter()) {
                        inputs[input].iter_mut().zip(&row).for_each(|(own, &w)| own.add(time, w));
                    }
                }
            }
        }
        if let Some((_, own)) = left.next() {
            let mut now = columns.rows_mut(0, 2 * n);
            now += own;
        }
        let now = columns.rows(0, 2 * n).into_owned();
        let parameters = columns.rows(2 * n, q).into_owned();
        let derivatives = |own: Vec<Gathered<'_>>| {
            let columns: Vec<_> =
                own.into_iter().map(|own| DVector::from_vec(own.derivatives())).collect();
            if columns.is_empty() { DMatrix::zeros(0, k) } else { DMatrix::from_columns(&columns) }
        };
        let inputs: Vec<_> = inputs.into_iter().map(derivatives).collect();
        self.finite(0, [&now, &parameters].into_iter().chain(&inputs))?;
        Ok(Adjoint { state: now, parameters, inputs, kept })
    }

    /// The monodromy matrix (2n×2n): the derivative of the state after all whole steps in that at the start. Along a periodic or
    /// relatively periodic motion its eigenvalues are the Floquet multipliers.
    ///
    /// # Errors
    /// Returns the reason for which the run stopped.
    pub fn monodromy(&self) -> Result<DMatrix<f64>, RunError> {
        let n = 2 * self.dim();
        let (state, parameters) = (DMatrix::identity(n, n), DMatrix::zeros(self.parameters(), n));
        let changes = Changes { state, parameters, inputs: Vec::new() };
        let found = self.forward(&changes, &[self.schedule.steps])?;
        Ok(found.into_iter().next().unwrap_or_default())
    }

    /// The largest Lyapunov exponent, in 1/time: the mean growth of a tangent, whose length becomes one after each step,
    /// without the first `transient` steps, in which it turns into the direction that grows most (Benettin, Galgani,
    /// Giorgilli, Strelcyn, *Meccanica* 15 (1980) 9–30). It converges as the logarithm of the time over the time.
    ///
    /// # Errors
    /// Fails if no steps are left, and why the run stopped.
    pub fn largest_exponent(&self, transient: u64) -> Result<f64, RunError> {
        let Schedule { steps, step, .. } = self.schedule;
        if transient >= steps {
            let what = format!("a transient of {transient} steps leaves none of {steps}");
            return Err(RunError::Option(what));
        }
        // A direction without symmetry, so that it has a part in every other.
        let mut now =
            DVector::from_fn(2 * self.dim(), |i, _| 1.0 + (1.0 + i as f64).sqrt().fract());
        now /= now.norm();
        let parameters = DMatrix::zeros(self.parameters(), 1);
        let mut carried =
            self.begin(&DMatrix::from_column_slice(now.len(), 1, now.as_slice()), &parameters)?;
        let mut growth = 0.0;
        for done in 0..steps {
            self.carry(&mut carried, [done, 1], None)?;
            let length = carried.tangents().norm();
            carried.columns /= length;
            if done >= transient {
                growth += length.ln();
            }
        }
        Ok(growth / ((steps - transient) as f64 * step.abs()))
    }
}
