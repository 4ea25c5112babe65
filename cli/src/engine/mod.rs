//! The step the command line runs: the interpreter of the expression graph on a group of tables.

mod group;
mod interpreter;
mod kick;
mod lanes;
mod polynomial;

pub use group::matrix_group;
pub use interpreter::Interpreter;
pub use kick::{Forces, Torque};
pub use polynomial::{Energy, FloatPolynomial};

use coadjoint::LieGroup;
use nalgebra::DVector;

/// Groups known at run time.
pub trait Group: LieGroup<Scalar = f64, Vector = DVector<f64>> {}

impl<G: LieGroup<Scalar = f64, Vector = DVector<f64>>> Group for G {}
