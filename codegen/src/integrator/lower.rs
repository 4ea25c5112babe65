//! Lowering: the programs a step runs.

use super::coefficients::Coefficients;
use super::terms::{BaseTerm, value, weighted};
use crate::graph::{Graph, Id, Program, lower};

/// S(p).
pub fn value_program(coefficients: &mut Coefficients, dim: usize, terms: &[BaseTerm]) -> Program {
    let polynomial = value(coefficients, terms);
    let mut graph = Graph::new();
    let output = lower(&mut graph, &polynomial);
    graph.finish(dim, &[output])
}

/// Several polynomials of the same inputs: the predictor's components.
pub fn vector_program(
    coefficients: &mut Coefficients,
    dim: usize,
    components: &[Vec<BaseTerm>],
) -> Program {
    let mut graph = Graph::new();
    let outputs: Vec<Id> = components
        .iter()
        .map(|terms| {
            let polynomial = value(coefficients, terms);
            lower(&mut graph, &polynomial)
        })
        .collect();
    graph.finish(dim, &outputs)
}

/// ∂S/∂p alone.
pub fn gradient_program(
    coefficients: &mut Coefficients,
    dim: usize,
    terms: &[BaseTerm],
) -> Program {
    let mut graph = Graph::new();
    let outputs: Vec<Id> =
        (0..dim).map(|i| gradient_entry(coefficients, &mut graph, terms, i).gradient).collect();
    graph.finish(dim, &outputs)
}

/// ∂S/∂p and the upper triangle of ∂²S/∂p², row by row; the Hessian only from terms S_k with
/// k ≤ `hessian_truncation`.
pub fn hessian_program(
    coefficients: &mut Coefficients,
    dim: usize,
    terms: &[BaseTerm],
    hessian_truncation: u32,
) -> Program {
    let kept: Vec<BaseTerm> =
        terms.iter().filter(|term| term.order <= hessian_truncation).cloned().collect();
    let mut graph = Graph::new();
    let entries: Vec<GradientEntry> =
        (0..dim).map(|i| gradient_entry(coefficients, &mut graph, terms, i)).collect();
    let mut outputs: Vec<Id> = entries.iter().map(|entry| entry.gradient).collect();
    for (i, entry) in entries.iter().enumerate() {
        // ∂ᵢ(pᵢ G + B) = G + pᵢ ∂ᵢG: the diagonal shares G with the gradient, and keeps it whole
        // even where the rest of the Hessian is truncated.
        let bend = weighted(coefficients, &kept, &[(i, 2)], |m| m[i] * m[i].saturating_sub(2));
        let bend = lower(&mut graph, &bend);
        outputs.push(graph.add(bend, entry.slope));
        for j in i + 1..dim {
            let mixed = weighted(coefficients, &kept, &[(i, 1), (j, 1)], |m| m[i] * m[j]);
            outputs.push(lower(&mut graph, &mixed));
        }
    }
    graph.finish(dim, &outputs)
}

/// One coordinate of ∂S/∂p in the form pᵢ·G + B.
struct GradientEntry {
    gradient: Id,
    /// G, from the terms with pᵢ² or higher.
    slope: Id,
}

fn gradient_entry(
    coefficients: &mut Coefficients,
    graph: &mut Graph,
    terms: &[BaseTerm],
    i: usize,
) -> GradientEntry {
    let slope = weighted(coefficients, terms, &[(i, 2)], |m| if m[i] >= 2 { m[i] } else { 0 });
    let rest = weighted(coefficients, terms, &[(i, 1)], |m| u32::from(m[i] == 1));
    let slope = lower(graph, &slope);
    let rest = lower(graph, &rest);
    let p = graph.input(i);
    let zero = graph.zero();
    let gradient = if slope == zero { rest } else { graph.times_plus(slope, p, rest) };
    GradientEntry { gradient, slope }
}
