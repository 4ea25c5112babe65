//! Coordinates and the Hamiltonian of a system file.

use toml::de::DeValue;

use super::parameters::Parameters;
use super::table::{Table, span, wrong_kind};
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::{Arena, ExprId};
use crate::lie::LieAlgebra;
use crate::parse::{Name, Names, text};
use crate::problem::Parameter;

const COORDINATES: &str = "coordinates = [\"x\", \"y\", \"z\"]";
const HAMILTONIAN: &str = "hamiltonian = \"x^2/2 + y^2/4\"";

/// The Hamiltonian as the file gives it.
pub(super) struct Written {
    pub coordinates: Vec<String>,
    pub coordinates_span: Span,
    pub parameters: Vec<Parameter>,
    pub arena: Arena,
    pub hamiltonian: Option<(ExprId, Span)>,
    pub source: String,
}

/// Reads `coordinates` and `hamiltonian`.
pub(super) fn read(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    parameters: &Parameters,
    file: &str,
    diagnostics: &mut Diagnostics,
) -> Written {
    let mut names = Names::default();
    let (coordinates, coordinates_span) = coordinates(root, algebra, diagnostics);
    for (i, (name, place)) in coordinates.iter().enumerate() {
        names.add(name, Name::Coordinate(i), *place, diagnostics);
    }
    let kept = parameters.add_to(&mut names, diagnostics);
    if names.get("mu").is_none() {
        let dim = algebra.map_or(0, LieAlgebra::dim);
        (0..dim).for_each(|i| names.alias(format!("mu[{i}]"), Name::Coordinate(i)));
    }
    let mut arena = Arena::new();
    let mut source = String::new();
    let mut hamiltonian = None;
    match root.string("hamiltonian", HAMILTONIAN, diagnostics) {
        Some((text, place)) => {
            source = text.to_owned();
            // Names cannot be resolved without coordinates: that would only repeat the mistake.
            if !coordinates.is_empty() {
                let offset = content_offset(file, place, text);
                let id = text::parse(text, offset, &names, &mut arena, diagnostics);
                hamiltonian = Some((id, place));
            }
        }
        None if !root.has("hamiltonian") => {
            let (key, owner) = ("hamiltonian".to_owned(), root.name().to_owned());
            let missing = Mistake::MissingKey(key, owner, HAMILTONIAN.to_owned());
            diagnostics.report(Span::text(0..0), missing);
        }
        None => {}
    }
    let coordinates = coordinates.into_iter().map(|(name, _)| name).collect();
    Written { coordinates, coordinates_span, parameters: kept, arena, hamiltonian, source }
}

/// The names of the coordinates; those of the generators, or mu[0], mu[1], … where none are given.
/// For a power the names of one copy are enough: x, y, z are then x[0], y[0], z[0], x[1], ….
fn coordinates(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    diagnostics: &mut Diagnostics,
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
    let Some((list, whole)) = root.array("coordinates", COORDINATES, diagnostics) else {
        return (Vec::new(), Span::Whole);
    };
    let mut names = Vec::new();
    for value in list {
        match value.get_ref() {
            DeValue::String(name) => names.push((name.to_string(), span(value))),
            _ => wrong_kind("coordinates", "a list of names", value, COORDINATES, diagnostics),
        }
    }
    if let Some(copies) = algebra.and_then(|algebra| copies(algebra, names.len())) {
        let copy = |i| names.iter().map(move |(name, place)| (format!("{name}[{i}]"), *place));
        names = (0..copies).flat_map(copy).collect();
    }
    (names, whole)
}

/// How many copies a power of a group has, if `each` coordinates are those of one copy.
pub(super) fn copies(algebra: &LieAlgebra, each: usize) -> Option<usize> {
    let (_, copies) = algebra.name().rsplit_once('^')?;
    let copies = copies.parse().ok()?;
    (copies > 1 && each * copies == algebra.dim()).then_some(copies)
}

/// Where the content of a TOML string begins in the file.
pub(super) fn content_offset(file: &str, place: Span, content: &str) -> usize {
    let Span::Text { start, end } = place else { return 0 };
    // Strings with escapes do not occur literally; their places are then approximate.
    let inside = file.get(start..end).and_then(|raw| raw.find(content)).unwrap_or(1);
    start + inside
}
