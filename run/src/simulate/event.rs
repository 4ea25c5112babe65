//! Events: moments at which a function of the state changes its sign.

use std::fmt;
use std::sync::Arc;

use coadjoint::StepError;
use coadjoint_codegen::system;

use crate::engine::{Motion, Numbers, Space};

/// The function of an event: of the time, the matrix of g row by row, and μ. It may say why it has no value.
type Function = dyn Fn(f64, &[f64], &[f64]) -> Result<f64, String> + Send + Sync;

/// The changes of sign that count, in the direction of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive.
    Up,
    /// From positive to negative.
    Down,
    /// Either.
    #[default]
    Both,
}

impl Direction {
    /// The changes at which the function's slope has this sign, in the direction of the run; all for 0.
    pub fn of_slope(sign: i8) -> Self {
        match sign.signum() {
            1 => Self::Up,
            -1 => Self::Down,
            _ => Self::Both,
        }
    }

    /// True if a change from one [sign](signs) to the other counts.
    fn counts(self, [was, is]: [f64; 2]) -> bool {
        was * is < 0.0
            && match self {
                Self::Up => is > 0.0,
                Self::Down => is < 0.0,
                Self::Both => true,
            }
    }
}

/// The signs of functions after one another: 1 or −1, where a function is 0 that which it had before, and 0 as long as it has
/// none. A function that only touches 0 changes no sign.
pub(super) fn signs(before: Option<&[f64]>, values: &[f64]) -> Vec<f64> {
    let before = |place: usize| before.map_or(0.0, |signs| signs[place]);
    let sign = |(place, value): (usize, &f64)| match *value == 0.0 {
        true => before(place),
        false => value.signum(),
    };
    values.iter().enumerate().map(sign).collect()
}

/// A function of the state that is watched for changes of sign, after every step and at equal parts of it.
#[derive(Clone)]
pub struct Event {
    /// Its name in reports.
    pub name: String,
    /// The function.
    pub function: Arc<Function>,
    /// The changes of sign that count.
    pub direction: Direction,
    /// True if the run ends at the first of them.
    pub terminal: bool,
}

impl Event {
    /// The event of a system file.
    pub fn of(event: system::Event) -> Self {
        let system::Event { name, function, slots, direction, stop } = event;
        let direction = Direction::of_slope(direction);
        let value = move |time: f64, matrix: &[f64], mu: &[f64]| {
            let inputs = [mu, matrix, &[time]].concat();
            function.run(&inputs, &slots).first().copied().ok_or_else(|| "no value".to_owned())
        };
        Self { name, function: Arc::new(value), direction, terminal: stop }
    }
}

impl fmt::Debug for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event").field("name", &self.name).finish_non_exhaustive()
    }
}

/// An event that occurred.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// The number of the event in the list, from 0.
    pub event: usize,
    /// When: to rounding of the step's own interpolation, whose error is that of a step.
    pub time: f64,
    /// μ.
    pub momentum: Vec<f64>,
    /// The entries of the blocks of g, row by row.
    pub element: Vec<f64>,
}

/// A moment within a step: its share of the step, the state there, and the values and [signs] of the events' functions.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    pub share: f64,
    pub state: Numbers,
    pub values: Vec<f64>,
    pub signs: Vec<f64>,
}

/// Looks for events within a step.
pub(super) struct Lookout<'a, 's> {
    pub events: &'a [Event],
    pub motion: &'a Motion<'s>,
    /// The time at the start of the step, and the step.
    pub time: f64,
    pub step: f64,
}

impl Lookout<'_, '_> {
    /// The values of all functions at a state of this time.
    ///
    /// # Errors
    /// The event without a finite value, and its time.
    pub(super) fn values(&self, time: f64, state: &Numbers) -> Result<Vec<f64>, String> {
        self.events.iter().map(|event| value(event, self.motion.space(), time, state)).collect()
    }

    /// The crossings between two moments of the step that begins at `start`, in the order of time, each with its state.
    ///
    /// # Errors
    /// Fails if a state between them cannot be had, or a function has no value there.
    pub(crate) fn between(
        &self,
        start: &Numbers,
        [before, after]: [&Moment; 2],
    ) -> Result<Vec<(usize, f64, Numbers)>, String> {
        let mut found = Vec::new();
        for (place, event) in self.events.iter().enumerate() {
            let (a, b) = (before.values[place], after.values[place]);
            if !event.direction.counts([before.signs[place], after.signs[place]]) {
                continue;
            }
            // A function that was 0 until here changes its sign here.
            let (share, state) = match a == 0.0 {
                true => (before.share, before.state.clone()),
                false => self.root(event, start, (before, a), (after, b))?,
            };
            found.push((place, self.time + share * self.step, state));
        }
        let sooner = |time: f64| (time - self.time) / self.step;
        found.sort_by(|a, b| sooner(a.1).total_cmp(&sooner(b.1)));
        Ok(found)
    }

    /// The state at a share of the step.
    ///
    /// # Errors
    /// Returns the reason for which there is none.
    pub(super) fn state(&self, start: &Numbers, share: f64) -> Result<Numbers, StepError> {
        self.motion.beside(start, self.time, share * self.step)
    }

    /// A change of sign between two moments, by false position with the weights of Illinois (M. Dowell and P. Jarratt, BIT
    /// 11, 1971).
    fn root(
        &self,
        event: &Event,
        start: &Numbers,
        (before, at_before): (&Moment, f64),
        (after, at_after): (&Moment, f64),
    ) -> Result<(f64, Numbers), String> {
        const MOST: usize = 60;
        let (mut a, mut low) = (before.share, at_before);
        let (mut b, mut high, mut state) = (after.share, at_after, after.state.clone());
        for _ in 0..MOST {
            if high == 0.0 || (b - a).abs() <= 2.0 * f64::EPSILON {
                break;
            }
            let share = b - high * (b - a) / (high - low);
            let share = if share > a.min(b) && share < a.max(b) { share } else { 0.5 * (a + b) };
            let reached = self.state(start, share).map_err(|error| {
                format!("the event `{}`, at a share {share} of the step: {error}", event.name)
            })?;
            let time = self.time + share * self.step;
            let found = value(event, self.motion.space(), time, &reached)?;
            // The end that is replaced twice in a row counts half, so that both close in.
            if (found < 0.0) == (high < 0.0) && found != 0.0 {
                low *= 0.5;
            } else {
                (a, low) = (b, high);
            }
            let near = (share - b).abs() <= 2.0 * f64::EPSILON;
            (b, high, state) = (share, found, reached);
            if near {
                break;
            }
        }
        Ok((b, state))
    }
}

/// The value of an event's function.
fn value(event: &Event, space: &Space, time: f64, state: &Numbers) -> Result<f64, String> {
    let name = &event.name;
    let value = (event.function)(time, &space.matrix(&state.g), &state.mu);
    let value = value.map_err(|why| format!("the event `{name}` at time {time}: {why}"))?;
    match value.is_finite() {
        true => Ok(value),
        false => Err(format!("the function of the event `{name}` is {value} at time {time}")),
    }
}
