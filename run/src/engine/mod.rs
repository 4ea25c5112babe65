//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod advise;
mod card;
mod compiled;
mod group;
mod interpreter;
mod kick;
mod motion;
mod restore;
mod space;
mod steep;

pub use advise::advise;
pub use card::{card, device_text};
pub use compiled::{Compiled, Kept, Numbers, Solves};
pub use group::{cayley_group, product_group, whole_group};
pub use interpreter::{Interpreter, STEEP};
pub use kick::{Forces, Map, Torque};
pub use motion::{Charted, Motion, one_by_one};
pub use restore::{Restore, entries_of, phase_of};
pub use space::{Elements, Space};
pub use steep::Steepness;

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
