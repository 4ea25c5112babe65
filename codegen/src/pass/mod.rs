//! Turns expressions into the problem: polynomials in the momentum or programs of it, opaque coefficients, checks.

mod assemble;
mod choice;
mod coefficient;
mod frame;
mod polynomial;
mod program;
mod sums;

pub(crate) use assemble::{
    Acting, Draft, Formula, assemble_drive, assemble_either, assemble_potential, linear,
    without_space,
};
#[cfg(feature = "system")]
pub(crate) use assemble::{
    OfSites, assemble, assemble_given, constant, entries, function, of_sites,
};
pub(crate) use choice::Choice;
pub use frame::in_other_frame;
