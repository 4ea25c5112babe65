//! Coordinates, the Hamiltonian and the potential of a system file.

use super::definitions::Definitions;
use super::initial::copies;
use super::parameters::Parameters;
use super::table::Table;
use crate::diagnostic::Span;
use crate::expr::{Arena, Node};
use crate::lie::{LieAlgebra, catalogue};
use crate::parse::{Name, Names, text};
use crate::pass::{Formula, entries};
use crate::signal::Signal;

const COORDINATES: &str = "coordinates = [\"x\", \"y\", \"z\"]";
const HAMILTONIAN: &str = "hamiltonian = \"x^2/2 + y^2/4\"";
const POTENTIAL: &str = "potential = \"m*g[2][2]\"";

/// Reads `hamiltonian`, in these coordinates; without any it would be full of unknown names.
pub(super) fn hamiltonian(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    coordinates: &[(String, Span)],
    parameters: &Parameters,
    inputs: &[(Signal, Span)],
) -> Formula {
    let mut names = Names::of_coordinates(coordinates, root.diagnostics);
    match algebra {
        Some(algebra) if algebra.dim() == coordinates.len() => {}
        Some(_) => names.set_incomplete(),
        // Without a group it is not known how many there are of each.
        None => {
            let own = coordinates.iter().map(|(name, _)| name.as_str());
            own.chain(["mu"]).for_each(|name| names.excuse(name));
        }
    }
    let kept = parameters.add_to(&mut names, root.diagnostics);
    if names.get("mu").is_none() {
        let dim = algebra.map_or(0, LieAlgebra::dim);
        (0..dim).for_each(|i| names.alias(format!("mu[{i}]"), Name::Coordinate(i)));
    }
    for (i, (signal, place)) in inputs.iter().enumerate() {
        names.add(&signal.name, Name::Signal(i), *place, root.diagnostics);
    }
    // Anything else called t comes first.
    names.known("t", Name::Time);
    Definitions::read(root).add_to(root, &mut names);
    if !root.has("hamiltonian") && root.has("velocity") {
        // A velocity may be all that moves.
        let (mut arena, place) = (Arena::new(), Span::Whole);
        let zero = text::parse("0", 0, &[], &names, &mut arena, root.diagnostics);
        let (root, source) = (Some((zero, place)), "0".to_owned());
        return Formula { arena, root, parameters: kept, source };
    }
    if !root.has("hamiltonian") {
        root.missing("hamiltonian", HAMILTONIAN);
    }
    if coordinates.is_empty() {
        root.string("hamiltonian", HAMILTONIAN);
        return Formula::default();
    }
    root.energy("hamiltonian", HAMILTONIAN, &names, kept).unwrap_or_default()
}

/// Reports inputs that none of these has.
pub(super) fn check_inputs(root: &Table<'_>, inputs: &[(Signal, Span)], energies: &[&Formula]) {
    // Of one that could not be read it is not known.
    let unread = |energy: &&Formula| energy.arena.iter().any(|(_, node, _)| *node == Node::Wrong);
    if energies.iter().any(unread) {
        return;
    }
    for (i, (signal, place)) in inputs.iter().enumerate() {
        let has =
            |energy: &&Formula| energy.arena.iter().any(|(_, node, _)| *node == Node::Signal(i));
        if !energies.iter().any(has) {
            let what = format!(
                "the input `{}` does not occur in the Hamiltonian, a velocity or a torque",
                signal.name
            );
            root.diagnostics.report_other(*place, what, "name it there, or leave it out");
        }
    }
}

/// The names of the coordinates, and where they are given; those of the generators, or mu[0], mu[1], … where none are
/// given. For a power the names of one copy are enough: x, y, z are then x[0], y[0], z[0], x[1], ….
pub(super) fn coordinates(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
) -> (Vec<(String, Span)>, Span) {
    if !root.has("coordinates") {
        let dim = algebra.map_or(0, LieAlgebra::dim);
        let own = root.get("algebra").and_then(|value| value.get_ref().get("generators"));
        let name = |i: usize| match (own, algebra) {
            (Some(_), Some(algebra)) => algebra.generators()[i].clone(),
            _ => format!("mu[{i}]"),
        };
        return ((0..dim).map(|i| (name(i), Span::Whole)).collect(), Span::Whole);
    }
    let Some((mut names, whole)) = root.names("coordinates", COORDINATES) else {
        return (Vec::new(), Span::Whole);
    };
    if let Some(copies) = algebra.and_then(|algebra| copies(algebra, names.len())) {
        let copy = |i| names.iter().map(move |(name, place)| (format!("{name}[{i}]"), *place));
        names = (0..copies).flat_map(copy).collect();
    }
    (names, whole)
}

/// Calls the attitude of a body R, from body to space, where the group is one of motions in space and no other name is R.
pub(super) fn attitude(algebra: &LieAlgebra, names: &mut Names) {
    let is = |name: &&str| {
        catalogue::lookup(name).is_ok_and(|known| known.renamed(algebra.name()) == *algebra)
    };
    if names.entries("R").is_some() || !["SO3", "SE3"].iter().any(is) {
        return;
    }
    let size = algebra.matrix_size();
    for (i, j) in (0..9).map(|at| (at / 3, at % 3)) {
        names.alias(format!("R[{i}][{j}]"), Name::Coordinate(i * size + j));
    }
}

/// Reads `potential`, if the file has one and its group is known: a polynomial in the entries of the group element's matrix.
pub(super) fn potential(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    parameters: &Parameters,
) -> Option<Formula> {
    root.string("potential", POTENTIAL)?;
    let names = entries(algebra?.matrix_size());
    let entries: Vec<_> = names.into_iter().map(|name| (name, Span::Whole)).collect();
    let mut names = Names::of_coordinates(&entries, root.diagnostics);
    let kept = parameters.add_to(&mut names, root.diagnostics);
    attitude(algebra?, &mut names);
    Definitions::read(root).add_to(root, &mut names);
    root.energy("potential", POTENTIAL, &names, kept)
}
