//! The steps of a run, one after the other: measured, recorded, and kept for a restart.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};

use coadjoint::{Phase, StepError};
use nalgebra::DVector;

use super::checkpoint::{Checkpoint, bits, numbers};
use super::element::split;
use super::interrupt::Guard;
use super::names::columns;
use super::number::maximum;
use super::samples::Samples;
use super::schedule::Schedule;
use super::sink::Sink;
use super::subject::Subject;
use super::target::Target;
use super::trajectory::{Moment, Recorder, Trajectory};
use super::warning::Warning;
use crate::engine::Numbers;
use crate::engine::Restore;
use crate::error::CliError;
use crate::progress;

/// How steps of the grid went.
#[derive(Clone, Copy, Debug, Default)]
pub struct Made {
    /// The most iterations and the largest residual of a solve, where there was one.
    pub solve: Option<(u32, f64)>,
}

impl Made {
    /// The worse of both in everything.
    fn worse(&mut self, other: Self) {
        self.solve = match (self.solve, other.solve) {
            (Some((a, b)), Some((c, d))) => Some((a.max(c), maximum(b, d))),
            (a, b) => a.or(b),
        };
    }
}

/// Steps of the grid, so many after the first so many. Where one is refused: how many were made, and why.
type GridSteps<'s, G> = dyn Fn(u64, &mut Phase<G>, u64) -> Result<Made, (u64, StepError)> + 's;

/// Steps made one by one, by what makes a single one from the time given.
pub fn each<'s, G: Restore>(
    schedule: &'s Schedule,
    step: impl Fn(f64, &mut Phase<G>) -> Result<Made, StepError> + 's,
) -> impl Fn(u64, &mut Phase<G>, u64) -> Result<Made, (u64, StepError)> + 's {
    move |first, phase, count| {
        let mut total = Made::default();
        for done in 0..count {
            let made = step(schedule.time(first + done), phase).map_err(|error| (done, error))?;
            total.worse(made);
        }
        Ok(total)
    }
}

/// A step of another length, from the time given: (time, length, state).
type SideStep<'s, G> = dyn Fn(f64, f64, &mut Phase<G>) -> Result<(), StepError> + 's;

/// The drift is looked at so often in a run of which no records are kept.
const LOOKS: u64 = 10_000;

/// How many steps are made at a time: few enough to come back every ten milliseconds.
struct Pace(u64);

impl Default for Pace {
    fn default() -> Self {
        Self(16)
    }
}

impl Pace {
    fn steps(&self) -> u64 {
        self.0
    }

    /// So many steps took so long.
    fn took(&mut self, steps: u64, time: Duration) {
        const GOAL: f64 = 0.005;
        let each = time.as_secs_f64().max(1e-9) / steps.max(1) as f64;
        // At most twice as many as before: the first may have been cheap.
        self.0 = ((GOAL / each) as u64).clamp(1, self.0.saturating_mul(2));
    }
}

/// What makes steps on a group.
pub struct Stepper<'s, G: Restore> {
    /// Makes steps of the grid. The state that comes back does not depend on how many are made at a time.
    pub steps: &'s GridSteps<'s, G>,
    /// Makes a step of another length.
    pub side: &'s SideStep<'s, G>,
    /// The ratio of the last two terms of the series at a momentum, where it may be worth a warning; else 0.
    pub ratio: &'s dyn Fn(&G::Vector) -> f64,
    /// What the steps keep beside the state, where they keep anything: read for a checkpoint, and put back.
    pub kept: Option<&'s RefCell<Option<Numbers>>>,
}

/// A run on a group.
pub struct March<'a, G> {
    /// What is run.
    pub subject: &'a Subject<'a>,
    /// The group.
    pub group: &'a G,
}

/// What changes along a run.
struct State<'a, G: Restore> {
    /// Steps made.
    n: u64,
    phase: Phase<G>,
    moment: Moment,
    recorder: Recorder<'a, G>,
    sink: Option<Sink>,
    /// Times of `--at` recorded.
    times: usize,
    /// When the last checkpoint was written.
    saved: Instant,
    /// Whether a checkpoint says that all is done.
    complete: bool,
}

