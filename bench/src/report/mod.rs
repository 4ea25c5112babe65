//! What is written: tables for people and programs, and a diagram.

mod best;
mod diagram;
mod machine;
mod table;

pub use best::{Best, TARGETS, best};
pub use diagram::{DiagramError, diagram};
pub use machine::Machine;
pub use table::{Report, csv, markdown};
