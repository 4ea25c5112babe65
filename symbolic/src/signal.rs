//! Inputs: functions of time that a table gives, or the program that reads the system.

use std::str::FromStr;
use std::sync::Arc;

use thiserror::Error;

/// The course of an input between the times of its values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The value at the time before, which the last one keeps: steps end at the times, where the input jumps.
    Previous,
    /// The line to the next value: steps end at the times, where it bends.
    Linear,
    /// The cubic spline whose third derivative does not jump at the second time and at the last but one ("not a knot": C. de Boor,
    /// *A Practical Guide to Splines*, IV). Through three values it is a parabola, through two a line.
    #[default]
    Spline,
}

impl FromStr for Interpolation {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        match text {
            "previous" => Ok(Self::Previous),
            "linear" => Ok(Self::Linear),
            "spline" => Ok(Self::Spline),
            _ => Err(()),
        }
    }
}

/// An input u(t), given by its values at some times, with an [`Interpolation`] between them. Or a function, which is called at the times
/// that steps ask for.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Its name.
    pub name: String,
    times: Vec<f64>,
    values: Vec<f64>,
    /// Its course between the times.
    pub between: Interpolation,
    /// The slopes of a spline at the times.
    slopes: Vec<f64>,
    /// The columns of a file that hold its table, where a file does.
    pub columns: Option<Columns>,
    function: Option<Called>,
}

/// A function of the time, shared.
#[derive(Clone)]
struct Called(Arc<dyn Fn(f64) -> f64 + Send + Sync>);

impl std::fmt::Debug for Called {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Called").finish_non_exhaustive()
    }
}

/// A table of two columns in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// The file, relative to that of the system.
    pub file: String,
    /// The name of the column of the times.
    pub times: String,
    /// The name of the column of the values.
    pub values: String,
}

/// Errors of making an input from a table. Entries are counted from 0.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SignalError {
    /// Two lists of different lengths.
    #[error("`{0}` has {2} values for {1} times")]
    Lengths(String, usize, usize),
    /// Fewer than two times.
    #[error("an input has at least two times")]
    Short,
    /// A time that is not after the one before it, or a number that is not finite.
    #[error("entry {0} of the times, {1}, must be finite and after the one before it")]
    Times(usize, f64),
    /// A value that is not finite.
    #[error("entry {1} of `{0}` is {2}, and must be finite")]
    Value(String, usize, f64),
    /// Two times so close, this one and the next, that the spline between others leaves the values far behind: how far it goes.
    #[error(
        "entries {1} and {next} are so close in time that the spline through `{0}` reaches {2:.1e}, far from the values: for \
         values that jump write hold = \"previous\", for lines between them hold = \"linear\"",
        next = .1 + 1
    )]
    Close(String, usize, f64),
}

/// A spline may leave the range of its values by this many times the range.
const FARTHEST: f64 = 3.0;

impl Signal {
    /// The input of this name with these values at these times, which ascend.
    ///
    /// # Errors
    /// [`SignalError`]: why there is none.
    pub fn new(
        name: String,
        times: Vec<f64>,
        values: Vec<f64>,
        between: Interpolation,
    ) -> Result<Self, SignalError> {
        if times.len() != values.len() {
            return Err(SignalError::Lengths(name, times.len(), values.len()));
        }
        if times.len() < 2 {
            return Err(SignalError::Short);
        }
        let after = |at: usize| times[at].is_finite() && (at == 0 || times[at] > times[at - 1]);
        if let Some(at) = (0..times.len()).find(|&at| !after(at)) {
            return Err(SignalError::Times(at, times[at]));
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(SignalError::Value(name, at, values[at]));
        }
        let signal = Self::through(name, times, values, between);
        match overshoot(&signal.times, &signal.values, &signal.slopes) {
            Some((at, reached)) => Err(SignalError::Close(signal.name, at, reached)),
            None => Ok(signal),
        }
    }

