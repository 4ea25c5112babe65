//! Problems in the comoving frame.

use super::sums::name_sums;
use crate::comoving::{self, commuting_field};
use crate::problem::{FrameChoice, Parameter, Problem};

/// Whether a linear term of H commutes with the rest.
pub(super) fn has_field(problem: &Problem) -> bool {
    !commuting_field(&problem.algebra, &problem.hamiltonian).is_zero()
}

/// The same problem in the comoving frame; none where nothing can be left to the frame.
pub(super) fn comoving(problem: &Problem) -> Option<Problem> {
    let Problem { algebra, chart, hamiltonian, parameters, .. } = problem;
    let found = comoving::comoving(algebra, *chart, hamiltonian)?;
    let names: Vec<String> = parameters.iter().flat_map(Parameter::scalar_names).collect();
    let mut symbols = problem.symbols.clone();
    let frame = name_sums(&found, algebra.dim(), &mut symbols, &names);
    let hamiltonian = hamiltonian.widened(algebra.dim() + symbols.len()).into_owned();
    Some(Problem { hamiltonian, symbols, comoving: Some(frame), ..problem.clone() })
}

/// The same problem in the other frame, where the choice is left and there is one.
#[must_use]
pub fn in_other_frame(problem: &Problem) -> Option<Problem> {
    match (problem.frame, &problem.comoving) {
        (FrameChoice::Auto, Some(_)) => Some(Problem { comoving: None, ..problem.clone() }),
        (FrameChoice::Auto, None) => comoving(problem),
        _ => None,
    }
}
