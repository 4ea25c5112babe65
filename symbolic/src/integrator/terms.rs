//! From exact polynomials in (momenta, symbols) to polynomials in the momenta over slots.

use std::collections::BTreeMap;

use super::coefficients::{BaseTerm, Coefficients, Contribution};
use crate::graph::{SlotPolynomial, SlotTerm};
use crate::poly::{Factors, Polynomial, split_at};

/// Collects Σ h^power · polynomial into terms over the first `dim` variables, the other variables
/// (opaque symbols) going into base coefficients.
pub(crate) fn collect<'a>(
    coefficients: &mut Coefficients,
    dim: usize,
    orders: impl IntoIterator<Item = (u32, &'a Polynomial)>,
) -> Vec<BaseTerm> {
    let mut grouped: BTreeMap<Factors, Vec<Contribution>> = BTreeMap::new();
    for (step_power, polynomial) in orders {
        let symbols = polynomial.variables().saturating_sub(dim);
        for (factors, factor) in polynomial.factors() {
            let (momenta, powers) = split_at(&factors, dim);
            let mut symbol_powers = vec![0; symbols];
            for &(variable, power) in powers {
                symbol_powers[variable as usize - dim] = power;
            }
            let contribution = Contribution { factor, step_power, symbol_powers };
            grouped.entry(Factors(momenta.into())).or_default().push(contribution);
        }
    }
    grouped
        .into_iter()
        .map(|(factors, contributions)| {
            let order = contributions.iter().map(|c| c.step_power).min().unwrap_or(0);
            let base = coefficients.add_base(contributions);
            BaseTerm { factors: factors.0.into(), base, order }
        })
        .collect()
}

/// For each coordinate the terms in which it occurs.
pub(crate) fn by_coordinate(terms: &[BaseTerm], dim: usize) -> Vec<Vec<&BaseTerm>> {
    let mut result = vec![Vec::new(); dim];
    for term in terms {
        for &(coordinate, _) in &term.factors {
            result[coordinate as usize].push(term);
        }
    }
    result
}

/// The polynomial itself, over slots.
pub(crate) fn value(coefficients: &mut Coefficients, terms: &[BaseTerm]) -> SlotPolynomial {
    terms
        .iter()
        .map(|term| SlotTerm {
            factors: term.factors.clone(),
            slot: coefficients.slot(term.base, 1),
        })
        .collect()
}

/// The terms of Σ weight(m) C_m p^{m − shift}: derivatives, and the parts of derivatives that are
/// shared. Terms of weight 0 vanish; `weight` must be 0 wherever an exponent is below its shift.
pub(crate) fn weighted<'a>(
    coefficients: &mut Coefficients,
    terms: impl IntoIterator<Item = &'a BaseTerm>,
    shift: &[(usize, u32)],
    weight: impl Fn(&BaseTerm) -> u32,
) -> SlotPolynomial {
    let mut result = SlotPolynomial::new();
    for term in terms {
        let scale = weight(term);
        if scale == 0 {
            continue;
        }
        let mut factors = term.factors.clone();
        for (coordinate, exponent) in &mut factors {
            let by = shift.iter().filter(|(i, _)| *i == *coordinate as usize).map(|(_, by)| by);
            *exponent = exponent.saturating_sub(by.sum());
        }
        factors.retain(|&(_, exponent)| exponent > 0);
        result.push(SlotTerm { factors, slot: coefficients.slot(term.base, scale) });
    }
    result
}
