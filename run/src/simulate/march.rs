//! The steps of a run: they are made one after the other, measured, and passed to the outlet.

use std::time::{Duration, Instant};

use coadjoint::{Phase, StepError};
use nalgebra::DVector;

use super::blocks::split;
use super::mover::{At, Mover, Seen};
use super::outlet::{Outlet, Record, Resume, Standing};
use super::recorder::{Moment, Outcome, Recorder};
use super::subject::Subject;
use super::warning::Warning;
use crate::engine::Restore;
use crate::error::RunError;

/// A step of another length, from the time given: (time, length, state).
type SideStep<'s, G> = dyn Fn(f64, f64, &mut Phase<G>) -> Result<(), StepError> + 's;

/// The number of measurements of the drift in a run without records.
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

    /// Records the time of some steps.
    fn took(&mut self, steps: u64, time: Duration) {
        const GOAL: f64 = 0.005;
        let each = time.as_secs_f64().max(1e-9) / steps.max(1) as f64;
        // At most twice as many as before: the first may have been cheap.
        self.0 = ((GOAL / each) as u64).clamp(1, self.0.saturating_mul(2));
    }
}

/// Further services that a run asks of its steps.
pub struct Beside<'s, G: Restore> {
    /// Makes a step of another length.
    pub side: &'s SideStep<'s, G>,
    /// The ratio of the last two terms of the series at a momentum, where it may be worth a warning; else 0.
    pub ratio: &'s dyn Fn(&G::Vector) -> f64,
}

/// A run on a group.
pub struct March<'a, G> {
    /// The subject of the run.
    pub subject: &'a Subject<'a>,
    /// The group.
    pub group: &'a G,
}

/// The state that changes along a run.
struct State<'a, 'm, G: Restore> {
    /// Steps made.
    n: u64,
    mover: &'m mut dyn Mover<G>,
    moment: Moment,
    recorder: Recorder<'a, G>,
    /// How many of the times asked for are recorded.
    times: usize,
}

impl<'a, G: Restore> March<'a, G> {
    /// Makes the steps that are left, by what moves, from the start or where an earlier run has ended.
    ///
    /// # Errors
    /// Why the run stopped.
    pub fn run(
        &self,
        mover: &mut dyn Mover<G>,
        beside: &Beside<'_, G>,
        outlet: &mut dyn Outlet,
    ) -> Result<Outcome, RunError> {
        let subject = self.subject;
        let schedule = &subject.setup.schedule;
        let mut state = self.begin(mover, outlet)?;
        self.go(&mut state, beside, outlet)?;
        let end = (schedule.steps, schedule.end);
        let State { recorder, mover, moment, .. } = state;
        let mut outcome = recorder.finish(end, &mover.phase(), &moment);
        outcome.warnings.splice(0..0, subject.warnings.iter().cloned());
        Ok(outcome)
    }

