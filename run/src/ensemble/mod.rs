//! Many trajectories of one system, in memory.

mod attitude;
mod engine;
mod layout;
mod march;
mod rows;
mod steps;

pub use engine::{Asked, Drift, Engine, How, Use, Watch, engine, problem_of};
pub use layout::{Attitude, Found, Known, Layout, Shape, matrix_size};
pub use rows::{Rejected, Rows, advance_all, piece};
