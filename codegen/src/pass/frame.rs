//! Problems in the comoving frame.

use super::sums::name_sums;
use crate::comoving;
use crate::problem::{FrameChoice, Parameter, Problem};

/// True where the comoving frame is taken though the choice is left.
pub(super) fn is_taken(problem: &Problem) -> bool {
    comoving::is_uniform(&problem.algebra, &problem.hamiltonian)
}

/// Moves a problem to the comoving frame; `None` if no part of it can be left to the frame.
pub(super) fn comoving(problem: &Problem) -> Option<Problem> {
    let Problem { algebra, chart, hamiltonian, parameters, .. } = problem;
    let found = comoving::comoving(algebra, *chart, hamiltonian)?;
    let names: Vec<String> = parameters.iter().flat_map(Parameter::scalar_names).collect();
    let mut symbols = problem.symbols.clone();
    let frame = name_sums(&found, algebra.dim(), &mut symbols, &names);
    let hamiltonian = hamiltonian.widened(algebra.dim() + symbols.len()).into_owned();
    Some(Problem { hamiltonian, symbols, comoving: Some(frame), ..problem.clone() })
}

/// Moves a problem to the other frame, if the choice is open and there is another.
#[must_use]
pub fn in_other_frame(problem: &Problem) -> Option<Problem> {
    match (problem.frame, &problem.comoving) {
        (FrameChoice::Auto, Some(_)) => Some(Problem { comoving: None, ..problem.clone() }),
        (FrameChoice::Auto, None) => comoving(problem),
        _ => None,
    }
}
