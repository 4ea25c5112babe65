//! Horner's scheme in several variables, with shared powers.

use super::node::{Graph, Id};

/// One term: a folded coefficient times a monomial of the inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlotTerm {
    /// The exponent of each input.
    pub exponents: Vec<u32>,
    /// The coefficient's number.
    pub slot: usize,
}

/// A polynomial in the inputs whose coefficients are slots.
pub type SlotPolynomial = Vec<SlotTerm>;

/// Adds the evaluation of `polynomial` to `graph` and returns its node.
///
/// Two schemes are tried, and the one with fewer new operations kept: greedy Horner on all terms,
/// and Horner on each parity class (terms whose exponents agree modulo 2), where all powers are
/// powers of squares. Systems with reflection symmetries split into few classes.
pub fn lower(graph: &mut Graph, polynomial: &[SlotTerm]) -> Id {
    if polynomial.is_empty() {
        return graph.zero();
    }
    let mark = graph.mark();
    let id = horner(graph, polynomial.to_vec());
    let whole = graph.cost_since(mark).total();
    let classes = parity_classes(polynomial);
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

/// The terms grouped by exponents modulo 2, groups in order of first appearance.
fn parity_classes(polynomial: &[SlotTerm]) -> Vec<Vec<SlotTerm>> {
    let mut classes: Vec<(Vec<u32>, Vec<SlotTerm>)> = Vec::new();
    for term in polynomial {
        let parity: Vec<u32> = term.exponents.iter().map(|e| e % 2).collect();
        match classes.iter_mut().find(|(known, _)| *known == parity) {
            Some((_, members)) => members.push(term.clone()),
            None => classes.push((parity, vec![term.clone()])),
        }
    }
    classes.into_iter().map(|(_, members)| members).collect()
}

fn by_parity(graph: &mut Graph, classes: &[Vec<SlotTerm>]) -> Id {
    let mut sum = graph.zero();
    for class in classes {
        let parity: Vec<u32> = match class.first() {
            Some(term) => term.exponents.iter().map(|e| e % 2).collect(),
            None => continue,
        };
        let rest = class.iter().map(|term| divide(term, &parity)).collect();
        let value = horner(graph, rest);
        sum = match monomial(graph, &parity) {
            Some(factor) => graph.times_plus(value, factor, sum),
            None => graph.add(value, sum),
        };
    }
    sum
}

fn divide(term: &SlotTerm, divisor: &[u32]) -> SlotTerm {
    let exponents = term.exponents.iter().zip(divisor).map(|(e, d)| e - d).collect();
    SlotTerm { exponents, slot: term.slot }
}

/// The product of powers, or `None` for the empty product.
pub(super) fn monomial(graph: &mut Graph, exponents: &[u32]) -> Option<Id> {
    let mut product: Option<Id> = None;
    for (index, &exponent) in exponents.iter().enumerate() {
        if exponent > 0 {
            let input = graph.input(index);
            let power = graph.power(input, exponent);
            product = Some(match product {
                Some(product) => graph.mul(product, power),
                None => power,
            });
        }
    }
    product
}

/// Greedy Horner (Ceberio and Kreinovich 2004): take out what all terms share, then split on the
/// variable that occurs in most terms.
fn horner(graph: &mut Graph, mut terms: Vec<SlotTerm>) -> Id {
    let Some(first) = terms.first() else {
        return graph.zero();
    };
    let variables = first.exponents.len();
    let mut content = first.exponents.clone();
    for term in &terms {
        for (shared, &e) in content.iter_mut().zip(&term.exponents) {
            *shared = (*shared).min(e);
        }
    }
    if let Some(factor) = monomial(graph, &content) {
        for term in &mut terms {
            *term = divide(term, &content);
        }
        let rest = horner(graph, terms);
        return graph.mul(factor, rest);
    }
    if let [only] = terms.as_slice() {
        return graph.slot(only.slot);
    }
    // No common factor and at least two distinct monomials: some variable splits the terms.
    let occurrences = |v: usize| terms.iter().filter(|term| term.exponents[v] > 0).count();
    let variable = (0..variables).rev().max_by_key(|&v| occurrences(v)).unwrap_or(0);
    let lowest = terms.iter().map(|t| t.exponents[variable]).filter(|&e| e > 0).min();
    let Some(lowest) = lowest else {
        // Equal monomials twice (not normalised input): add them up.
        let slots: Vec<Id> = terms.iter().map(|t| graph.slot(t.slot)).collect();
        return slots.into_iter().reduce(|a, b| graph.add(a, b)).unwrap_or_else(|| graph.zero());
    };
    let (mut with, without): (Vec<_>, Vec<_>) =
        terms.into_iter().partition(|term| term.exponents[variable] > 0);
    for term in &mut with {
        term.exponents[variable] -= lowest;
    }
    let input = graph.input(variable);
    let power = graph.power(input, lowest);
    let quotient = horner(graph, with);
    let remainder = horner(graph, without);
    graph.times_plus(quotient, power, remainder)
}
