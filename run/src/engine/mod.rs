//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod advise;
mod card;
mod collocation;
mod compiled;
mod group;
mod interpreter;
mod kick;
mod linear;
mod motion;
mod response;
mod restore;
mod space;
mod steep;
mod tangent;

pub use advise::advise;
pub use card::{card, device_text};
pub(crate) use collocation::collocated;
pub use compiled::{Compiled, Folded, Kept, Numbers, Solves};
pub use group::{cayley_group, product_group, whole_group};
pub(crate) use interpreter::Interpreter;
pub use interpreter::STEEP;
pub use kick::{Forces, Map, Torque};
pub use linear::{Differentiable, Linear};
pub use motion::{Charted, Equations, Motion, Varied, one_by_one};
pub use restore::{Restore, entries_of, phase_of};
pub use space::{Elements, Space, identity};
pub(crate) use steep::Steepness;

use coadjoint::LieGroup;
use nalgebra::DVector;

/// Groups known at run time.
pub trait Group:
    LieGroup<Scalar = f64, Vector = DVector<f64>, Element: Send + Sync> + Send + Sync
{
}

impl<G> Group for G where
    G: LieGroup<Scalar = f64, Vector = DVector<f64>, Element: Send + Sync> + Send + Sync
{
}
