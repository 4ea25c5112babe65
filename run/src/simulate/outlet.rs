//! The interface by which a run hands out its records.

use super::blocks::Block;
use super::recorder::{Drift, Moment, Scales, Tally};

/// An outlet wants the run to end here; it knows why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Halt;

/// The facts known of a run before its first step.
#[derive(Clone, Copy, Debug)]
pub struct Begun<'a> {
    /// The blocks of the group's matrices that records hold.
    pub blocks: &'a [Block],
    /// Whether there are drifts of the spatial momentum, the Casimirs and the energy.
    pub known: [bool; 3],
    /// Whether there is an energy.
    pub energy: bool,
    /// The sizes that drifts are relative to.
    pub scales: &'a Scales,
}

/// A state of a run that is to be kept.
pub struct Record<'a> {
    /// t.
    pub time: f64,
    /// μ.
    pub momentum: &'a [f64],
    /// Computes the entries of the blocks of g, row by row; none where attitudes mean nothing.
    pub element: &'a dyn Fn() -> Vec<f64>,
    /// H_red(μ), plus V(g) where there is a potential; none where no energy is known.
    pub energy: Option<f64>,
    /// The differences from the start.
    pub drift: Drift,
    /// Computes the spatial momentum Ad*_g μ.
    pub spatial_momentum: &'a dyn Fn() -> Vec<f64>,
}

/// All that a run needs to go on later.
#[derive(Clone, Debug)]
pub struct Resume {
    /// Steps made.
    pub step: u64,
    /// μ.
    pub momentum: Vec<f64>,
    /// The entries of all blocks of g, row by row.
    pub element: Vec<f64>,
    /// The numbers that make g where steps are programs, which are other than its matrix.
    pub own: Option<Vec<f64>>,
    /// How many of the times asked for are recorded.
    pub times: usize,
    /// The maxima so far.
    pub tally: Tally,
}

/// Where a run stands between steps.
pub struct Standing<'a> {
    /// Steps made.
    pub step: u64,
    /// Makes what the run would need to go on from here.
    pub state: &'a dyn Fn() -> Resume,
}

/// Takes records, and is asked now and then whether to go on. Every method has a default that does nothing.
pub trait Outlet {
    /// Where to go on, if not from the start: asked once, before anything else. `blocks` are those of the group's
    /// matrices.
    ///
    /// # Errors
    /// To end the run.
    fn resume(&mut self, _blocks: &[Block]) -> Result<Option<Resume>, Halt> {
        Ok(None)
    }

    /// The first state has been measured.
    ///
    /// # Errors
    /// To end the run.
    fn begin(&mut self, _begun: &Begun<'_>) -> Result<(), Halt> {
        Ok(())
    }

    /// A record, in the order of time.
    ///
    /// # Errors
    /// To end the run.
    fn record(&mut self, _record: &Record<'_>) -> Result<(), Halt> {
        Ok(())
    }

    /// The drift was looked at, at this time.
    fn look(&mut self, _time: f64, _momentum: &[f64], _moment: &Moment) {}

    /// Between steps, about every ten milliseconds and at the end.
    ///
    /// # Errors
    /// To end the run.
    fn pause(&mut self, _standing: &Standing<'_>) -> Result<(), Halt> {
        Ok(())
    }

    /// Something that the user should know at once.
    fn warn(&mut self, _text: &str) {}

    /// The slow phase before the first step; `None` when it is done.
    fn phase(&mut self, _what: Option<&str>) {}
}

/// Takes nothing.
impl Outlet for () {}
