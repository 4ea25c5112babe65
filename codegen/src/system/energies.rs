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

/// Reads `hamiltonian`, in these coordinates; without any it would be full of unknown names. None is needed where a velocity is all that
/// moves: a key, or, if `alone`, a function.
pub(super) fn hamiltonian(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    coordinates: &[(String, Span)],
    parameters: &Parameters,
    inputs: &[(Signal, Span)],
    alone: bool,
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
    time(&mut names, inputs, root);
    Definitions::read(root).add_to(root, &mut names);
    let moved = ["velocity", "velocity_in_space"].iter().any(|key| root.has(key));
    if !root.has("hamiltonian") && (alone || moved) {
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

/// Adds the time, unless something else is called t, and the inputs to names.
pub(super) fn time(names: &mut Names, inputs: &[(Signal, Span)], root: &Table<'_>) {
    for (i, (signal, place)) in inputs.iter().enumerate() {
        names.add(&signal.name, Name::Signal(i), *place, root.diagnostics);
    }
    names.known("t", Name::Time);
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
                "the input `{}` does not occur in the Hamiltonian, a potential, a velocity or a torque",
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

/// Calls the attitude of a body R, from body to space, where the group is one of motions in space, and its place x, where there is one:
/// each unless a name is that.
pub(super) fn attitude(algebra: &LieAlgebra, parts: &Definitions, names: &mut Names) {
    let is = |name: &&str| {
        catalogue::lookup(name).is_ok_and(|known| known.renamed(algebra.name()) == *algebra)
    };
    if !["SO3", "SE3"].iter().any(is) {
        return;
    }
    let size = algebra.matrix_size();
    let free =
        |name| names.entries(name).is_none() && names.get(name).is_none() && !parts.define(name);
    let [turned, placed] = [free("R"), free("x") && size > 3];
    for i in 0..3 {
        for j in (0..3).filter(|_| turned) {
            names.alias(format!("R[{i}][{j}]"), Name::Coordinate(i * size + j));
        }
        if placed {
            names.alias(format!("x[{i}]"), Name::Coordinate(i * size + 3));
        }
    }
}

/// Reads `potential`, if the file has one and its group is known: a function of the entries of the group element's matrix, the time and
/// the inputs.
pub(super) fn potential(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    parameters: &Parameters,
    inputs: &[(Signal, Span)],
) -> Option<Formula> {
    root.string("potential", POTENTIAL)?;
    let names = entries(algebra?.matrix_size());
    let entries: Vec<_> = names.into_iter().map(|name| (name, Span::Whole)).collect();
    let mut names = Names::of_coordinates(&entries, root.diagnostics);
    let kept = parameters.add_to(&mut names, root.diagnostics);
    time(&mut names, inputs, root);
    let parts = Definitions::read(root);
    attitude(algebra?, &parts, &mut names);
    parts.add_to(root, &mut names);
    root.energy("potential", POTENTIAL, &names, kept)
}
