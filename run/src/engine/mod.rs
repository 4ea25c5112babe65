//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod advise;
mod card;
mod compiled;
mod group;
mod interpreter;
mod kick;
mod polynomial;
mod restore;
mod steep;

pub use advise::advise;
pub use card::{card, device_text};
pub use compiled::{Compiled, Kept, Numbers};
pub use group::{cayley_group, product_group, whole_group};
pub use interpreter::Interpreter;
pub use kick::{Forces, Torque};
pub use polynomial::{Energy, FloatPolynomial};
pub use restore::{Restore, entries_of, phase_of};
pub use steep::{STEEP, Steepness};

use std::ops::Range;

use coadjoint::{LieGroup, groups::DirectProduct};
use nalgebra::DVector;

/// Groups known at run time.
pub trait Group: LieGroup<Scalar = f64, Vector = DVector<f64>> {
    /// The rows of each diagonal block of its matrices; all other entries are 0.
    fn blocks(&self) -> Vec<Range<usize>>;
}

impl<G: LieGroup<Scalar = f64>> Group for DirectProduct<G> {
    fn blocks(&self) -> Vec<Range<usize>> {
        let mut end = 0;
        let block = |factor: &G| {
            end += factor.matrix_size();
            end - factor.matrix_size()..end
        };
        self.factors().map(block).collect()
    }
}
