//! Samples of inputs that each row has of its own.

use coadjoint_codegen::signal::Signal;

use crate::error::RunError;

/// Samples of an input at the times of its table, a row for each state, in place of those of the system.
#[derive(Clone, Debug)]
pub struct Disturbance {
    /// The name of the input.
    pub input: String,
    /// The lengths of the array: rows and samples.
    pub shape: Vec<usize>,
    /// Its numbers, row by row.
    pub values: Vec<f64>,
}

/// All of them, each with the number of its input.
#[derive(Debug, Default)]
pub(super) struct Disturbed(Vec<(usize, Disturbance)>);

impl Disturbed {
    /// For this many rows.
    ///
    /// # Errors
    /// A name that no input with samples has, or a shape that does not fit.
    pub(super) fn new(
        signals: &[Signal],
        given: Vec<Disturbance>,
        rows: usize,
    ) -> Result<Self, RunError> {
        let samples = |signal: &Signal| signal.table()[0].len();
        let find = |own: Disturbance| {
            let input = &own.input;
            let at = signals.iter().position(|signal| signal.name == *input);
            let Some(at) = at.filter(|&at| samples(&signals[at]) > 0) else {
                let what = match at {
                    Some(_) => "is a function, which has no samples",
                    None => "is no input of the system",
                };
                let known = signals.iter().filter(|signal| samples(signal) > 0);
                let known: Vec<&str> = known.map(|signal| signal.name.as_str()).collect();
                let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
                return Err(format!("inputs: `{input}` {what}; those with samples: {known}"));
            };
            let fits = [rows, samples(&signals[at])];
            if own.shape != fits || own.values.len() != fits[0] * fits[1] {
                return Err(format!(
                    "inputs: the samples of `{input}` have the shape {:?}; {rows} rows of {} samples, one at each of its times, \
                     have {fits:?}",
                    own.shape, fits[1]
                ));
            }
            Ok((at, own))
        };
        let found: Result<_, String> = given.into_iter().map(find).collect();
        found.map(Self).map_err(RunError::Option)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The inputs of a row.
    ///
    /// # Errors
    /// The reason for which samples are no input.
    pub(super) fn of_row(&self, signals: &[Signal], row: usize) -> Result<Vec<Signal>, String> {
        let mut signals = signals.to_vec();
        for (at, own) in &self.0 {
            let Signal { name, between, .. } = signals[*at].clone();
            let times = signals[*at].table()[0].to_vec();
            let values = own.values.chunks(times.len()).nth(row).unwrap_or_default().to_vec();
            let made = Signal::new(name, times, values, between);
            signals[*at] = made.map_err(|error| error.to_string())?;
        }
        Ok(signals)
    }
}
