//! What many trajectories conserve.

use coadjoint_codegen::step;

/// The largest drifts over an ensemble, each row's relative to its own [scales](coadjoint_codegen::step::Scales).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// The drifts of the quantities known to be conserved; energies are not measured.
    pub conserved: step::Drift,
    /// Rows at whose end rounding of large numbers hides a drift.
    pub unmeasured: u64,
    /// The largest ratio of the last two terms of the series at the states looked at (the start, the end, and every so
    /// many steps), where it is worth a warning; else 0.
    pub ratio: f64,
}

impl Drift {
    /// The larger of each, and the rows of both.
    pub fn max(mut self, other: Self) -> Self {
        self.conserved.raise(other.conserved);
        self.unmeasured += other.unmeasured;
        self.ratio = larger(self.ratio, other.ratio);
        self
    }
}

/// The larger of two numbers; what is no number is larger than any.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
