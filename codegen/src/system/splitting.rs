//! The key `splitting`: how kicks and flows are composed.

use coadjoint_program::splitting::Splitting;

use super::table::Table;
use crate::diagnostic::{Diagnostics, Span, nearest};
use crate::potential::Potential;

/// Reads `splitting`; it means nothing without a potential, which is a mistake.
pub(super) fn read(root: &Table<'_>, integrator: Option<&Table<'_>>) -> Option<(Splitting, Span)> {
    let (name, place) = integrator?.string("splitting", "splitting = \"rkn4\"")?;
    if !root.has("potential") && !root.has("torque") {
        let message = "a splitting composes flows with the kicks of a potential, and there is none";
        let help =
            "remove it, or give potential = \"…\" in the entries g[0][0], … of the group element";
        root.diagnostics.report_other(place, message, help);
    }
    let found = Splitting::ALL.into_iter().find(|splitting| splitting.name() == name);
    if found.is_none() {
        let names = Splitting::ALL.map(Splitting::name);
        let did = nearest(name, names).map(|near| format!("; did you mean `{near}`?"));
        let message = format!("unknown splitting `{name}`{}", did.unwrap_or_default());
        root.diagnostics.report_other(place, message, &format!("splittings: {}", names.join(", ")));
    }
    Some((found?, place))
}

/// The splitting asked for, if the Hamiltonian, which may be known to be of degree at most two, and the kicks allow it, or else
/// the one of order 4 that they allow; Strang's where kicks depend on the momentum.
pub(super) fn choose(
    asked: Option<(Splitting, Span)>,
    quadratic: bool,
    potential: &Potential,
    diagnostics: &Diagnostics,
) -> Splitting {
    if potential.alone().is_some_and(|torque| torque.of_momentum) {
        if let Some((splitting, place)) = asked.filter(|(asked, _)| *asked != Splitting::Strang) {
            let name = splitting.name();
            let message = format!("`{name}` is for torques that do not depend on the momentum");
            diagnostics.report_other(place, message, "use \"strang\" here, of order 2");
        }
        return Splitting::Strang;
    }
    match asked {
        Some((splitting, place)) => {
            if !quadratic && matches!(splitting, Splitting::Rkn4 | Splitting::Rkn6) {
                let name = splitting.name();
                let message =
                    format!("`{name}` is for Hamiltonians of degree at most two in the momentum");
                diagnostics.report_other(place, message, "use \"prk4\" or \"prk6\" here");
            }
            splitting
        }
        None if quadratic => Splitting::Rkn4,
        None => Splitting::Prk4,
    }
}
