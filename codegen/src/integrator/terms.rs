//! From exact polynomials in (momenta, symbols) to polynomials in the momenta over slots.

use std::collections::BTreeMap;

use super::coefficients::{Coefficients, Contribution};
use crate::graph::{SlotPolynomial, SlotTerm};
use crate::poly::Polynomial;

/// A polynomial in the momenta whose coefficients are bases of a [`Coefficients`] table: S_h(p),
/// one component of the predictor, or the energy.
#[derive(Clone, Debug)]
pub struct BaseTerm {
    /// The exponent of each momentum coordinate.
    pub exponents: Vec<u32>,
    /// The number of the base coefficient.
    pub base: usize,
    /// The lowest power of h in the coefficient, k for a term of S_k.
    pub order: u32,
}

/// Collects Σ h^power · polynomial into terms over the first `dim` variables, the other variables
/// (opaque symbols) going into base coefficients.
pub fn collect<'a>(
    coefficients: &mut Coefficients,
    dim: usize,
    orders: impl IntoIterator<Item = (u32, &'a Polynomial)>,
) -> Vec<BaseTerm> {
    let mut grouped: BTreeMap<Vec<u32>, Vec<Contribution>> = BTreeMap::new();
    for (step_power, polynomial) in orders {
        for (exponents, factor) in polynomial.terms() {
            let (momenta, symbols) = exponents.split_at(dim);
            grouped.entry(momenta.to_vec()).or_default().push(Contribution {
                factor,
                step_power,
                symbol_powers: symbols.to_vec(),
            });
        }
    }
    grouped
        .into_iter()
        .map(|(exponents, contributions)| {
            let order = contributions.iter().map(|c| c.step_power).min().unwrap_or(0);
            BaseTerm { exponents, base: coefficients.add_base(contributions), order }
        })
        .collect()
}

/// The polynomial itself, over slots.
pub fn value(coefficients: &mut Coefficients, terms: &[BaseTerm]) -> SlotPolynomial {
    terms
        .iter()
        .map(|term| SlotTerm {
            exponents: term.exponents.clone(),
            slot: coefficients.slot(term.base, 1),
        })
        .collect()
}

/// The terms of Σ weight(m) C_m p^{m − shift}: derivatives, and the parts of derivatives that are
/// shared. Terms of weight 0 vanish; `weight` must be 0 wherever an exponent is below its shift.
pub fn weighted(
    coefficients: &mut Coefficients,
    terms: &[BaseTerm],
    shift: &[(usize, u32)],
    weight: impl Fn(&[u32]) -> u32,
) -> SlotPolynomial {
    let mut result = SlotPolynomial::new();
    for term in terms {
        let scale = weight(&term.exponents);
        if scale == 0 {
            continue;
        }
        let mut exponents = term.exponents.clone();
        for &(variable, by) in shift {
            exponents[variable] = exponents[variable].saturating_sub(by);
        }
        result.push(SlotTerm { exponents, slot: coefficients.slot(term.base, scale) });
    }
    result
}
