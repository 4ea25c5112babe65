//! Many trajectories of one system, in memory.

mod drift;
mod engine;
mod layout;
mod march;

pub use drift::Drift;
pub use engine::{Asked, Course, Engine, How, Rejected, Rows, Use, Watch, in_lanes};
pub use layout::{Attitude, Found, Known, Layout, Shape};
