//! The key `splitting`: how kicks and flows are composed.

use super::table::Table;
use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::problem::Problem;
use crate::splitting::Splitting;

/// Reads `splitting`; it means nothing without a potential, which is a mistake.
pub(super) fn read(
    root: &Table<'_>,
    integrator: Option<&Table<'_>>,
    diagnostics: &mut Diagnostics,
) -> Option<(Splitting, Span)> {
    let (name, place) = integrator?.string("splitting", "splitting = \"rkn4\"", diagnostics)?;
    if !root.has("potential") {
        let message = "a splitting composes flows with the kicks of a potential, and there is none";
        let help =
            "remove it, or give potential = \"…\" in the entries g[0][0], … of the group element";
        diagnostics.report(place, Mistake::Other(message.to_owned(), Some(help.to_owned())));
    }
    let found = Splitting::ALL.into_iter().find(|splitting| splitting.name() == name);
    if found.is_none() {
        let names = Splitting::ALL.map(Splitting::name);
        let did = nearest(name, names).map(|near| format!("; did you mean `{near}`?"));
        let message = format!("unknown splitting `{name}`{}", did.unwrap_or_default());
        let help = format!("splittings: {}", names.join(", "));
        diagnostics.report(place, Mistake::Other(message, Some(help)));
    }
    Some((found?, place))
}

/// The splitting asked for, if the Hamiltonian allows it, or else the one of order 4 that it
/// allows.
pub(super) fn choose(
    asked: Option<(Splitting, Span)>,
    problem: &Problem,
) -> Result<Splitting, Diagnostics> {
    let quadratic = problem.is_quadratic();
    match asked {
        Some((splitting @ (Splitting::Rkn4 | Splitting::Rkn6), place)) if !quadratic => {
            let message = format!(
                "`{}` is for Hamiltonians of degree at most two in the momentum",
                splitting.name()
            );
            let help = "use \"prk4\" or \"prk6\" here".to_owned();
            let mut diagnostics = Diagnostics::new();
            diagnostics.report(place, Mistake::Other(message, Some(help)));
            Err(diagnostics)
        }
        Some((splitting, _)) => Ok(splitting),
        None if quadratic => Ok(Splitting::Rkn4),
        None => Ok(Splitting::Prk4),
    }
}
