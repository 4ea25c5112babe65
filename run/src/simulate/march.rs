//! The steps of a run: they are made one after the other, measured, and passed to the sink.

use std::time::{Duration, Instant};

use coadjoint_program::WIDTH;

use super::event::{self, Crossing, Lookout};
use super::milestone::{Milestone, part};
use super::orbit::Orbit;
use super::recorder::{Outcome, Recorder, Watched, drifting};
use super::setup::Setup;
use super::sink::{Record, Resume, Sink};
use super::tally::{Measured, Warning};
use crate::engine::{Motion, Numbers};
use crate::error::RunError;

/// The number of moments at which the drift is measured in a run of which no records are kept.
const LOOKS: u64 = 10_000;

/// The number of states that are measured side by side, each with one beside it.
const BESIDE: usize = WIDTH / 2;

/// The longest time that a state waits for others, if steps are fast.
const LONGEST: Duration = Duration::from_millis(5);

/// The number of steps made at a time: few enough to return every ten milliseconds.
pub(super) struct Pace(u64);

impl Pace {
    /// At the beginning.
    pub(super) fn new() -> Self {
        Self(16)
    }

    /// The number of steps to be made now.
    pub(super) fn steps(&self) -> u64 {
        self.0
    }

    /// Records the time of some steps.
    pub(super) fn took(&mut self, steps: u64, time: Duration) {
        const GOAL: f64 = 0.005;
        let each = time.as_secs_f64().max(1e-9) / steps.max(1) as f64;
        // At most twice as many as before: the first may have been cheap.
        self.0 = ((GOAL / each) as u64).clamp(1, Orbit::EVERY.min(self.0.saturating_mul(2)));
    }
}

/// A run of a system, or of a learned map.
pub(crate) struct Subject<'a> {
    /// From where, how far, in which steps.
    pub setup: &'a Setup,
    /// The quantities that are watched.
    pub watched: Watched<'a>,
    /// Warnings before the first step.
    pub warnings: Vec<Warning>,
}

/// A run that is going on.
struct March<'a, 's> {
    setup: &'a Setup,
    motion: &'a Motion<'s>,
    state: Numbers,
    sink: &'a mut dyn Sink,
    recorder: Recorder<'a>,
    /// The orbit of the momentum, where the spatial momentum is conserved.
    orbit: Option<Orbit>,
    /// Steps made.
    n: u64,
    measured: Measured,
    /// Grid points whose states are still to be measured and recorded, and when the last ones were.
    waiting: Vec<(u64, Numbers)>,
    settled: Instant,
    /// The values and the [signs](event::signs) of the events' functions, and the events that occurred.
    values: Vec<f64>,
    signs: Vec<f64>,
    crossings: Vec<Crossing>,
    /// When an event ended the run.
    ended: Option<f64>,
    /// The number of requested times recorded so far.
    times: usize,
    /// The states kept for the estimate of the error.
    kept: Vec<Milestone>,
    part: u64,
    /// The number of steps between two measurements of the drift: at each record, or, where none are kept, at [`LOOKS`] moments.
    interval: u64,
}

