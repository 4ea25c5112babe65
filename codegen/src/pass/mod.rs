//! From expressions to the problem: polynomials in the momentum, opaque coefficients, checks.

mod assemble;
mod coefficient;
mod polynomial;
mod sums;

pub use assemble::{
    DEFAULT_TRUNCATION, Draft, MAX_TRUNCATION, PotentialDraft, assemble, assemble_potential, chart,
    check_chart, check_truncation, constant, frame, linear, solver,
};
