//! Trajectories of one system.

mod blocks;
mod learned;
mod march;
mod motion;
mod recorder;
mod schedule;
mod setup;
mod single;
mod sink;
mod tally;
mod task;
mod times;
mod warning;

pub use blocks::{Block, Kind, matrix, split};
pub use learned::{algebra_of, run_model, schedule_of};
pub use motion::{Matrices, Space};
pub use recorder::{Drift, Outcome, Recorder, Scales, Unknown, Watched};
pub use schedule::Schedule;
pub use setup::Setup;
pub use single::Single;
pub use sink::{Begun, Halt, Record, Resume, Sink, Standing};
pub use tally::{DriftFields, Moment, Solver, Tally};
pub use task::run;
pub use times::Times;
pub use warning::{Steep, Warning};
