//! The settings of a run: in which steps it reaches its end, from where, and what is recorded.

use std::path::Path;

use coadjoint::groups::ElementError;
use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::system::Run;
use coadjoint_codegen::tolerance::Choice;
use sha2::{Digest, Sha256};

use super::event::Event;
use crate::asked::Accuracy;
use crate::backend::Backend;
use crate::engine::{Numbers, Space, identity};
use crate::error::RunError;
use crate::grid::Grid;
use crate::number::shortest;

/// The most steps of a run: beyond, the time is surely a slip.
const MOST_STEPS: f64 = 1e12;
/// T/h may be above a whole number by this, relatively, without another step: decimals of h are rounded.
const SLACK: f64 = 1e-12;
/// The largest relative distance of a time from a whole number of steps of a fixed size.
const WHOLE: f64 = 1e-9;
/// The largest number of times written out in the description of a run.
const LISTED: usize = 16;

/// The steps of a run: a whole number of equal ones, the last of which ends at T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// The step size asked for.
    pub asked: f64,
    /// The step size used: T/⌈T/h⌉ with the sign of h, or h itself where h divides T.
    pub step: f64,
    /// The number of steps.
    pub steps: u64,
    /// The time at the start, t₀.
    pub start: f64,
    /// The time at the end: t₀ and T with the sign of h.
    pub end: f64,
}

impl Schedule {
    /// The schedule by what is asked for, else by the file.
    ///
    /// # Errors
    /// Fails if the step or the time is missing or makes no sense.
    pub fn new(file: &Path, asked: &Accuracy, run: &Run) -> Result<Self, RunError> {
        let step = asked.step.or(run.step).ok_or_else(|| RunError::no_step(file))?;
        let time = asked.time.or(run.time).ok_or_else(|| RunError::no_time(file))?;
        Self::of(Grid { start: asked.start(run), step }, time)
    }

    /// Steps of about the size of this grid, from its start on, over the duration `time`.
    ///
    /// # Errors
    /// The step or a time makes no sense.
    pub fn of(Grid { start, step: asked }: Grid, time: f64) -> Result<Self, RunError> {
        let refuse = |what: &str| Err(RunError::Option(what.to_owned()));
        if asked == 0.0 || !asked.is_finite() {
            return refuse("--step must be finite and other than zero; try --step 0.1");
        }
        if time <= 0.0 || !time.is_finite() {
            return refuse("--time must be finite and positive; try --time 100");
        }
        if !start.is_finite() {
            return refuse("--t0 must be finite; leave it out to start at time 0");
        }
        let steps = (time / asked.abs() * (1.0 - SLACK)).ceil().max(1.0);
        if steps > MOST_STEPS {
            return refuse("more than 1e12 steps; take a larger --step or a smaller --time");
        }
        let rounding = 4.0 * f64::EPSILON * time;
        let fits = (steps * asked.abs() - time).abs() <= rounding;
        let step = if fits { asked } else { (time / steps).copysign(asked) };
        if step == 0.0 {
            return refuse("the time is too short to be cut into steps; take a larger --time");
        }
        let end = start + time.copysign(asked);
        let apart = start.abs().max(end.abs()) * f64::EPSILON;
        if apart.is_nan() || apart >= step.abs() {
            return refuse(
                "times so far from 0 are farther apart than the steps; take a smaller --t0",
            );
        }
        Ok(Self { asked, step, steps: steps as u64, start, end })
    }

    /// Whole steps of the size that a model was learned for, which end at this time.
    ///
    /// # Errors
    /// Fails if none do.
    pub fn of_model(step: f64, time: f64) -> Result<Self, RunError> {
        let steps = (time / step).round();
        if !(steps.is_finite() && (1.0..MOST_STEPS).contains(&steps)) {
            return Err(RunError::Option(format!(
                "the time {time} is no number of steps of {step}, the step the model was learned for"
            )));
        }
        let end = steps * step;
        if (end - time).abs() > WHOLE * time {
            return Err(RunError::Option(format!(
                "the time {time} is no whole number of steps of {step}, the step the model was learned \
                 for: give --time {end}"
            )));
        }
        Ok(Self { asked: step, step, steps: steps as u64, start: 0.0, end })
    }

