//! Errors of making the programs of a step.

use coadjoint_program::ProgramError;

/// Groups by tables whose step would have more operations than this have no programs.
pub(crate) const MOST_OF_TABLES: usize = 1_000_000;

/// Reasons for which a step is not made of straight-line programs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The matrices of a group by tables are so large that loops over their entries are faster than programs.
    #[error(
        "{group} has {dimension} dimensions and matrices of {rows} rows: its straight-line programs would have more than {MOST_OF_TABLES} operations; use the interpreter"
    )]
    TooLarge {
        /// The group.
        group: String,
        /// Its dimension.
        dimension: usize,
        /// The rows of its matrices.
        rows: usize,
    },
    /// The matrices of a group by tables are too large for the exponential of a comoving frame.
    #[error(
        "the motion of the comoving frame of {group} would have more than {MOST_OF_TABLES} operations; use the interpreter, or `frame = \"fixed\"`"
    )]
    Frame {
        /// The group.
        group: String,
    },
    /// A comoving frame in numbers of 32 bits: whole turns cannot be taken off its angle.
    #[error(
        "a comoving frame has no programs in single precision; use double precision, or `frame = \"fixed\"`"
    )]
    SingleFrame,
    /// Steps that depend on time in numbers of 32 bits: soon they cannot tell the times within a step apart.
    #[error("steps that depend on time have no programs in single precision; use double precision")]
    SingleTime,
    /// The matrices of the basis are linearly dependent.
    #[error("the matrices of {group} are linearly dependent")]
    Dependent {
        /// The group.
        group: String,
    },
    /// The programs do not fit together.
    #[error(transparent)]
    Program(#[from] ProgramError),
}
