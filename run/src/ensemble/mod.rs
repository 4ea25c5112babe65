//! Many trajectories of one system, in memory.

mod course;
mod disturbed;
mod engine;
mod layout;
mod march;

pub use course::Course;
pub use disturbed::Disturbance;
pub use engine::{Drift, Engine, How, Rejected, Rows, Use, Watch, in_lanes};
pub use layout::{Attitude, Found, Known, Layout, Shape};
