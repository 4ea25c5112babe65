//! Writing a step as one header of C99, for embedded and flight software.
//!
//! The header has the loop of [`coadjoint_program::Stepper::advance`] and computes its bits where the compiler contracts
//! nothing. It folds the coefficients by the operations of [`coadjoint_program::fold`], has no globals, allocates nothing,
//! and every loop in it has an end that is known beforehand.

mod dialect;
mod fold;
mod names;
mod parameter;
mod programs;
mod reference;
mod template;

use crate::emit::c::names::Names;
use crate::integrator::Integrator;
use crate::step::Step;

pub use names::{HeaderError, HeaderOptions, Language, MOST_OPERATIONS, prefix};

/// The header of an integrator, to be saved as `PREFIX.h` (`PREFIX.hpp` for C++).
///
/// # Errors
/// [`HeaderError`] where there is no such header.
pub fn header(integrator: &Integrator, options: &HeaderOptions) -> Result<String, HeaderError> {
    let step = Step::build(integrator)?;
    let programs = &step.kernel().programs;
    let list = [&programs.guess, &programs.correct, &programs.accept, &programs.transport];
    let operations = list.iter().map(|program| program.cost().total()).sum();
    if operations > MOST_OPERATIONS {
        return Err(HeaderError::TooLarge { operations, limit: MOST_OPERATIONS });
    }
    let names = Names::new(&integrator.problem, options);
    let fold = fold::Folding::new(integrator, &step)?;
    let text = [
        reference::opening(integrator, &step, &fold, &names, options),
        reference::types(integrator, &step, &fold, &names, options),
        names.fill(template::HELPERS),
        programs::functions(&step, &fold, &names),
        programs::drive(&step, &fold, &names),
        fold.init(integrator, &names, options),
        reference::functions(integrator, &step, &names),
        names.fill(template::END_OF_C),
        match options.language {
            Language::C => String::new(),
            Language::Cpp => reference::class(integrator, &step, &names),
        },
        format!("\n#endif /* {} */\n", names.guard()),
    ];
    Ok(text.concat())
}
