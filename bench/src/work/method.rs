//! A method at work on a problem.

use super::problem::{Problem, State};
use crate::timing::Failure;

/// The state at the end of a problem, by steps of this size or to this tolerance.
pub type Run = fn(&Problem, f64) -> Result<State, Failure>;

pub struct Competitor {
    /// Its name, unique among the methods.
    pub name: String,
    /// The order of accuracy, where it has one and takes a fixed step.
    pub order: Option<u32>,
    /// Steps, or tolerances, from the cheapest to the most accurate.
    pub settings: Vec<f64>,
    pub(super) run: Run,
}

impl Competitor {
    /// A method of fixed steps about a time scale.
    pub fn stepping(name: String, order: u32, scale: f64, run: Run) -> Self {
        // Finer than the differences that count, or luck would decide them.
        let step = |k| scale * 2f64.powf(-f64::from(k) / 8.0);
        let settings = (-16..88).map(step).collect();
        Self { name, order: Some(order), settings, run }
    }

    pub fn run(&self, problem: &Problem, setting: f64) -> Result<State, Failure> {
        (self.run)(problem, setting)
    }
}

/// The number of equal steps of about this length over [0, end], and their length.
pub fn equal_steps(step: f64, end: f64) -> (u64, f64) {
    let count = (end / step).round().max(1.0);
    (count as u64, end / count)
}