impl<'a, G: Restore> March<'a, G> {
    /// Makes the steps that are left.
    pub fn run(&self, stepper: &Stepper<'_, G>) -> Result<Trajectory, CliError> {
        let subject = self.subject;
        let schedule = &subject.setup.schedule;
        let mut state = self.begin(stepper)?;
        let outcome = self.go(&mut state, stepper);
        let target = subject.setup.out.as_ref();
        let rows = match (outcome, state.sink.take()) {
            (Ok(()), None) => None,
            (Ok(()), Some(sink)) => {
                let rows = sink.rows();
                // After an earlier end the name may have been given already.
                let named = state.complete && target.is_some_and(|t| !t.part().exists());
                if !named {
                    sink.publish()?;
                }
                Some(rows)
            }
            (Err(error), None) => return Err(error),
            (Err(error), Some(sink)) => {
                sink.stop(&error.to_string());
                if let Some(target) = target {
                    let part = target.part();
                    if part.is_file() {
                        eprintln!("the records up to there are in {}", part.display());
                    }
                }
                return Err(error);
            }
        };
        let end = (schedule.steps, schedule.end);
        let State { recorder, phase, moment, .. } = state;
        let (label, header) = (subject.label.clone(), subject.header.clone());
        let mut trajectory = recorder.finish(label, header, end, &phase, &moment);
        trajectory.truncation = subject.truncation;
        trajectory.warnings.splice(0..0, subject.warnings.iter().cloned());
        trajectory.announcement = schedule.announcement();
        trajectory.out = target.zip(rows).map(|(target, rows)| (target.path.clone(), rows));
        Ok(trajectory)
    }

