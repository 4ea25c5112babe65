//! Lowering: the programs a step runs.

use std::collections::BTreeMap;

use crate::graph::{Graph, Id, Program, SlotPolynomial, SlotTerm, lower};
use crate::integrator::coefficients::{BaseTerm, Coefficients, Contribution};
use crate::poly::{Factors, Polynomial, split_at};

/// S(p).
pub(crate) fn value_program(
    coefficients: &mut Coefficients,
    dim: usize,
    terms: &[BaseTerm],
) -> Program {
    let polynomial = value(coefficients, terms);
    let graph = Graph::new();
    graph.finish(dim, &[lower(&graph, &polynomial)])
}

/// Several polynomials of the same inputs: the predictor's components.
pub(crate) fn vector_program(
    coefficients: &mut Coefficients,
    dim: usize,
    components: &[Vec<BaseTerm>],
) -> Program {
    let graph = Graph::new();
    let outputs: Vec<Id> = components
        .iter()
        .map(|terms| {
            let polynomial = value(coefficients, terms);
            lower(&graph, &polynomial)
        })
        .collect();
    graph.finish(dim, &outputs)
}

/// ∂S/∂p, lowered once for all programs that have it.
pub(crate) struct Gradient<'a> {
    with: Vec<Vec<&'a BaseTerm>>,
    graph: Graph,
    entries: Vec<GradientEntry>,
}

impl<'a> Gradient<'a> {
    /// The gradient of these terms.
    pub(crate) fn new(coefficients: &mut Coefficients, dim: usize, terms: &'a [BaseTerm]) -> Self {
        let with = by_coordinate(terms, dim);
        let graph = Graph::new();
        let entries = with
            .iter()
            .enumerate()
            .map(|(i, terms)| gradient_entry(coefficients, &graph, terms, i))
            .collect();
        Self { with, graph, entries }
    }

    /// ∂S/∂p alone.
    pub(crate) fn program(self) -> Program {
        let outputs: Vec<Id> = self.entries.iter().map(|entry| entry.gradient).collect();
        self.graph.finish(self.entries.len(), &outputs)
    }

    /// ∂S/∂p and the upper triangle of ∂²S/∂p², row by row; the Hessian only from terms S_k with
    /// k ≤ `truncation`.
    pub(crate) fn with_hessian(&self, coefficients: &mut Coefficients, truncation: u32) -> Program {
        let Self { with, entries, .. } = self;
        let graph = self.graph.clone();
        let dim = entries.len();
        let mut outputs: Vec<Id> = entries.iter().map(|entry| entry.gradient).collect();
        for (i, entry) in entries.iter().enumerate() {
            let kept = || with[i].iter().copied().filter(|term| term.order <= truncation);
            // ∂ᵢ(pᵢ G + B) = G + pᵢ ∂ᵢG: the diagonal shares G with the gradient, and keeps it whole
            // even where the rest of the Hessian is truncated.
            let bend = weighted(coefficients, kept(), &[(i, 2)], |term| {
                let m = term.exponent(i);
                m * m.saturating_sub(2)
            });
            outputs.push(graph.add(lower(&graph, &bend), entry.slope));
            for j in i + 1..dim {
                let mixed = weighted(coefficients, kept(), &[(i, 1), (j, 1)], |term| {
                    term.exponent(i) * term.exponent(j)
                });
                outputs.push(lower(&graph, &mixed));
            }
        }
        graph.finish(dim, &outputs)
    }
}

/// One coordinate of ∂S/∂p in the form pᵢ·G + B.
struct GradientEntry {
    gradient: Id,
    /// G, from the terms with pᵢ² or higher.
    slope: Id,
}

fn gradient_entry(
    coefficients: &mut Coefficients,
    graph: &Graph,
    terms: &[&BaseTerm],
    i: usize,
) -> GradientEntry {
    let terms = || terms.iter().copied();
    let slope = weighted(coefficients, terms(), &[(i, 2)], |term| match term.exponent(i) {
        m if m >= 2 => m,
        _ => 0,
    });
    let rest = weighted(coefficients, terms(), &[(i, 1)], |m| u32::from(m.exponent(i) == 1));
    let slope = lower(graph, &slope);
    let rest = lower(graph, &rest);
    let p = graph.input(i);
    let zero = graph.zero();
    let gradient = if slope == zero { rest } else { graph.times_plus(slope, p, rest) };
    GradientEntry { gradient, slope }
}

/// One summand weight · |slot| · |p|ᵈᵉᵍʳᵉᵉ of the bound on the truncated part of the Hessian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DefectTerm {
    /// The coefficient C of the term C pᵐ of S.
    pub slot: usize,
    /// The largest row-sum norm of the Hessian of pᵐ over the unit sphere, or a little more.
    pub weight: f64,
    /// The degree of the Hessian's entries.
    pub degree: u32,
}

/// The part that [`Gradient::with_hessian`] leaves out, bounded by Σ weight |C| |p|^degree in the row-sum norm,
/// |p| being the Euclidean norm in these units.
pub(crate) fn defect(
    coefficients: &mut Coefficients,
    terms: &[BaseTerm],
    hessian_truncation: u32,
    units: &[f64],
) -> Vec<DefectTerm> {
    let omitted = terms.iter().filter(|term| term.order > hessian_truncation);
    omitted
        .map(|term| DefectTerm {
            slot: coefficients.slot(term.base, 1),
            weight: hessian_norm(&term.factors.iter().map(|&(_, e)| e).collect::<Vec<_>>())
                / in_units(&term.factors, units),
            degree: term.factors.iter().map(|&(_, e)| e).sum::<u32>().saturating_sub(2),
        })
        .collect()
}

/// The factor of a monomial's value, given as (coordinate, exponent), where coordinates are multiplied by these.
pub(super) fn in_units(monomial: &[(u32, u32)], units: &[f64]) -> f64 {
    monomial.iter().map(|&(i, power)| units[i as usize].powi(power as i32)).product()
}

/// A bound on the row-sum norm of the Hessian of pᵐ for |p| = 1, from the bound of each entry; m
/// without its zeros.
fn hessian_norm(m: &[u32]) -> f64 {
    let entry = |i: usize, j: usize| {
        let mut rest = m.to_vec();
        let factor = f64::from(rest[i]);
        rest[i] = rest[i].saturating_sub(1);
        let factor = factor * f64::from(rest[j]);
        rest[j] = rest[j].saturating_sub(1);
        factor * sphere_maximum(&rest)
    };
    let row = |i: usize| (0..m.len()).map(|j| entry(i, j)).sum::<f64>();
    (0..m.len()).map(row).fold(0.0, f64::max)
}

/// The maximum of |pᵐ| on the unit sphere, Π (mᵢ/|m|)^{mᵢ/2}.
fn sphere_maximum(m: &[u32]) -> f64 {
    let degree = f64::from(m.iter().sum::<u32>());
    let power = |&e: &u32| (f64::from(e) / degree).powf(0.5 * f64::from(e));
    m.iter().filter(|&&e| e > 0).map(power).product()
}

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
