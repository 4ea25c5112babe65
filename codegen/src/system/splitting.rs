//! The key `splitting`: how kicks and flows are composed.

use coadjoint_program::splitting::Splitting;

use super::table::Table;
use crate::diagnostic::{Diagnostics, Span, nearest};

/// The value of `splitting` with which a potential has no kicks: its torque is a part of the step.
const NONE: &str = "none";

/// The value of `splitting`.
#[derive(Clone, Copy, Debug)]
pub(super) enum Asked {
    /// Nothing, or a mistake.
    Open,
    /// `none`.
    None,
    /// This one, at its place.
    Kicks(Splitting, Span),
}

impl Asked {
    /// Reads `splitting`; it means nothing without a potential, which is a mistake, as it is beside a `velocity`, a `torque` or
    /// `damping`, or with a potential that depends on time, unless it is `none`.
    pub(super) fn read(root: &Table<'_>, integrator: Option<&Table<'_>>, moves: bool) -> Self {
        let text = integrator.and_then(|table| table.string("splitting", "splitting = \"rkn4\""));
        let Some((name, place)) = text else { return Self::Open };
        if !root.has("potential") && !super::drive::is_given(root) {
            let message =
                "a splitting composes flows with the kicks of a potential, and there is none";
            let help = "remove it, or give potential = \"…\" in the entries g[0][0], … of the group element";
            root.diagnostics.report_other(place, message, help);
        }
        if name == NONE {
            return Self::None;
        }
        if moves || super::drive::is_given(root) {
            let message = format!(
                "`splitting = \"{name}\"`: a velocity, a torque, damping or a potential that depends on time acts within the step, \
                 of order K + 1, and a potential beside it too"
            );
            root.diagnostics.report_other(place, message, "remove it");
            return Self::Open;
        }
        let found = Splitting::ALL.into_iter().find(|splitting| splitting.name() == name);
        found.map_or_else(
            || {
                let names = [&Splitting::ALL.map(Splitting::name)[..], &[NONE]].concat();
                let did = nearest(name, names.iter().copied());
                let did = did.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
                let message = format!("unknown splitting `{name}`{did}");
                let help = format!("splittings: {}", names.join(", "));
                root.diagnostics.report_other(place, message, &help);
                Self::Open
            },
            |splitting| Self::Kicks(splitting, place),
        )
    }

    /// The splitting asked for, if the Hamiltonian, which may be known to be of degree at most two, allows it, or else the one of
    /// order 4 that it allows.
    pub(super) fn choose(self, quadratic: bool, diagnostics: &Diagnostics) -> Splitting {
        let Self::Kicks(splitting, place) = self else {
            return if quadratic { Splitting::Rkn4 } else { Splitting::Prk4 };
        };
        if !quadratic && matches!(splitting, Splitting::Rkn4 | Splitting::Rkn6) {
            let name = splitting.name();
            let message =
                format!("`{name}` is for Hamiltonians of degree at most two in the momentum");
            diagnostics.report_other(place, message, "use \"prk4\" or \"prk6\" here");
        }
        splitting
    }
}
