//! States that a run keeps on its way, to be compared with those of another.

use crate::engine::Numbers;

/// The number of steps to a state on the way, and the state.
pub(crate) type Milestone = (u64, Numbers);

/// The parts of a run at whose ends its state is kept.
const PARTS: u64 = 32;

/// The number of steps after which, again and again, the state of a run is kept.
pub(super) fn part(steps: u64) -> u64 {
    (steps / PARTS).max(1)
}
