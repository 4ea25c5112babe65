//! Many trajectories of one system, in memory.

mod engine;
mod layout;
mod march;

pub use engine::{Course, Drift, Engine, How, Rejected, Rows, Use, Watch, in_lanes};
pub use layout::{Attitude, Found, Known, Layout, Shape};