    /// The times between steps.
    pub fn grid(&self) -> Grid {
        Grid { start: self.start, step: self.step }
    }

    /// The time after `n` steps; the last is the end itself, not what rounding makes of it.
    pub fn time(&self, n: u64) -> f64 {
        if n == self.steps { self.end } else { self.grid().time(n) }
    }

    /// The number of steps that end nearest to a time of the run.
    pub(crate) fn nearest(&self, time: f64) -> u64 {
        ((time - self.start) / self.step).round().min(self.steps as f64) as u64
    }

    /// True if two times are equal up to rounding.
    pub(crate) fn same(&self, time: f64, other: f64) -> bool {
        let size = self.start.abs().max(time.abs()).max(self.step.abs());
        (time - other).abs() <= 4.0 * f64::EPSILON * size
    }

    /// A line about the step, where another is used than was asked for.
    pub fn announcement(&self) -> Option<String> {
        let Self { asked, step, steps, end, .. } = *self;
        (step != asked).then(|| {
            let plural = if steps == 1 { "step ends" } else { "steps end" };
            let [step, asked, end] = [step, asked, end].map(shortest);
            format!("step {step} in place of {asked}, so that {steps} {plural} at {end}")
        })
    }
}

/// A time as whole steps and a shorter one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Whole steps.
    pub step: u64,
    /// The size of the shorter step; 0 where there is none.
    pub part: f64,
}

/// The times of `--at`, each once, in the order of the run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times(pub Vec<f64>);

impl Times {
    /// Reads `1,2.5,3` or the name of a file with numbers between commas, spaces or line ends; `#`
    /// begins a comment there.
    ///
    /// # Errors
    /// Fails if it is neither, or a time is not in the run.
    pub fn read(argument: &str, schedule: &Schedule) -> Result<Self, RunError> {
        let refuse = |what: String| RunError::Option(format!("--at {argument}: {what}"));
        let list = argument.split(',').map(|word| word.trim().parse::<f64>());
        let times = match list.collect::<Result<Vec<f64>, _>>() {
            Ok(times) => times,
            Err(_) => times_in(Path::new(argument)).map_err(refuse)?,
        };
        Self::new(times, schedule).map_err(refuse)
    }

    /// These times, which must be in the run.
    ///
    /// # Errors
    /// Fails if there are none, or one is not in the run.
    pub fn new(mut times: Vec<f64>, schedule: &Schedule) -> Result<Self, String> {
        if times.is_empty() {
            return Err("no times are given".into());
        }
        let Schedule { start, end, step, .. } = *schedule;
        let within = |t: &f64| (start.min(end)..=start.max(end)).contains(t);
        if let Some(outside) = times.iter().find(|time| !within(time)) {
            let [start, end] = [start, end].map(shortest);
            return Err(format!("{outside} is not between {start} and the end, {end}"));
        }
        times.sort_by(|a, b| (a * step.signum()).total_cmp(&(b * step.signum())));
        times.dedup();
        Ok(Self(times))
    }

    /// The stops of these times: the nearest point of the grid, and the shorter step from it, which may go back.
    pub fn stops(&self, schedule: &Schedule) -> Vec<Stop> {
        let stop = |&time: &f64| {
            let step = schedule.nearest(time);
            let here = schedule.time(step);
            Stop { step, part: if schedule.same(time, here) { 0.0 } else { time - here } }
        };
        self.0.iter().map(stop).collect()
    }

    /// The times in words, for the description of a run.
    pub fn text(&self) -> String {
        if self.0.len() <= LISTED {
            return self.0.iter().map(|&t| shortest(t)).collect::<Vec<_>>().join(",");
        }
        let mut hash = Sha256::new();
        self.0.iter().for_each(|time| hash.update(time.to_le_bytes()));
        format!("{} times, sha256 {:x}", self.0.len(), hash.finalize())
    }
}