    /// The state at the start, or where an earlier run has ended.
    fn begin<'m>(
        &self,
        mover: &'m mut dyn Mover<G>,
        outlet: &mut dyn Outlet,
    ) -> Result<State<'a, 'm, G>, RunError> {
        let (subject, group) = (self.subject, self.group);
        let setup = subject.setup;
        let start = Phase::<G>::new(setup.element(subject.file, group)?, setup.momentum.clone());
        mover.place(start.clone(), None);
        let mut recorder = Recorder::new(group, subject.watched, &start, mover);
        let found = outlet.resume(recorder.blocks()).map_err(|_| self.halted(0))?;
        let Some(found) = found else {
            let moment = recorder.visit(0.0, mover).map_err(|what| self.stuck(0, what))?;
            outlet.look(0.0, start.momentum.as_slice(), &moment);
            outlet.begin(&recorder.begun()).map_err(|_| self.halted(0))?;
            return Ok(State { n: 0, mover, moment, recorder, times: 0 });
        };
        let Resume { step, momentum, element, own, times, tally } = found;
        let entries: usize = recorder.blocks().iter().map(|b| b.range.len().pow(2)).sum();
        if (momentum.len(), element.len()) != (setup.momentum.len(), entries) {
            return Err(RunError::Option("the state is none of this system".into()));
        }
        let mut g = nalgebra::DMatrix::zeros(group.matrix_size(), group.matrix_size());
        for (block, own) in split(recorder.blocks(), &element) {
            let rows = block.range.len();
            for (place, value) in own.iter().enumerate() {
                g[(block.range.start + place / rows, block.range.start + place % rows)] = *value;
            }
        }
        let element = group.restore(&|i, j| g[(i, j)]);
        mover.place(Phase::<G>::new(element, DVector::from_vec(momentum)), own);
        recorder.tally = tally;
        let moment = recorder.measure(mover).map_err(|what| self.stuck(step, what))?;
        outlet.begin(&recorder.begun()).map_err(|_| self.halted(step))?;
        Ok(State { n: step, mover, moment, recorder, times })
    }

    fn go(
        &self,
        state: &mut State<'a, '_, G>,
        beside: &Beside<'_, G>,
        outlet: &mut dyn Outlet,
    ) -> Result<(), RunError> {
        let steps = self.subject.setup.schedule.steps;
        if state.n == 0 {
            self.record(state, beside, outlet)?;
        }
        let mut pace = Pace::default();
        while state.n < steps {
            if let Some(warning) = self.steps(state, beside, &mut pace)? {
                outlet.warn(&warning.text());
            }
            self.record(state, beside, outlet)?;
            let standing = Standing { step: state.n, state: &|| kept(state) };
            outlet.pause(&standing).map_err(|_| self.halted(state.n))?;
        }
        Ok(())
    }

    /// Makes steps of the grid, up to the next look at them; what there is to be said of them.
    fn steps(
        &self,
        state: &mut State<'a, '_, G>,
        beside: &Beside<'_, G>,
        pace: &mut Pace,
    ) -> Result<Option<Warning>, RunError> {
        let schedule = &self.subject.setup.schedule;
        let (first, next) = (state.n, self.next_look(state));
        let count = (next - first).min(pace.steps());
        let ratio = if self.watched(first) { (beside.ratio)(state.mover.momentum()) } else { 0.0 };
        // Where records come more often than the driver must, none of its time goes into clocks.
        let begun = (count == pace.steps()).then(Instant::now);
        let made = state.mover.advance(first, count);
        let made = made.map_err(|(done, source)| RunError::Run {
            time: schedule.time(first + done),
            step: first + done + 1,
            what: source.to_string(),
        })?;
        if let Some(begun) = begun {
            pace.took(count, begun.elapsed());
        }
        let n = first + count;
        state.n = n;
        if let Some((iterations, residual)) = made.solve {
            let noted = state.recorder.solved(iterations, residual);
            noted.map_err(|what| self.stuck(n, what))?;
        }
        let warning = state.recorder.steep(first + 1, schedule.time(first), ratio);
        // Times of `--at` change no report of the drift.
        if self.watched(n) {
            let seen = state.recorder.visit(schedule.time(n), &*state.mover);
            let moment = seen.map_err(|what| self.stuck(n, what))?;
            state.moment = moment;
        } else if n == next {
            let moment =
                state.recorder.measure(&*state.mover).map_err(|what| self.stuck(n, what))?;
            state.moment = moment;
        }
        Ok(warning)
    }

    /// The number of steps between two measurements of the drift: at each record, or, where none are kept, at [`LOOKS`] moments.
    fn interval(&self) -> u64 {
        let setup = self.subject.setup;
        let every = setup.every.unwrap_or(1);
        match (setup.recording, setup.every) {
            (true, Some(_)) => every,
            _ => every * setup.schedule.steps.div_ceil(every.saturating_mul(LOOKS)).max(1),
        }
    }

    /// Whether the drift is measured after this number of steps.
    fn watched(&self, n: u64) -> bool {
        n == self.subject.setup.schedule.steps || n.is_multiple_of(self.interval())
    }

    /// The next grid point at which the drift is looked at, or something is recorded.
    fn next_look(&self, state: &State<'a, '_, G>) -> u64 {
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

    /// Hands out the records at this grid point, and at the times nearer to it than to others.
    fn record(
        &self,
        state: &mut State<'a, '_, G>,
        beside: &Beside<'_, G>,
        outlet: &mut dyn Outlet,
    ) -> Result<(), RunError> {
        let setup = self.subject.setup;
        let (schedule, n) = (&setup.schedule, state.n);
        let here = schedule.time(n);
        let chosen =
            setup.every.is_some_and(|every| n.is_multiple_of(every) || n == schedule.steps);
        // Pictures show moments at which the drift is looked at.
        if n > 0 && self.watched(n) {
            outlet.look(here, state.mover.momentum().as_slice(), &state.moment);
        }
        if !setup.recording {
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
                    self.write(state, time, None, outlet)?;
                }
                let mut phase = state.mover.phase();
                (beside.side)(here, part, &mut phase).map_err(|source| RunError::Run {
                    time: here,
                    step: n,
                    what: format!("the record at {time}: {source}"),
                })?;
                let seen = At { group: self.group, phase: &phase };
                let moment = state.recorder.measure(&seen).map_err(|what| RunError::Run {
                    time,
                    step: n,
                    what,
                })?;
                self.write(state, time, Some((phase, moment)), outlet)?;
            }
            state.times += 1;
        }
        match own {
            Some(time) => self.write(state, time, None, outlet),
            None => Ok(()),
        }
    }

    /// Hands out a record: of the state of the grid, or of one beside it.
    fn write(
        &self,
        state: &State<'a, '_, G>,
        time: f64,
        beside: Option<(Phase<G>, Moment)>,
        outlet: &mut dyn Outlet,
    ) -> Result<(), RunError> {
        let here = beside.as_ref().map(|(phase, _)| At { group: self.group, phase });
        let seen: &dyn Seen = match &here {
            Some(here) => here,
            None => &*state.mover,
        };
        let Moment { energy, drift } = beside.as_ref().map_or(state.moment, |(_, moment)| *moment);
        let written = self.subject.watched.attitude;
        let element = || match &beside {
            _ if !written => Vec::new(),
            Some((phase, _)) => state.recorder.entries(phase).collect(),
            None => state.recorder.entries(&state.mover.phase()).collect(),
        };
        let spatial_momentum = || seen.spatial_momentum().as_slice().to_vec();
        let record = Record {
            time,
            momentum: seen.momentum().as_slice(),
            element: &element,
            energy,
            drift,
            spatial_momentum: &spatial_momentum,
        };
        outlet.record(&record).map_err(|_| self.halted(state.n))
    }

    /// A number that is not finite, after `step` steps.
    fn stuck(&self, step: u64, what: String) -> RunError {
        RunError::Run { time: self.subject.setup.schedule.time(step), step, what }
    }

    fn halted(&self, step: u64) -> RunError {
        RunError::Halted { time: self.subject.setup.schedule.time(step), step }
    }
}

/// The data from which a run resumes here.
fn kept<G: Restore>(state: &State<'_, '_, G>) -> Resume {
    Resume {
        step: state.n,
        momentum: state.mover.momentum().as_slice().to_vec(),
        element: state.recorder.entries(&state.mover.phase()).collect(),
        own: state.mover.own(),
        times: state.times,
        tally: state.recorder.tally,
    }
}
