//! Writing a step as one header of C99, for embedded and flight software.
//!
//! The header has the loop of [`coadjoint_program::Stepper::advance`] and computes its bits where the compiler contracts
//! nothing. It folds the coefficients by the operations of [`coadjoint_program::fold`], has no globals, allocates nothing,
//! and every loop in it has an end that is known beforehand.

mod class;
mod comment;
mod dialect;
mod drive;
mod fold;
mod fold_text;
mod names;
mod parameter;
mod programs;
mod reference;
mod template;

pub use names::prefix;

use crate::integrator::Integrator;
use crate::step::{Step, StepError};
use names::Names;

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
    /// The prefix of all names; see [`prefix`].
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

/// The header of an integrator, to be saved as `PREFIX.h` (`PREFIX.hpp` for C++).
///
/// # Errors
/// [`HeaderError`] where there is no such header.
pub fn header(integrator: &Integrator, options: &HeaderOptions) -> Result<String, HeaderError> {
    let step = Step::build(integrator)?;
    let programs = step.kernel().programs();
    let list = [&programs.guess, &programs.correct, &programs.accept, &programs.transport];
    let operations = list.iter().map(|program| program.cost().total()).sum();
    if operations > MOST_OPERATIONS {
        return Err(HeaderError::TooLarge { operations, limit: MOST_OPERATIONS });
    }
    let names = Names::new(&integrator.problem, options);
    let fold = fold::Folding::new(integrator, &step)?;
    let text = [
        comment::opening(integrator, &step, &fold, &names, options),
        reference::types(integrator, &step, &fold, &names, options),
        names.fill(template::HELPERS),
        programs::functions(&step, &fold, &names),
        drive::functions(&step, &fold, &names),
        fold.init(integrator, &names, options),
        reference::functions(integrator, &step, &names),
        names.fill(template::END_OF_C),
        match options.language {
            Language::C => String::new(),
            Language::Cpp => class::class(integrator, &step, &names),
        },
        format!("\n#endif /* {} */\n", names.guard()),
    ];
    Ok(text.concat())
}
