//! Trajectories of one system.

mod blocks;
mod estimate;
mod event;
mod march;
mod milestone;
mod orbit;
mod recorder;
mod run;
mod setup;
mod single;
mod sink;
mod slow;
mod tally;
mod unknown;

pub(crate) use setup::start;

pub use blocks::{Block, Representation, matrix, split};
pub use estimate::LARGE;
pub(crate) use estimate::{Maker, error_of};
pub use event::{Crossing, Direction, Event};
pub(crate) use recorder::drifting;
pub use recorder::{Drift, Outcome, Scales};
pub use run::{run, run_model};
pub use setup::{Schedule, Setup, Stop, Times};
pub use single::{Ongoing, Single};
pub(crate) use sink::DRIFTS;
pub use sink::{Begun, Halt, Record, Resume, Sink};
pub(crate) use slow::many;
pub use tally::{DriftFields, Effort, Moment, Steep, Warning};
pub use unknown::Unknown;