    /// The input of this name that is a function, at all times; NaN where it has no value.
    pub fn of_function(
        name: String,
        function: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let none = Self::through(name, Vec::new(), Vec::new(), Interpolation::Spline);
        Self { function: Some(Called(Arc::new(function))), ..none }
    }

    /// The input of this name with the table in a file, which has no value until [`Signal::new`] is given the numbers.
    pub fn of_columns(name: String, columns: Columns, between: Interpolation) -> Self {
        let none = Self::through(name, Vec::new(), Vec::new(), between);
        Self { columns: Some(columns), ..none }
    }

    /// The input with these values, whatever they are.
    fn through(name: String, times: Vec<f64>, values: Vec<f64>, between: Interpolation) -> Self {
        let slopes = match between {
            Interpolation::Spline if !times.is_empty() => slopes(&times, &values),
            _ => Vec::new(),
        };
        Self { name, times, values, between, slopes, columns: None, function: None }
    }

    /// The input with other values at its times, on which it depends linearly.
    pub fn with_values(&self, values: &[f64]) -> Self {
        Self::through(self.name.clone(), self.times.clone(), values.to_vec(), self.between)
    }

    /// The times at which it jumps or bends, so that steps end there.
    pub fn breaks(&self) -> &[f64] {
        if self.between == Interpolation::Spline { &[] } else { &self.times }
    }

    /// The times and the values of the table; none of a function.
    pub fn table(&self) -> [&[f64]; 2] {
        [&self.times, &self.values]
    }

    /// The first and the last time of the table; NaN where it has none. A function goes on for ever, and so does a last value that is
    /// kept.
    pub fn range(&self) -> [f64; 2] {
        if self.function.is_some() {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let [first, last] = [self.times.first(), self.times.last()];
        let [first, last] = [first, last].map(|time| time.copied().unwrap_or(f64::NAN));
        [first, if self.between == Interpolation::Previous { f64::INFINITY } else { last }]
    }

    /// The piece of the table at this time, the way from its beginning, and its width; `None` outside the table, whose ends reach as far
    /// as times are rounded.
    fn piece(&self, time: f64) -> Option<(usize, [f64; 2])> {
        let Self { times, .. } = self;
        let (first, end) = (*times.first()?, *times.last()?);
        let rounding = 1e-12 * (end - first);
        let held = self.between == Interpolation::Previous;
        if !(time >= first - rounding && (held || time <= end + rounding)) {
            return None;
        }
        let time = time.clamp(first, end);
        let last = times.len() - 1;
        // A step that ends at a time may begin before it by rounding.
        let slack = if held { rounding } else { 0.0 };
        let i =
            times.partition_point(|knot| *knot <= time + slack).clamp(1, last + usize::from(held))
                - 1;
        let next = times.get(i + 1).copied().unwrap_or(f64::INFINITY);
        Some((i, [time - times[i], next - times[i]]))
    }

    /// u(t); NaN outside the table.
    pub fn at(&self, time: f64) -> f64 {
        if let Some(Called(function)) = &self.function {
            return function(time);
        }
        let Self { values, slopes, .. } = self;
        let Some((i, piece)) = self.piece(time) else { return f64::NAN };
        match self.between {
            Interpolation::Previous => values[i],
            Interpolation::Linear => line(piece, [values[i], values[i + 1]]),
            Interpolation::Spline => {
                cubic(piece, [values[i], values[i + 1]], [slopes[i], slopes[i + 1]])
            }
        }
    }
}

/// The derivatives of Σⱼ wⱼ u(tⱼ) in the values of an input's table.
#[derive(Debug)]
pub struct Gathered<'a> {
    signal: &'a Signal,
    of_values: Vec<f64>,
    of_slopes: Vec<f64>,
}

impl<'a> Gathered<'a> {
    /// Of a sum without terms.
    pub fn new(signal: &'a Signal) -> Self {
        let zeros = vec![0.0; signal.times.len()];
        Self { signal, of_values: zeros.clone(), of_slopes: zeros }
    }

