//! Settings of a run that override those of its text.

use coadjoint_codegen::system::Run;

/// The accuracy asked for, and the times of the run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// The step size.
    pub step: Option<f64>,
    /// The error wanted at the end of the run.
    pub tolerance: Option<f64>,
    /// The norm of the momentum up to which the tolerance is to hold; along the run if not given.
    pub region: Option<f64>,
    /// K, where it is not to be picked.
    pub truncation: Option<usize>,
    /// The time at the start, where it is not that of the text.
    pub t0: Option<f64>,
    /// The duration, where it is not that of the text.
    pub time: Option<f64>,
    /// True for the comoving frame, false for the fixed one; `None` for that of the text or the one that is picked.
    pub comoving: Option<bool>,
}

impl Accuracy {
    /// The time at which the run of a text starts.
    pub(crate) fn start(&self, run: &Run) -> f64 {
        self.t0.unwrap_or(run.initial_time)
    }
}