fn times_in(path: &Path) -> Result<Vec<f64>, String> {
    let text = read_text(path).map_err(|error| {
        format!("neither numbers with commas between them nor a file that can be read ({error})")
    })?;
    let mut times = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words = line.split([',', ' ', '\t', '\r']).filter(|word| !word.is_empty());
        for word in words {
            let time = word.parse();
            times.push(time.map_err(|_| format!("line {}: `{word}` is no number", number + 1))?);
        }
    }
    Ok(times)
}

/// The settings of a run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// In which steps the run reaches its end.
    pub schedule: Schedule,
    /// True if the run is recorded.
    pub recording: bool,
    /// Every n-th step is recorded, and the last; `None` where only the times of `at` are. Not 0.
    pub every: Option<u64>,
    /// Times recorded besides.
    pub at: Option<Times>,
    /// The events looked for.
    pub events: Vec<Event>,
    /// The number of equal parts of a step at whose ends events are looked for. Not 0.
    pub looks: u32,
    /// The backend that evaluates the programs of a step.
    pub backend: Backend,
    /// True if the error at the end is estimated.
    pub estimate: bool,
    /// The choice for the error wanted at the end, where there is one.
    pub choice: Option<Choice>,
    /// μ at the start.
    pub momentum: Vec<f64>,
    /// g at the start, row by row; the identity if it is not given.
    pub group_element: Option<Vec<Vec<f64>>>,
}

impl Setup {
    /// A run from this momentum and the identity, of which no records are kept.
    pub fn new(schedule: Schedule, momentum: Vec<f64>) -> Self {
        let (recording, every, at) = (false, Some(1), None);
        let (events, looks, backend) = (Vec::new(), 1, Backend::Auto);
        let (estimate, choice, group_element) = (true, None, None);
        Self {
            schedule,
            recording,
            every,
            at,
            events,
            looks,
            backend,
            estimate,
            choice,
            momentum,
            group_element,
        }
    }
}

impl Setup {
    /// The error at the end, where the choice of the step has found it by the same run: from the identity along the whole time.
    pub(crate) fn known_error(&self) -> Option<f64> {
        let choice = self.choice.as_ref()?;
        let made = choice.along_run && choice.step == self.schedule.step;
        (made && self.group_element.is_none()).then_some(choice.error)
    }
}

/// The state at the start of a run of the system that is called `file`; without an element that of the identity.
///
/// # Errors
/// Fails if the matrix given, by rows, is no element of the group.
pub(crate) fn start(
    file: &Path,
    space: &Space,
    element: Option<&[Vec<f64>]>,
    momentum: &[f64],
) -> Result<Numbers, RunError> {
    let size = space.size();
    let matrix = match element {
        None => identity(size),
        Some(rows) if rows.len() != size || rows.iter().any(|row| row.len() != size) => {
            return Err(RunError::Option(format!(
                "the group element must be a matrix of {size} rows and columns"
            )));
        }
        Some(rows) => {
            space.nearest(&rows.concat()).map_err(|error| not_an_element(file, &error))?
        }
    };
    Ok(Numbers { g: space.numbers(&matrix), mu: momentum.to_vec() })
}

/// The error of a matrix that is no element of the group.
pub(crate) fn not_an_element(file: &Path, why: &ElementError) -> RunError {
    RunError::of(file)(format!("`group_element` in [initial]: {why}"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_at_the_time() {
        for (time, step, steps, used) in [
            (50.0, 0.1, 500, 0.1),
            (1000.0, 0.001, 1_000_000, 0.001),
            (50.0, 0.8, 63, 50.0 / 63.0),
            (1.0, 0.333333333333, 3, 1.0 / 3.0),
            (1.0, 0.34, 3, 1.0 / 3.0),
            (0.05, 0.1, 1, 0.05),
            (50.0, -0.8, 63, -50.0 / 63.0),
        ] {
            for start in [0.0, -7.5, 1e3] {
                let found = Schedule::of(Grid { start, step }, time).unwrap();
                assert_eq!((found.steps, found.step), (steps, used), "{time} by {step}");
                assert_eq!(found.time(0), start);
                assert_eq!(found.time(1), if steps == 1 { found.end } else { start + used });
                assert_eq!(found.time(steps), start + time.copysign(step));
                assert_eq!(found.announcement().is_some(), step != used);
            }
        }
    }
}
