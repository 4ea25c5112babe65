//! The keys `velocity`, `torque`, both also in space, and `damping`: motion beside that of the Hamiltonian.

use num_traits::{Signed, Zero};

use super::definitions::Definitions;
use super::energies::{attitude, time};
use super::initial::coordinates;
use super::parameters::Parameters;
use super::table::{Table, span};
use crate::diagnostic::Span;
use crate::expr::{Arena, ExprId, Node};
use crate::lie::LieAlgebra;
use crate::number::{Rational, nearest_float};
use crate::parse::{Name, Names, components, text};
use crate::pass::{Acting, Formula, entries, without_space};
use crate::signal::Signal;

const DAMPING: &str = "damping = \"1/100\"";
pub(super) const VELOCITY: &str = "velocity = [\"0\", \"0\", \"c*z\"]";
const TORQUE: &str = "torque = [\"-c*x\", \"-c*y\", \"-c*z\"]";

/// The lists of expressions that make a drive, each with an example.
const LISTS: [(&str, &str); 4] = [
    ("velocity", VELOCITY),
    ("torque", TORQUE),
    ("velocity_in_space", "velocity_in_space = [\"0\", \"0\", \"c\"]"),
    ("torque_in_space", "torque_in_space = [\"0\", \"0\", \"cos(t)\"]"),
];

/// True if a file has a key that makes a drive.
pub(super) fn is_given(root: &Table<'_>) -> bool {
    root.has("damping") || LISTS.iter().any(|(key, _)| root.has(key))
}

/// Reads `velocity` and `torque`, lists of expressions in the entries of the group element's matrix, the momentum, ω = ∂H/∂μ, the
/// time and the inputs, one for each coordinate; and `damping`. None where there is no such key, or where it is a mistake.
pub(super) fn read(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    coordinates: &[(String, Span)],
    parameters: &Parameters,
    inputs: &[(Signal, Span)],
) -> Option<Acting> {
    let damping = damping(root, algebra);
    let algebra = algebra?;
    let entries = entries(algebra.matrix_size());
    let entry = |name: &String| (name.clone(), Span::Whole);
    let all: Vec<_> = entries.iter().map(entry).chain(coordinates.iter().cloned()).collect();
    let mut names = Names::of_coordinates(&all, root.diagnostics);
    let kept = parameters.add_to(&mut names, root.diagnostics);
    let dim = coordinates.len();
    for i in 0..dim {
        names.alias(format!("mu[{i}]"), Name::Coordinate(entries.len() + i));
    }
    let own = names.get("omega").is_some() || names.entries("omega").is_some();
    for i in (0..dim).filter(|_| !own) {
        names.alias(format!("omega[{i}]"), Name::Coordinate(entries.len() + dim + i));
    }
    time(&mut names, inputs, root);
    let parts = Definitions::read(root);
    attitude(algebra, &parts, &mut names);
    parts.add_to(root, &mut names);
    let lists = LISTS.map(|(key, example)| (key, example, list(root, key, example, (&names, dim))));
    let (mut arena, mut sources, mut sound) = (Arena::new(), Vec::new(), true);
    let [eta, tau, eta_in_space, tau_in_space] = lists.map(|(key, example, list)| {
        let (list, place) = list?;
        if list.len() != dim {
            let message = format!("`{key}` has {} components, and the momentum {dim}", list.len());
            root.diagnostics.report_other(place, message, &format!("write for example {example}"));
            sound = false;
            return None;
        }
        if key.ends_with("in_space")
            && let Some(reason) = without_space(algebra)
        {
            let message = format!("`{key}`: {reason}");
            root.diagnostics.report_other(
                place,
                message,
                "give it in the body, without `_in_space`",
            );
            sound = false;
            return None;
        }
        let texts = list.iter().map(|(text, _)| &text[..]).collect::<Vec<_>>().join(", ");
        sources.push(format!("{key} = [{texts}]"));
        let parse = |(text, place): &(String, Span)| {
            text::parse(text, root.offset(*place, text), &[], &names, &mut arena, root.diagnostics)
        };
        Some(list.iter().map(parse).collect::<Vec<ExprId>>())
    });
    let damping = damping.map(|rates| {
        let stated = rates.iter().filter(|rate| rate.copy.is_none_or(|copy| copy == 0));
        let texts: Vec<_> = stated.map(Rate::shown).collect();
        sources.push(format!("damping = [{}]", texts.join(", ")));
        let mut parse = |rate: &Rate<'_>| match rate.text {
            Some((text, place)) => {
                let indices: Vec<_> = rate.copy.iter().map(|&copy| ("i", copy)).collect();
                let offset = root.offset(place, text);
                text::parse(text, offset, &indices, &names, &mut arena, root.diagnostics)
            }
            None => arena.push(Node::Number(rate.value.clone()), Span::Whole),
        };
        rates.iter().map(&mut parse).collect()
    });
    let roots = [eta, tau, eta_in_space, tau_in_space, damping];
    let wrong = LISTS.iter().zip(&roots).any(|((key, _), roots)| root.has(key) && roots.is_none());
    if wrong || !sound {
        return None;
    }
    let energy = Formula { arena, root: None, parameters: kept, source: sources.join(", ") };
    Some(Acting { energy, roots })
}

