//! The key `splitting`: how kicks and flows are composed.

use coadjoint_program::splitting::Splitting;

use super::table::Table;
use crate::diagnostic::{Diagnostics, Span, nearest};

/// The value of `splitting` with which a potential has no kicks: its torque is a part of the step.
pub(super) const NONE: &str = "none";

/// Reads `splitting`; it means nothing without a potential, which is a mistake, as it is beside a `velocity`, a `torque` or `damping`,
/// unless it is `none`.
pub(super) fn read(root: &Table<'_>, integrator: Option<&Table<'_>>) -> Option<(Splitting, Span)> {
    let (name, place) = integrator?.string("splitting", "splitting = \"rkn4\"")?;
    if !root.has("potential") && !super::drive::is_given(root) {
        let message = "a splitting composes flows with the kicks of a potential, and there is none";
        let help =
            "remove it, or give potential = \"…\" in the entries g[0][0], … of the group element";
        root.diagnostics.report_other(place, message, help);
    }
    if name == NONE {
        return None;
    }
    if super::drive::is_given(root) {
        let message = format!(
            "`splitting = \"{name}\"`: a velocity, a torque or damping acts within the step, of order K + 1, and a potential \
             beside it too"
        );
        root.diagnostics.report_other(place, message, "remove it");
        return None;
    }
    let found = Splitting::ALL.into_iter().find(|splitting| splitting.name() == name);
    if found.is_none() {
        let names = [&Splitting::ALL.map(Splitting::name)[..], &[NONE]].concat();
        let did =
            nearest(name, names.iter().copied()).map(|near| format!("; did you mean `{near}`?"));
        let message = format!("unknown splitting `{name}`{}", did.unwrap_or_default());
        root.diagnostics.report_other(place, message, &format!("splittings: {}", names.join(", ")));
    }
    Some((found?, place))
}

/// The splitting asked for, if the Hamiltonian, which may be known to be of degree at most two, allows it, or else the one of order
/// 4 that it allows.
pub(super) fn choose(
    asked: Option<(Splitting, Span)>,
    quadratic: bool,
    diagnostics: &Diagnostics,
) -> Splitting {
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
