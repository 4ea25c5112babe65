//! Trajectories of one system.

mod blocks;
mod estimate;
mod event;
mod march;
mod orbit;
mod recorder;
mod run;
mod setup;
mod single;
mod sink;
mod tally;

pub use blocks::{Block, Kind, matrix, split};
pub(crate) use estimate::error_of;
pub use estimate::{LARGE, Unknown};
pub use event::{Crossing, Direction, Event};
pub use recorder::{Drift, Outcome, Scales};
pub use run::{run, run_model};
pub use setup::{Schedule, Setup, Stop, Times};
pub use single::Single;
pub use sink::{Begun, Halt, Record, Resume, Sink};
pub use tally::{DriftFields, Moment, Solver, Steep, Warning};
