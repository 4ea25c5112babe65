//! The step the command line runs: its programs, and beside them the runtime's step on a group of tables.

mod breaks;
mod card;
mod charted;
mod codes;
mod collocation;
mod compiled;
mod drive;
mod kick;
mod method;
mod motion;
mod series;
mod space;
mod tangent;
mod varied;

pub(crate) use breaks::Breaks;
pub(crate) use card::{card, device_text};
pub(crate) use charted::Charted;
pub use compiled::STEEP;
pub(crate) use compiled::{Compiled, Kept, Numbers, Solved};
pub(crate) use kick::Torque;
pub(crate) use motion::Motion;
pub(crate) use series::Interpreter;
pub(crate) use space::{Observed, Space, Tables, entries_of, group_of, identity, phase_of};
pub(crate) use tangent::{Carried, Read, Reading, Tangents};
pub(crate) use varied::Sense;
