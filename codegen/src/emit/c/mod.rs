//! Writing a step as one header of C99, for embedded and flight software.
//!
//! The header has the loop of [`coadjoint_program::Stepper::advance`] and computes its bits where the compiler contracts
//! nothing. It folds the coefficients by the operations of [`coadjoint_program::fold`], has no globals, allocates nothing,
//! and every loop in it has an end that is known beforehand. Its text is `header.h.in`; what differs between systems is
//! filled into that.

mod dialect;
mod fold;
mod names;
mod parameter;
mod programs;
mod reference;

use coadjoint_program::Precision;
use coadjoint_program::print::fill;

use crate::emit::c::names::{MOST_OPERATIONS, Names};
use crate::step::Origin;

pub use names::{HeaderError, HeaderOptions, Language, prefix};

/// The header of an origin, to be saved as `PREFIX.h` (`PREFIX.hpp` for C++).
///
/// # Errors
/// [`HeaderError`] where there is no such header.
pub fn header(origin: &Origin, options: &HeaderOptions) -> Result<String, HeaderError> {
    let step = origin.step(Precision::Double)?;
    if step.moves() && step.kernel().clock().is_none() {
        return Err(HeaderError::Moves);
    }
    let programs = &step.kernel().programs;
    let list = [&programs.guess, &programs.correct, &programs.accept, &programs.transport];
    let operations = list.iter().map(|program| program.cost().total()).sum();
    if operations > MOST_OPERATIONS {
        return Err(HeaderError::TooLarge { operations, limit: MOST_OPERATIONS });
    }
    let names = Names::new(origin.facts().parameters, options);
    let fold = fold::Folding::new(origin, &step)?;
    let mut values = reference::values(origin, &step, &fold, &names, options);
    values.extend(programs::values(&step, &fold, &names));
    values.extend(fold.values(origin, &names));
    Ok(fill(&names.fill(include_str!("header.h.in")), &values))
}
