//! How a header is to look, and why there is none.

use crate::step::StepError;

/// The most operations of a step (first guess, one correction, acceptance, transport) that are written as C: about
/// half a megabyte of machine code, and a minute of a compiler.
pub const MOST_OPERATIONS: usize = 40_000;

/// The language of a header.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// C99, which C++ can include.
    #[default]
    C,
    /// The same, and a class of C++11.
    Cpp,
}

/// How a header is to look.
#[derive(Clone, Debug, Default)]
pub struct HeaderOptions {
    /// The language.
    pub language: Language,
    /// The prefix of all names; see [`prefix`](super::prefix).
    pub prefix: String,
    /// The unit of time, for comments.
    pub time: Option<String>,
    /// The units of the momentum's coordinates, for comments; missing ones are none.
    pub momentum: Vec<Option<String>>,
    /// The one step size that means something, for learned maps.
    pub only_step: Option<f64>,
}

/// Why a system is not written as C.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HeaderError {
    /// A step of it is not made of straight-line programs.
    #[error("cannot be written as C: {0}")]
    Step(#[from] StepError),
    /// A step has too many operations.
    #[error(
        "too large for a header: a step has {operations} operations, more than the limit of {limit}; lower the \
         truncation, or run it with `coadjoint simulate --backend c`"
    )]
    TooLarge {
        /// Its operations.
        operations: usize,
        /// [`MOST_OPERATIONS`].
        limit: usize,
    },
    /// Nothing moves.
    #[error("cannot be written as C: the Hamiltonian is constant, and nothing moves")]
    Constant,
    /// The series has terms of a degree for which no radius is computed.
    #[error(
        "cannot be written as C: S has a term of degree {degree}, and the bound on its last terms knows of {limit} at \
         most; lower the truncation"
    )]
    Degree {
        /// The degree.
        degree: u32,
        /// The highest one.
        limit: u32,
    },
}
