//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod card;
mod charted;
mod collocation;
mod compiled;
mod damping;
mod interpreter;
mod kick;
mod linear;
mod motion;
mod response;
mod space;
mod tangent;

pub(crate) use card::{card, device_text};
pub(crate) use charted::Charted;
pub use compiled::STEEP;
pub(crate) use compiled::{Compiled, Kept, Numbers, Solved, Solves};
pub(crate) use damping::{Damped, Damper};
pub(crate) use interpreter::Interpreter;
pub(crate) use kick::Torque;
pub(crate) use linear::{Differentiable, Linear};
pub(crate) use motion::{Motion, Varied};
pub(crate) use motion::one_by_one;
pub(crate) use space::{Elements, Group, Observed, Restore, Space, identity};
pub(crate) use space::{entries_of, phase_of, product_group, whole_group};