    /// Adds the term w u(t); times outside the table count for nothing.
    pub fn add(&mut self, time: f64, weight: f64) {
        let Some((i, piece)) = self.signal.piece(time) else { return };
        let add = |list: &mut [f64], of: &dyn Fn([f64; 2]) -> f64| {
            list[i] += weight * of([1.0, 0.0]);
            list[i + 1] += weight * of([0.0, 1.0]);
        };
        match self.signal.between {
            Interpolation::Previous => self.of_values[i] += weight,
            Interpolation::Linear => add(&mut self.of_values, &|unit| line(piece, unit)),
            Interpolation::Spline => {
                add(&mut self.of_values, &|unit| cubic(piece, unit, [0.0; 2]));
                add(&mut self.of_slopes, &|unit| cubic(piece, [0.0; 2], unit));
            }
        }
    }

    /// The derivatives, one for each value.
    pub fn derivatives(mut self) -> Vec<f64> {
        if self.of_slopes.iter().any(|own| *own != 0.0) {
            for (at, of_value) in self.of_values.iter_mut().enumerate() {
                let mut unit = vec![0.0; self.of_slopes.len()];
                unit[at] = 1.0;
                let slopes = slopes(&self.signal.times, &unit);
                *of_value += slopes.iter().zip(&self.of_slopes).map(|(a, b)| a * b).sum::<f64>();
            }
        }
        self.of_values
    }
}

/// The line between two values, at this way of a piece of this width.
fn line([way, width]: [f64; 2], [from, to]: [f64; 2]) -> f64 {
    from + way * ((to - from) / width)
}

/// The cubic between two values with these slopes there, at this way of a piece of this width.
fn cubic([way, width]: [f64; 2], [from, to]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    let (chord, share) = ((to - from) / width, way / width);
    from + way * (a + share * (3.0 * chord - 2.0 * a - b + share * (a + b - 2.0 * chord)))
}

/// The inputs of a program that depends on μ, t and u(t), after those it has besides.
pub(crate) fn inputs(mut first: Vec<f64>, mu: &[f64], time: f64, signals: &[Signal]) -> Vec<f64> {
    first.extend_from_slice(mu);
    first.push(time);
    first.extend(signals.iter().map(|signal| signal.at(time)));
    first
}

/// The first of the two times that make the spline leave its values by far, and how far it may then go: each piece stays within
/// its values at the ends and at the points of its tangents there after a third of the way.
fn overshoot(times: &[f64], values: &[f64], slopes: &[f64]) -> Option<(usize, f64)> {
    if slopes.is_empty() {
        return None;
    }
    let [low, high] = [f64::min, f64::max].map(|pick| values.iter().copied().fold(values[0], pick));
    let width = |i: usize| times[i + 1] - times[i];
    let reached = |i: usize| {
        let third = width(i) / 3.0;
        let tangents = [values[i] + third * slopes[i], values[i + 1] - third * slopes[i + 1]];
        let beyond = |x: &f64| (x - high).max(low - x);
        tangents.into_iter().max_by(|a, b| beyond(a).total_cmp(&beyond(b))).unwrap_or(high)
    };
    let far = |x: f64| {
        let beyond = (x - high).max(low - x);
        beyond.is_nan() || beyond > FARTHEST * (high - low)
    };
    let pieces = times.len() - 1;
    let at = (0..pieces).find(|&i| high > low && far(reached(i)))?;
    let beside = at.saturating_sub(1)..(at + 2).min(pieces);
    Some((beside.min_by(|&i, &j| width(i).total_cmp(&width(j)))?, reached(at)))
}

