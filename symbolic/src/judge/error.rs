//! The errors that keep the judge from judging.

use crate::hamilton_jacobi::DeriveError;
use crate::lie::ChartError;

/// Errors of making a judge, and of judging a step.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum JudgeError {
    /// The series could not be derived.
    #[error(transparent)]
    Derive(#[from] DeriveError),
    /// The chart does not exist for the algebra.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The Hamiltonian has no formula.
    #[error(
        "the Hamiltonian is a function of a program: there is no formula to compute in doubled precision"
    )]
    Given,
    /// A momentum is outside the domain of the Hamiltonian.
    #[error("the Hamiltonian is not defined at a momentum of this step")]
    Undefined,
    /// A vector has the wrong number of entries.
    #[error("{what} has {found} entries in place of {expected}")]
    Length {
        /// The value given.
        what: &'static str,
        /// Its number of entries.
        found: usize,
        /// The number wanted.
        expected: usize,
    },
    /// A number that must be finite is not.
    #[error("{what} is not finite")]
    NotFinite {
        /// The value given.
        what: &'static str,
    },
    /// A number leaves the range of doubles, or a sum loses more digits than doubled precision has to spare.
    #[error(
        "the numbers of this step leave the range in which they can be judged; take a smaller step"
    )]
    OutOfRange,
}
