//! Many trajectories of one system, in memory.

mod attitude;
mod device;
mod engine;
mod layout;
mod pack;
mod rows;
mod steps;
mod whole;

pub use device::{Asked, Use};
pub use engine::{Drift, Engine, How, Watch, engine};
pub use layout::{Attitude, Found, Known, Layout, Shape, matrix_size};
pub use rows::{Rejected, Rows};
pub use whole::{advance_all, piece, problem_of};