/// The slopes of the spline at its knots, by elimination in the tridiagonal equations.
fn slopes(times: &[f64], values: &[f64]) -> Vec<f64> {
    let widths: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let rises = values.windows(2).map(|pair| pair[1] - pair[0]);
    let chords: Vec<f64> = rises.zip(&widths).map(|(rise, width)| rise / width).collect();
    let last = times.len() - 1;
    if last == 1 {
        return vec![chords[0]; 2];
    }
    // The slope at the end next to `width`, of the cubic through both intervals, with the slope in the middle between them.
    let end = |width: f64, next: f64, chord: f64, after: f64| {
        let both = width + next;
        ((width + 2.0 * both) * next * chord + width * width * after) / both
    };
    if last == 2 {
        let bend = (chords[1] - chords[0]) / (widths[0] + widths[1]);
        let [a, b] = [chords[0] - widths[0] * bend, chords[1] + widths[1] * bend];
        return vec![a, chords[0] + widths[0] * bend, b];
    }
    // Row i: below·sᵢ₋₁ + on·sᵢ + above·sᵢ₊₁ = right, kept with its first entry eliminated.
    let right = end(widths[0], widths[1], chords[0], chords[1]);
    let mut rows = vec![[widths[1], widths[0] + widths[1], right]];
    for i in 1..=last {
        let (below, on, above, right) = if i < last {
            let (before, after) = (widths[i - 1], widths[i]);
            let right = 3.0 * (after * chords[i - 1] + before * chords[i]);
            (after, 2.0 * (before + after), before, right)
        } else {
            let (own, next) = (widths[last - 1], widths[last - 2]);
            let right = end(own, next, chords[last - 1], chords[last - 2]);
            (own + next, next, 0.0, right)
        };
        let [pivot, beside, value] = rows[i - 1];
        let factor = below / pivot;
        rows.push([on - factor * beside, above, right - factor * value]);
    }
    let mut slopes = vec![0.0; last + 1];
    let mut next = 0.0;
    for (slope, [on, above, right]) in slopes.iter_mut().zip(rows).rev() {
        next = (right - above * next) / on;
        *slope = next;
    }
    slopes
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const SPLINE: Interpolation = Interpolation::Spline;

    /// A jump within a millionth of the other times makes a spline 10⁵ times as high as its values, by its slopes of 10⁶.
    #[test]
    fn times_that_are_nearly_equal_are_refused() {
        let table = |gap: f64| {
            let times = vec![0.0, 0.5, 0.5 + gap, 1.0, 1.5, 2.0];
            Signal::new("u".to_owned(), times, vec![1.0, 1.0, 2.0, 2.0, 1.0, 1.0], SPLINE)
        };
        assert!(
            matches!(table(1e-6).unwrap_err(), SignalError::Close(_, 1, reached) if reached.abs() > 1e4)
        );
        assert!(table(0.2).is_ok());
        // Equal values have no jump.
        let close = vec![0.0, 0.5, 0.5 + 1e-9, 1.0];
        assert!(Signal::new("u".to_owned(), close, vec![0.1; 4], SPLINE).is_ok());
    }

    /// Four values or more determine a cubic, three a parabola, two a line.
    #[test]
    fn splines_are_the_polynomials_that_they_can_be() {
        let cubic = |t: f64| 0.3 - t + 0.7 * t * t - 0.2 * t * t * t;
        let parabola = |t: f64| 0.3 - t + 0.7 * t * t;
        let line = |t: f64| 0.3 - t;
        let times = [-1.0, 0.2, 0.5, 1.7, 1.8, 4.0];
        let cases: [(usize, &dyn Fn(f64) -> f64); 4] =
            [(6, &cubic), (4, &cubic), (3, &parabola), (2, &line)];
        for (count, function) in cases {
            let times = times[..count].to_vec();
            let values = times.iter().map(|&t| function(t)).collect();
            let signal = Signal::new("u".to_owned(), times.clone(), values, SPLINE).unwrap();
            for i in 0..=100 {
                let t = times[0] + (times[count - 1] - times[0]) * f64::from(i) / 100.0;
                assert!((signal.at(t) - function(t)).abs() < 2e-13, "{count} {t}");
            }
            assert!(signal.at(times[0] - 1e-9).is_nan() && signal.at(4.1).is_nan());
        }
    }
}
