//! The times of a run.

/// The times between equal steps: t₀ + n h.
///
/// Time is a part of the state: every call that makes steps or evaluates anything is given a grid, or the time itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// t₀, the time before the first step.
    pub start: f64,
    /// The step size h.
    pub step: f64,
}

impl Grid {
    /// The time after `n` steps.
    pub fn time(self, n: u64) -> f64 {
        self.start + n as f64 * self.step
    }
}
