//! The course of an ensemble: how many steps, and where states are kept.

use crate::simulate::Stop;

/// The steps of each row, and the times at which its states are kept.
#[derive(Clone, Debug, Default)]
pub struct Course {
    /// Steps of every row.
    pub steps: u64,
    /// The stops at which states are kept, in order; if there are none, only the final state is kept.
    pub stops: Vec<Stop>,
}

impl Course {
    /// States kept of a row.
    pub fn kept(&self) -> usize {
        self.stops.len().max(1)
    }

    /// From step to step, with the stop that is there.
    pub(super) fn legs(&self) -> impl Iterator<Item = (u64, u64, Option<Stop>)> {
        let ends = self.stops.iter().map(|stop| stop.step);
        let starts = std::iter::once(0).chain(ends.clone());
        let stops = self.stops.iter().copied().map(Some).chain([None]);
        starts.zip(ends.chain([self.steps])).zip(stops).map(|((a, b), stop)| (a, b, stop))
    }
}