impl Subject<'_> {
    /// Makes the steps from the start, or from where an earlier run has ended; also the state at the end, and those on the way
    /// that an estimate of the error looks at.
    ///
    /// # Errors
    /// Returns the reason for which the run stopped.
    pub(crate) fn run(
        self,
        motion: &Motion<'_>,
        start: &Numbers,
        sink: &mut dyn Sink,
    ) -> Result<(Outcome, Numbers, Vec<Milestone>), RunError> {
        let Self { setup, watched, warnings } = self;
        let state = start.clone();
        warnings.iter().for_each(|warning| sink.warn(&warning.text()));
        let time = setup.schedule.start;
        let mut recorder = Recorder::new(watched, time, motion.space(), &state);
        let orbit = recorder.orbit();
        let (found, wrong) = recorder.measure(motion.space(), &[(time, &state)], |_, _| Ok(()));
        let mut measured = found.into_iter().next().ok_or_else(|| {
            let what = wrong.unwrap_or_default();
            RunError::Run { time, step: 0, what }
        })?;
        recorder.count(time, &mut measured);
        let found = sink.begin(&recorder.begun());
        let found = found.map_err(|_| RunError::Halted { time, step: 0 })?;
        let every = setup.every.unwrap_or(1);
        let steps = setup.schedule.steps;
        let interval = match setup.every {
            Some(_) if setup.recording => every,
            _ => every * steps.div_ceil(every.saturating_mul(LOOKS)).max(1),
        };
        let (n, times, ended) = (0, 0, None);
        let (values, signs, crossings) = Default::default();
        let part = if setup.estimate { part(steps) } else { u64::MAX };
        let mut march = March {
            setup,
            motion,
            state,
            sink,
            recorder,
            orbit,
            n,
            measured,
            waiting: Vec::new(),
            settled: Instant::now(),
            values,
            signs,
            crossings,
            ended,
            times,
            kept: Vec::new(),
            part,
            interval,
        };
        march.values = march.lookout(0).values(time, &march.state).map_err(|w| march.stuck(w))?;
        march.signs = event::signs(None, &march.values);
        let at_start = march.values.clone();
        match found {
            None => march.record()?,
            Some(resume) => march.resume(resume)?,
        }
        let mut pace = Pace::new();
        while march.n < steps && march.ended.is_none() {
            march.steps(&mut pace)?;
            if march.waiting.is_empty() {
                march.pause()?;
            }
        }
        let March { sink, recorder, state, measured, n, values, crossings, ended, kept, .. } =
            march;
        let end = (n, ended.unwrap_or(setup.schedule.end));
        let mut outcome = recorder.finish(end, &state, &measured);
        outcome.warnings.splice(0..0, warnings);
        if ended.is_none() {
            let values = at_start.iter().zip(&values).map(|(&start, &end)| [start, end]);
            let missed = setup.events.iter().zip(values).filter(|(event, _)| event.terminal);
            let missed = missed.map(|(event, values)| (event.name.clone(), values));
            let warnings = missed.map(|(name, values)| Warning::NoEvent { name, values });
            outcome.warnings.extend(warnings.inspect(|warning| sink.warn(&warning.text())));
        }
        outcome.events = crossings;
        let drifting = drifting(outcome.drift, outcome.steps);
        outcome.warnings.extend(drifting.inspect(|warning| sink.warn(&warning.text())));
        Ok((outcome, state, kept))
    }
}