    /// The state at the start, or where a checkpoint was made.
    fn begin(&self, stepper: &Stepper<'_, G>) -> Result<State<'a, G>, CliError> {
        let (subject, group) = (self.subject, self.group);
        let setup = subject.setup;
        let start = Phase::<G>::new(setup.element(group)?, setup.momentum.clone());
        let mut recorder = Recorder::new(group, subject.watched, &start, setup.sampled);
        let found = match &setup.checkpoint {
            Some((path, _)) => Checkpoint::read(path, &self.identity())?.map(|found| (path, found)),
            None => None,
        };
        let saved = Instant::now();
        let Some((path, found)) = found else {
            let moment = recorder.visit(&start).map_err(|what| self.stuck(0, what))?;
            recorder.sample(0.0, &start, &moment);
            let header = || subject.header.clone();
            let begin = |target| Sink::begin(target, header(), self.names(&recorder));
            let sink = setup.out.as_ref().map(begin).transpose()?;
            let phase = start;
            let state =
                State { n: 0, phase, moment, recorder, sink, times: 0, saved, complete: false };
            return Ok(state);
        };
        let momentum = numbers(&found.momentum);
        let entries = numbers(&found.element);
        let expected: usize = recorder.blocks().iter().map(|b| b.range.len().pow(2)).sum();
        let samples = Samples::from_bits(momentum.len(), &found.samples);
        let fits = momentum.len() == setup.momentum.len()
            && entries.len() == expected
            && found.step <= setup.schedule.steps
            && samples.is_some() == setup.sampled;
        if !fits {
            return Err(CliError::Option(format!(
                "{} does not hold a state of this system: remove it to begin anew",
                path.display()
            )));
        }
        let mut g = nalgebra::DMatrix::zeros(group.matrix_size(), group.matrix_size());
        for (block, own) in split(recorder.blocks(), &entries) {
            let rows = block.range.len();
            for (place, value) in own.iter().enumerate() {
                g[(block.range.start + place / rows, block.range.start + place % rows)] = *value;
            }
        }
        let element = group.restore(&|i, j| g[(i, j)]);
        let phase = Phase::<G>::new(element, DVector::from_vec(momentum));
        if let (Some(kept), Some(own)) = (stepper.kept, &found.own) {
            *kept.borrow_mut() = Some(Numbers { g: numbers(own), mu: numbers(&found.momentum) });
        }
        let moment = recorder.measure(&phase).map_err(|what| self.stuck(found.step, what))?;
        let extent = found.extent();
        let resume = |target: &Target| {
            if found.complete && !target.part().exists() && target.path.exists() {
                return Ok(Sink::done(target, extent));
            }
            Sink::resume(target, subject.header.clone(), self.names(&recorder), extent)
        };
        let sink = setup.out.as_ref().map(resume).transpose()?;
        if found.complete {
            eprintln!(
                "this run has finished; its report is made from {}: remove it to run anew",
                path.display()
            );
        } else {
            let steps = setup.schedule.steps;
            eprintln!("going on from {} at step {} of {steps}", path.display(), found.step);
        }
        recorder.tally = found.tally();
        recorder.samples = samples;
        let (n, times, complete) = (found.step, found.times, found.complete);
        Ok(State { n, phase, moment, recorder, sink, times, saved, complete })
    }

    fn go(&self, state: &mut State<'a, G>, stepper: &Stepper<'_, G>) -> Result<(), CliError> {
        let setup = self.subject.setup;
        let schedule = &setup.schedule;
        if state.complete {
            return Ok(());
        }
        let guard = Guard::new();
        let bar = progress::bar(schedule.steps, "integrating");
        if state.n == 0 {
            self.record(state, stepper)?;
        }
        let mut shown = Instant::now();
        let mut pace = Pace::default();
        while state.n < schedule.steps {
            if let Some(warning) = self.steps(state, stepper, &mut pace)? {
                bar.suspend(|| eprintln!("warning: {}", warning.text()));
            }
            self.record(state, stepper)?;
            if shown.elapsed() >= progress::INTERVAL {
                bar.set_position(state.n);
                shown = Instant::now();
            }
            if let Some(sink) = &mut state.sink {
                sink.tick()?;
                if sink.closed() && !setup.sampled {
                    let what = "nobody reads the records any more".to_owned();
                    return Err(self.stuck(state.n, what));
                }
            }
            let stop = guard.asked() && state.n < schedule.steps;
            match &setup.checkpoint {
                Some((path, interval)) if stop || state.saved.elapsed() >= *interval => {
                    self.save(path, state, stepper)?;
                }
                _ => {}
            }
            if stop {
                bar.finish_and_clear();
                return Err(self.interrupted(state.n));
            }
        }
        bar.finish_and_clear();
        if let Some(sink) = &mut state.sink {
            sink.complete()?;
        }
        if let Some((path, _)) = &setup.checkpoint {
            self.save(path, state, stepper)?;
        }
        Ok(())
    }

    /// Makes steps of the grid, up to the next look at them; what there is to be said of them.
    fn steps(
        &self,
        state: &mut State<'a, G>,
        stepper: &Stepper<'_, G>,
        pace: &mut Pace,
    ) -> Result<Option<Warning>, CliError> {
        let schedule = &self.subject.setup.schedule;
        let (first, next) = (state.n, self.next_look(state));
        let count = (next - first).min(pace.steps());
        let ratio = if self.watched(first) { (stepper.ratio)(&state.phase.momentum) } else { 0.0 };
        let begun = Instant::now();
        let made = (stepper.steps)(first, &mut state.phase, count);
        let made = made.map_err(|(done, source)| CliError::Run {
            time: schedule.time(first + done),
            step: first + done + 1,
            what: source.to_string(),
        })?;
        pace.took(count, begun.elapsed());
        let n = first + count;
        state.n = n;
        if let Some((iterations, residual)) = made.solve {
            let noted = state.recorder.solved(iterations, residual);
            noted.map_err(|what| self.stuck(n, what))?;
        }
        let warning = state.recorder.steep(first + 1, schedule.time(first), ratio);
        // Times of `--at` change no report of the drift.
        if self.watched(n) {
            let moment = state.recorder.visit(&state.phase).map_err(|what| self.stuck(n, what))?;
            state.moment = moment;
        } else if n == next {
            let moment =
                state.recorder.measure(&state.phase).map_err(|what| self.stuck(n, what))?;
            state.moment = moment;
        }
        Ok(warning)
    }

    /// Every so many steps the drift is looked at: at each record, or, where none are kept, at [`LOOKS`] moments.
    fn interval(&self) -> u64 {
        let setup = self.subject.setup;
        let every = setup.every.unwrap_or(1);
        match (&setup.out, setup.every) {
            (Some(_), Some(_)) => every,
            _ => every * setup.schedule.steps.div_ceil(every.saturating_mul(LOOKS)).max(1),
        }
    }

    /// Whether the drift is looked at after so many steps.
    fn watched(&self, n: u64) -> bool {
        n == self.subject.setup.schedule.steps || n.is_multiple_of(self.interval())
    }

    /// The next grid point at which the drift is looked at, or something is recorded.
    fn next_look(&self, state: &State<'a, G>) -> u64 {
        let setup = self.subject.setup;
        let (n, end) = (state.n, setup.schedule.steps);
        let mut next = (n / self.interval() + 1).saturating_mul(self.interval()).min(end);
        let times = setup.at.as_ref().map_or(&[][..], |times| &times.0);
        if let Some(time) = times.get(state.times) {
            let nearest = (time / setup.schedule.step).round().min(end as f64) as u64;
            next = next.min(nearest.max(n + 1));
        }
        next
    }

    /// Writes the records at this grid point, and at the times nearer to it than to others.
    fn record(&self, state: &mut State<'a, G>, stepper: &Stepper<'_, G>) -> Result<(), CliError> {
        let setup = self.subject.setup;
        let (schedule, n) = (&setup.schedule, state.n);
        let here = schedule.time(n);
        let chosen =
            setup.every.is_some_and(|every| n.is_multiple_of(every) || n == schedule.steps);
        // Pictures show moments at which the drift is looked at.
        if n > 0 && self.watched(n) {
            state.recorder.sample(here, &state.phase, &state.moment);
        }
        if state.sink.is_none() {
            return Ok(());
        }
        let mut own = chosen.then_some(here);
        let times = setup.at.as_ref().map_or(&[][..], |times| &times.0);
        while let Some(&time) = times.get(state.times) {
            let nearest = (time / schedule.step).round().min(schedule.steps as f64);
            if nearest as u64 > n {
                break;
            }
            let part = time - here;
            let rounding = 4.0 * f64::EPSILON * time.abs().max(schedule.step.abs());
            if part.abs() <= rounding {
                own = Some(time);
            } else {
                if part * schedule.step > 0.0
                    && let Some(time) = own.take()
                {
                    self.write(state, time, None)?;
                }
                let mut phase = state.phase.clone();
                (stepper.side)(here, part, &mut phase).map_err(|source| CliError::Run {
                    time: here,
                    step: n,
                    what: format!("the record at {time}: {source}"),
                })?;
                let moment = state.recorder.measure(&phase).map_err(|what| CliError::Run {
                    time,
                    step: n,
                    what,
                })?;
                self.write(state, time, Some((phase, moment)))?;
            }
            state.times += 1;
        }
        match own {
            Some(time) => self.write(state, time, None),
            None => Ok(()),
        }
    }

    /// Writes a record: of the state of the grid, or of one beside it.
    fn write(
        &self,
        state: &mut State<'a, G>,
        time: f64,
        beside: Option<(Phase<G>, Moment)>,
    ) -> Result<(), CliError> {
        let Some(sink) = &mut state.sink else { return Ok(()) };
        let (phase, moment) = match &beside {
            Some((phase, moment)) => (phase, moment),
            None => (&state.phase, &state.moment),
        };
        let Moment { energy, drift } = *moment;
        let (before, after) = (energy, energy.map(|_| drift.energy));
        let drifts = [drift.spatial_momentum, drift.casimirs];
        let last = before.into_iter().chain(drifts).chain(after);
        let momentum = phase.momentum.iter().copied();
        let written = self.subject.watched.attitude;
        let entries = written.then(|| state.recorder.entries(phase)).into_iter().flatten();
        sink.row(std::iter::once(time).chain(momentum).chain(entries).chain(last))
    }

    /// Writes a checkpoint; the records that it counts are on the disk before.
    fn save(
        &self,
        path: &Path,
        state: &mut State<'a, G>,
        stepper: &Stepper<'_, G>,
    ) -> Result<(), CliError> {
        let own = stepper.kept.and_then(|kept| kept.borrow().clone());
        let extent = state.sink.as_mut().map(Sink::vouch).transpose()?.unwrap_or_default();
        let mut checkpoint = Checkpoint {
            identity: self.identity(),
            step: state.n,
            momentum: bits(state.phase.momentum.iter().copied()),
            element: bits(state.recorder.entries(&state.phase)),
            own: own.map(|numbers| bits(numbers.g.iter().copied())),
            bytes: extent.bytes,
            rows: extent.rows,
            times: state.times,
            samples: state.recorder.samples.as_ref().map(Samples::to_bits).unwrap_or_default(),
            complete: state.n == self.subject.setup.schedule.steps,
            ..Checkpoint::default()
        };
        checkpoint.set_tally(&state.recorder.tally);
        checkpoint.write(path)?;
        state.saved = Instant::now();
        Ok(())
    }

    /// What a checkpoint must agree in.
    fn identity(&self) -> BTreeMap<String, String> {
        let setup = self.subject.setup;
        let mut identity = self.subject.header.identity();
        // It follows from the time and the step, whose names say more.
        identity.remove("steps");
        let out = setup.out.as_ref();
        let out = out.map_or_else(|| "none".to_owned(), |out| out.path.display().to_string());
        identity.insert("out".to_owned(), out);
        identity.insert("plot".to_owned(), setup.sampled.to_string());
        identity
    }

    /// A number that is not finite, after `step` steps.
    fn stuck(&self, step: u64, what: String) -> CliError {
        CliError::Run { time: self.subject.setup.schedule.time(step), step, what }
    }

    fn interrupted(&self, step: u64) -> CliError {
        let setup = self.subject.setup;
        let again = match &setup.checkpoint {
            Some((path, _)) => {
                format!("; the same command goes on from {}", path.display())
            }
            None => String::new(),
        };
        let schedule = &setup.schedule;
        CliError::Interrupted(format!(
            "interrupted at time {}, after {step} of {} steps{again}",
            schedule.time(step),
            schedule.steps
        ))
    }

    /// The names of the columns of records.
    fn names(&self, recorder: &Recorder<'_, G>) -> Vec<String> {
        let watched = &self.subject.watched;
        columns(watched.coordinates, recorder.recorded(), watched.energy.is_some())
    }
}
