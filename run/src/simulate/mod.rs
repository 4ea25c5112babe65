//! Trajectories of one system.

mod blocks;
mod learned;
mod march;
mod mover;
mod names;
mod outlet;
mod recorder;
mod schedule;
mod setup;
mod single;
mod subject;
mod task;
mod times;
mod warning;

pub use blocks::{Block, Kind, matrix, split};
pub use learned::{algebra_of, run_model, schedule_of};
pub use mover::At;
pub use names::columns;
pub use outlet::{Begun, Halt, Outlet, Record, Resume, Standing};
pub use recorder::{Drift, Moment, Outcome, Recorder, Scales, Solver, Tally, Unknown, Watched};
pub use schedule::Schedule;
pub use setup::Setup;
pub use single::Single;
pub use task::run;
pub use times::Times;
pub use warning::{Steep, Warning};