impl<'s> March<'_, 's> {
    /// Puts the state of an earlier run in place.
    fn resume(&mut self, resume: Resume) -> Result<(), RunError> {
        let Resume { step, momentum, element, times, tally } = resume;
        let Numbers { g, mu } = &self.state;
        let fits = (g.len(), mu.len()) == (element.len(), momentum.len());
        if !fits || step > self.setup.schedule.steps {
            return Err(RunError::Option("the state is none of this system".into()));
        }
        self.state = Numbers { g: element, mu: momentum };
        (self.n, self.times, self.recorder.tally) = (step, times, tally);
        self.measured = self.here()?;
        Ok(())
    }

    /// Measures the state of the run.
    fn here(&self) -> Result<Measured, RunError> {
        let measured = self.measure(self.setup.schedule.time(self.n), &self.state);
        measured.map_err(|what| self.stuck(what))
    }

    /// Measures a state that is given out, in which everything must be defined.
    fn measure(&self, time: f64, state: &Numbers) -> Result<Measured, String> {
        let (mut found, wrong) = self.measure_all(&[(time, state)]);
        let mut measured = found.pop().ok_or_else(|| wrong.unwrap_or_default())?;
        self.recorder.hide(&mut measured);
        Ok(measured)
    }

    /// As [`Recorder::measure`], with what the motion says is not defined.
    fn measure_all(&self, states: &[(f64, &Numbers)]) -> (Vec<Measured>, Option<String>) {
        let motion = self.motion;
        self.recorder.measure(motion.space(), states, |time, state| {
            motion.defined(state, time).map_err(|error| error.to_string())
        })
    }

    /// As [`measure`](Self::measure) for the state of the run, whose drift counts.
    fn visit(&mut self, time: f64) -> Result<Measured, String> {
        let mut measured = self.measure(time, &self.state)?;
        self.recorder.count(time, &mut measured);
        Ok(measured)
    }

    /// Measures and records the states that wait.
    fn settle(&mut self) -> Result<(), RunError> {
        self.settled = Instant::now();
        let (waiting, schedule) = (std::mem::take(&mut self.waiting), &self.setup.schedule);
        let states = waiting.iter().map(|(n, state)| (schedule.time(*n), state));
        let (found, mut wrong) = self.measure_all(&states.collect::<Vec<_>>());
        let mut found = found.into_iter();
        let (here, now) = (self.n, self.state.clone());
        for (n, state) in waiting {
            (self.n, self.state) = (n, state);
            let Some(mut measured) = found.next() else {
                return Err(self.stuck(wrong.take().unwrap_or_default()));
            };
            self.recorder.count(schedule.time(n), &mut measured);
            self.measured = measured;
            self.record()?;
        }
        (self.n, self.state) = (here, now);
        Ok(())
    }

    /// Makes steps of the grid, up to the next look at them.
    fn steps(&mut self, pace: &mut Pace) -> Result<(), RunError> {
        let schedule = &self.setup.schedule;
        let (first, next) = (self.n, self.next_look());
        let restored = (first / Orbit::EVERY + 1).saturating_mul(Orbit::EVERY);
        let count = (next.min(restored) - first).min(pace.0);
        // With events step by step.
        let before = (!self.setup.events.is_empty()).then(|| self.state.clone());
        let count = if before.is_some() { 1 } else { count };
        let ratio = if self.watched() { self.motion.ratio(&self.state.mu) } else { 0.0 };
        // The clock is read only if records are rarer than the driver's turns.
        let begun = (count == pace.0).then(Instant::now);
        let made = self.motion.advance(&mut self.state, first, count);
        if let Err((done, source)) = made {
            let time = schedule.time(first + done);
            let advice = self.motion.advice(&self.state, time, &source).unwrap_or_default();
            self.settle()?;
            let what = format!("{source}{advice}");
            return Err(RunError::Run { time, step: first + done + 1, what });
        }
        if let Some(begun) = begun {
            pace.took(count, begun.elapsed());
        }
        self.n = first + count;
        if let Some(orbit) = self.orbit.as_ref().filter(|_| self.n == restored) {
            orbit.restore(self.motion.space(), &mut self.state);
        }
        if let Ok(Some(solved)) = made
            && let Err(what) = self.recorder.solved(solved)
        {
            let stuck = self.stuck(what);
            self.settle()?;
            return Err(stuck);
        }
        if self.n.is_multiple_of(self.part) && self.n < self.setup.schedule.steps {
            self.kept.push((self.n, self.state.clone()));
        }
        if let Some(before) = before {
            self.look_out(first, &before)?;
            if self.ended.is_some() {
                return Ok(());
            }
        }
        if let Some(warning) = self.recorder.steep(first + 1, schedule.time(first), ratio) {
            self.sink.warn(&warning.text());
        }
        let alone = !self.setup.events.is_empty() || self.setup.at.is_some();
        // Times of `--at` change no report of the drift.
        if self.watched() {
            self.waiting.push((self.n, self.state.clone()));
        } else if alone && self.n == next && self.setup.recording {
            self.measured = self.here()?;
            self.record()?;
        }
        let full = alone || self.waiting.len() == BESIDE || self.n == schedule.steps;
        let settles = !self.waiting.is_empty() && (full || self.settled.elapsed() > LONGEST);
        if settles { self.settle() } else { Ok(()) }
    }

    /// The lookout for events in the step from this grid point.
    fn lookout(&self, first: u64) -> Lookout<'_, 's> {
        let (setup, motion) = (self.setup, self.motion);
        let (time, step) = (setup.schedule.time(first), setup.schedule.step);
        Lookout { events: &setup.events, motion, time, step }
    }

    /// Looks for events in the step just made, from this grid point and state on. One that ends the run puts its state in
    /// place, after the records of the times before it.
    fn look_out(&mut self, first: u64, before: &Numbers) -> Result<(), RunError> {
        let (setup, space) = (self.setup, self.motion.space());
        let lookout = self.lookout(first);
        let stuck = |what| self.stuck(what);
        let (values, signs) = (self.values.clone(), self.signs.clone());
        let start = event::Moment { share: 0.0, state: before.clone(), values, signs };
        let (mut earlier, mut found) = (start, Vec::new());
        for part in 1..=setup.looks {
            let last = part == setup.looks;
            let share = f64::from(part) / f64::from(setup.looks);
            let state = match last {
                true => self.state.clone(),
                false => lookout.state(before, share).map_err(|e| stuck(e.to_string()))?,
            };
            let time = if last {
                setup.schedule.time(first + 1)
            } else {
                lookout.time + share * lookout.step
            };
            let values = lookout.values(time, &state).map_err(stuck)?;
            let signs = event::signs(Some(&earlier.signs), &values);
            let later = event::Moment { share, state, values, signs };
            found.extend(lookout.between(before, [&earlier, &later]).map_err(stuck)?);
            earlier = later;
        }
        (self.values, self.signs) = (earlier.values, earlier.signs);
        for (event, time, state) in found {
            let element = self.recorder.entries(&space.matrix(&state.g));
            let momentum = state.mu.clone();
            self.crossings.push(Crossing { event, time, momentum, element });
            if setup.events[event].terminal {
                self.n = first;
                return self.end_at(time, before, state);
            }
        }
        Ok(())
    }

    /// Ends the run at a time within the step from a state of the grid.
    fn end_at(&mut self, time: f64, before: &Numbers, state: Numbers) -> Result<(), RunError> {
        let here = self.setup.schedule.time(self.n);
        let (direction, every) = (self.setup.schedule.step, self.setup.every);
        self.ended = Some(time);
        while let Some(earlier) = self.next_time().filter(|at| (time - at) * direction > 0.0) {
            let between = self.motion.beside(before, here, earlier - here);
            let between = between.map_err(|error| self.stuck(error.to_string()))?;
            let measured = self.measure(earlier, &between).map_err(|what| self.stuck(what))?;
            self.write(earlier, Some((&between, &measured)))?;
            self.times += 1;
        }
        self.state = state;
        self.measured = self.visit(time).map_err(|what| self.stuck(what))?;
        self.sink.look(time, &self.state.mu, &self.measured.moment);
        // The grid point itself may be recorded already.
        let wanted = |every| time != here || !self.n.is_multiple_of(every);
        match self.setup.recording && every.is_some_and(wanted) {
            true => self.write(time, None),
            false => Ok(()),
        }
    }

    /// True if the drift is measured after the steps made.
    fn watched(&self) -> bool {
        self.n == self.setup.schedule.steps || self.n.is_multiple_of(self.interval)
    }

    /// The next time of `--at`.
    fn next_time(&self) -> Option<f64> {
        self.setup.at.as_ref()?.0.get(self.times).copied()
    }

    /// The next grid point at which the drift is measured, or something is recorded.
    fn next_look(&self) -> u64 {
        let after = |interval: u64| (self.n / interval + 1).saturating_mul(interval);
        let next = after(self.interval).min(after(self.part)).min(self.setup.schedule.steps);
        self.next_time()
            .map_or(next, |time| next.min(self.setup.schedule.nearest(time).max(self.n + 1)))
    }

    /// Hands out the records at this grid point, and at the times nearer to it than to others.
    fn record(&mut self) -> Result<(), RunError> {
        let (setup, n) = (self.setup, self.n);
        let schedule = &setup.schedule;
        let here = schedule.time(n);
        // Pictures show moments at which the drift is measured.
        if self.watched() {
            self.sink.look(here, &self.state.mu, &self.measured.moment);
        }
        if !setup.recording {
            return Ok(());
        }
        let chosen =
            setup.every.is_some_and(|every| n.is_multiple_of(every) || n == schedule.steps);
        let mut own = chosen.then_some(here);
        while let Some(time) = self.next_time().filter(|time| schedule.nearest(*time) <= n) {
            let part = time - here;
            if schedule.same(time, here) {
                own = Some(time);
            } else {
                if part * schedule.step > 0.0
                    && let Some(time) = own.take()
                {
                    self.write(time, None)?;
                }
                let failed = |time, what| RunError::Run { time, step: n, what };
                let state = self.motion.beside(&self.state, here, part);
                let state = state
                    .map_err(|source| failed(here, format!("the record at {time}: {source}")))?;
                let measured = self.measure(time, &state);
                let measured = measured.map_err(|what| failed(time, what))?;
                self.write(time, Some((&state, &measured)))?;
            }
            self.times += 1;
        }
        own.map_or(Ok(()), |time| self.write(time, None))
    }

    /// Hands out a record: of the state of the grid, or of one beside it.
    fn write(&mut self, time: f64, beside: Option<(&Numbers, &Measured)>) -> Result<(), RunError> {
        let (state, measured) = beside.unwrap_or((&self.state, &self.measured));
        let Measured { moment, observed } = measured;
        let record = Record {
            time,
            momentum: &state.mu,
            element: &self.recorder.entries(observed.matrix(0)),
            moment: *moment,
            spatial_momentum: observed.spatial(0),
        };
        let taken = self.sink.record(&record);
        taken.map_err(|_| self.halted())
    }

    fn pause(&mut self) -> Result<(), RunError> {
        let Self { setup, state, recorder, n, times, ended, .. } = self;
        let end = *n == setup.schedule.steps || ended.is_some();
        let resume = || {
            let Numbers { g, mu } = state.clone();
            let (step, times, tally) = (*n, *times, recorder.tally);
            Resume { step, momentum: mu, element: g, times, tally }
        };
        let paused = self.sink.pause(*n, end, &resume);
        paused.map_err(|_| self.halted())
    }

    /// A number that is not finite, after the steps made.
    fn stuck(&self, what: String) -> RunError {
        RunError::Run { time: self.setup.schedule.time(self.n), step: self.n, what }
    }

    fn halted(&self) -> RunError {
        RunError::Halted { time: self.setup.schedule.time(self.n), step: self.n }
    }
}
