//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod card;
mod collocation;
mod compiled;
mod interpreter;
mod kick;
mod linear;
mod motion;
mod response;
mod space;
mod tangent;

pub use card::card;
pub(crate) use card::device_text;
pub(crate) use collocation::collocated;
pub use compiled::{Compiled, Folded, Kept, Numbers, Solves};
pub(crate) use interpreter::Interpreter;
pub use interpreter::STEEP;
pub use kick::{Forces, Map, Torque};
pub use linear::{Differentiable, Linear};
pub use motion::{Charted, Equations, Motion, Varied};
pub(crate) use motion::{advise, one_by_one};
pub use space::{Elements, Group, Restore, Space, identity, product_group};
pub(crate) use space::{cayley_group, entries_of, phase_of, whole_group};
