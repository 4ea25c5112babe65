//! Expression graphs: what a step computes, as shared multiplications and additions.
//!
//! Polynomials whose coefficients are numbered *slots* are lowered together into one [`Program`]:
//! Horner's scheme in several variables, powers and equal sub-expressions shared. Graphs and programs are those of
//! `coadjoint-program`, which every target reads.

use std::cmp::Reverse;
use std::collections::{BTreeSet, HashMap};
use std::hash::Hash;

use crate::cancel;

pub use coadjoint_program::{Cost, Graph, Id, Node, Program};

/// Above this many variables a polynomial is split by the first variable of its terms, so that the
/// work grows with the terms and not with terms times variables.
const WIDE: usize = 32;

/// One term: a folded coefficient times a monomial of the inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlotTerm {
    /// (input, exponent), ascending, exponents positive.
    pub factors: Vec<(u32, u32)>,
    /// The coefficient's number.
    pub slot: usize,
}

/// A polynomial in the inputs whose coefficients are slots.
pub(crate) type SlotPolynomial = Vec<SlotTerm>;

/// Adds the evaluation of `polynomial` to `graph` and returns its node.
///
/// Two schemes are tried, and the one with fewer new operations kept: greedy Horner on all terms,
/// and Horner on each parity class (terms whose exponents agree modulo 2), where all powers are
/// powers of squares. Systems with reflection symmetries split into few classes.
pub fn lower(graph: &Graph, polynomial: &[SlotTerm]) -> Id {
    if polynomial.is_empty() {
        return graph.zero();
    }
    let variables: BTreeSet<u32> =
        polynomial.iter().flat_map(|term| &term.factors).map(|&(variable, _)| variable).collect();
    if variables.len() > WIDE {
        let parts = grouped(polynomial, |term| term.factors.first().map(|&(first, _)| first));
        if parts.len() > 1 {
            return parts.iter().fold(graph.zero(), |sum, part| graph.add(lower(graph, part), sum));
        }
    }
    let mark = graph.mark();
    let id = horner(graph, polynomial.to_vec());
    let whole = graph.cost_since(mark).total();
    let classes = grouped(polynomial, odd);
    if classes.len() == 1 || classes.len() == polynomial.len() {
        return id;
    }
    graph.rewind(mark);
    let split = by_parity(graph, &classes);
    if graph.cost_since(mark).total() < whole {
        return split;
    }
    graph.rewind(mark);
    horner(graph, polynomial.to_vec())
}

/// The terms grouped by a key, groups in order of first appearance.
fn grouped<K: Eq + Hash>(
    polynomial: &[SlotTerm],
    key: impl Fn(&SlotTerm) -> K,
) -> Vec<Vec<SlotTerm>> {
    let mut places: HashMap<K, usize> = HashMap::new();
    let mut groups: Vec<Vec<SlotTerm>> = Vec::new();
    for term in polynomial {
        let place = *places.entry(key(term)).or_insert(groups.len());
        match groups.get_mut(place) {
            Some(group) => group.push(term.clone()),
            None => groups.push(vec![term.clone()]),
        }
    }
    groups
}

/// The exponents modulo 2, zeros left out.
fn odd(term: &SlotTerm) -> Vec<(u32, u32)> {
    term.factors.iter().filter(|(_, e)| e % 2 == 1).map(|&(variable, _)| (variable, 1)).collect()
}

fn by_parity(graph: &Graph, classes: &[Vec<SlotTerm>]) -> Id {
    let mut sum = graph.zero();
    for class in classes {
        let parity = match class.first() {
            Some(term) => odd(term),
            None => continue,
        };
        let mut rest = class.clone();
        rest.iter_mut().for_each(|term| divide(term, &parity));
        let value = horner(graph, rest);
        sum = match monomial(graph, &parity) {
            Some(factor) => graph.times_plus(value, factor, sum),
            None => graph.add(value, sum),
        };
    }
    sum
}

/// Divides a term by a monomial, as far as it goes.
fn divide(term: &mut SlotTerm, divisor: &[(u32, u32)]) {
    let mut divisor = divisor.iter().peekable();
    term.factors.retain_mut(|(variable, exponent)| {
        while divisor.next_if(|(other, _)| *other < *variable).is_some() {}
        let by = divisor.next_if(|(other, _)| *other == *variable).map_or(0, |&(_, by)| by);
        *exponent = exponent.saturating_sub(by);
        *exponent > 0
    });
}

/// The product of powers, or `None` for the empty product.
pub(super) fn monomial(graph: &Graph, factors: &[(u32, u32)]) -> Option<Id> {
    let mut product: Option<Id> = None;
    for &(variable, exponent) in factors {
        let power = graph.power(graph.input(variable as usize), exponent);
        product = Some(match product {
            Some(product) => graph.mul(product, power),
            None => power,
        });
    }
    product
}

/// The common factor of all terms.
fn content(terms: &[SlotTerm]) -> Vec<(u32, u32)> {
    let Some((first, rest)) = terms.split_first() else { return Vec::new() };
    let mut content = first.factors.clone();
    for term in rest {
        content.retain_mut(|(variable, shared)| {
            match term.factors.binary_search_by_key(variable, |&(other, _)| other) {
                Ok(at) => *shared = (*shared).min(term.factors[at].1),
                Err(_) => return false,
            }
            true
        });
    }
    content
}

/// The number of terms that contain a variable, and its lowest exponent there.
struct Occurrence {
    variable: u32,
    count: usize,
    lowest: u32,
}

/// Greedy Horner (Ceberio and Kreinovich 2004): take out what all terms share, then split on the
/// variable that occurs in most terms.
fn horner(graph: &Graph, mut terms: Vec<SlotTerm>) -> Id {
    cancel::check();
    if terms.is_empty() {
        return graph.zero();
    }
    let content = content(&terms);
    if let Some(factor) = monomial(graph, &content) {
        terms.iter_mut().for_each(|term| divide(term, &content));
        return graph.mul(factor, horner(graph, terms));
    }
    if let [only] = terms.as_slice() {
        return graph.slot(only.slot);
    }
    // No common factor and at least two distinct monomials: some variable splits the terms. How
    // many terms it occurs in, and its lowest exponent there:
    let mut occurrences: Vec<Occurrence> = Vec::new();
    for &(variable, exponent) in terms.iter().flat_map(|term| &term.factors) {
        match occurrences.iter_mut().find(|other| other.variable == variable) {
            Some(known) => {
                known.count += 1;
                known.lowest = known.lowest.min(exponent);
            }
            None => occurrences.push(Occurrence { variable, count: 1, lowest: exponent }),
        }
    }
    // Of equal counts the first variable.
    let most = occurrences.iter().max_by_key(|own| (own.count, Reverse(own.variable)));
    let Some(&Occurrence { variable, lowest, .. }) = most else {
        // Equal monomials twice (not normalised input): add them up.
        let slots: Vec<Id> = terms.iter().map(|t| graph.slot(t.slot)).collect();
        return slots.into_iter().reduce(|a, b| graph.add(a, b)).unwrap_or_else(|| graph.zero());
    };
    let has = |term: &SlotTerm| term.factors.iter().any(|&(other, _)| other == variable);
    let (mut with, without): (Vec<_>, Vec<_>) = terms.into_iter().partition(has);
    with.iter_mut().for_each(|term| divide(term, &[(variable, lowest)]));
    let power = graph.power(graph.input(variable as usize), lowest);
    graph.times_plus(horner(graph, with), power, horner(graph, without))
}
