//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod card;
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
pub(crate) use collocation::collocated;
pub use compiled::{Compiled, Folded, Kept, Numbers, Solves};
pub use damping::Damper;
pub(crate) use damping::{Damped, Source};
pub(crate) use interpreter::Interpreter;
pub use interpreter::STEEP;
pub(crate) use kick::Map;
pub use kick::{Forces, Torque};
pub use linear::{Differentiable, Linear};
pub(crate) use motion::{Charted, Equations, advise, one_by_one};
pub use motion::{Motion, Varied};
pub use space::{Elements, Group, Restore, Space, identity};
pub(crate) use space::{cayley_group, entries_of, phase_of, product_group, whole_group};