/// The components of a list of expressions, or of one vector: those in the list may be vectors too, three components each.
pub(super) fn list(
    root: &Table<'_>,
    key: &str,
    example: &str,
    (names, dim): (&Names, usize),
) -> Option<(Vec<(String, Span)>, Span)> {
    let value = root.get(key)?;
    let (list, place) = match value.get_ref().as_str() {
        Some(text) if components(text, names).is_some() => {
            (vec![(text.to_owned(), span(value))], span(value))
        }
        _ => root.strings(key, "a list of expressions, or a vector", example)?,
    };
    if list.len() == dim {
        return Some((list, place));
    }
    let entries = |(text, place): (String, Span)| match components(&text, names) {
        Some(entries) => entries.map(|entry| (entry, place)).to_vec(),
        None => vec![(text, place)],
    };
    Some((list.into_iter().flat_map(entries).collect(), place))
}

/// A rate of damping as the file states it.
pub(super) struct Rate<'a> {
    /// Its text and the place of that, where it is no number.
    text: Option<(&'a str, Span)>,
    /// The number of the copy, where the list is that of one copy.
    copy: Option<i64>,
    /// Its value, at the defaults of parameters.
    pub value: Rational,
}

impl Rate<'_> {
    fn shown(&self) -> String {
        self.text
            .map_or_else(|| nearest_float(&self.value).to_string(), |(text, _)| text.to_owned())
    }
}

/// Reads `damping`: a number, or a list of one for each coordinate. None where all of them are the number 0.
pub(super) fn damping<'a>(root: &Table<'a>, algebra: Option<&LieAlgebra>) -> Option<Vec<Rate<'a>>> {
    let value = root.get("damping")?;
    let list = value.get_ref().as_array();
    let numbers = match list {
        Some(_) => coordinates(root, "damping", DAMPING, algebra)?.0,
        None => vec![root.exact("damping", value, DAMPING)?; algebra?.dim()],
    };
    if numbers.iter().any(Signed::is_negative) {
        let what = "`damping` must not be negative: the energy would rise";
        root.refuse(span(value), what, DAMPING);
        return None;
    }
    let count = list.map_or(1, |list| list.len());
    let of_copy = list.is_some() && count < numbers.len();
    let rate = |(at, number): (usize, Rational)| {
        let stated = list.map_or(value, |list| &list[at % count]);
        let copy = of_copy.then_some((at / count) as i64);
        let text = stated.get_ref().as_str().map(|text| (text, span(stated)));
        Rate { text, copy, value: number }
    };
    let rates: Vec<_> = numbers.into_iter().enumerate().map(rate).collect();
    rates.iter().any(|rate| rate.text.is_some() || !rate.value.is_zero()).then_some(rates)
}
