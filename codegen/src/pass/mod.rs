//! From expressions to the problem: polynomials in the momentum, opaque coefficients, checks.

mod assemble;
mod coefficient;
mod polynomial;

pub use assemble::{
    DEFAULT_TRUNCATION, Draft, MAX_TRUNCATION, assemble, chart, check_chart, check_truncation,
    linear,
};
