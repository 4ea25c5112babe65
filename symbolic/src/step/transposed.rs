//! Transposes of linear maps, by reverse differentiation of their programs.

use super::solving::inputs;
use crate::graph::{Graph, Id, Program};

/// x, ξ, δ, and anything ↦ aᵀξ + bᵀδ of the maps w ↦ a w, b w at x, which are linear.
pub(super) fn transposed(n: usize, maps: impl Fn(&Graph, &[Id], &[Id]) -> [Vec<Id>; 2]) -> Program {
    let graph = Graph::new();
    let [x, xi, delta, w] = [0, n, 2 * n, 3 * n].map(|from| inputs(&graph, from, n));
    let [a, b] = maps(&graph, &x, &w);
    let weighted: Vec<_> = a.into_iter().zip(xi).chain(b.into_iter().zip(delta)).collect();
    graph.finish(4 * n, &graph.pull_back(&weighted, &w))
}

/// The transpose of a program in some inputs, in which it is linear, at others: with weights on its outputs of these numbers ↦ the sums
/// of their derivatives in these inputs.
pub(super) fn back(
    graph: &Graph,
    program: &Program,
    at: &[Id],
    weights: &[(usize, Id)],
    of: impl IntoIterator<Item = usize>,
) -> Vec<Id> {
    let (own, count) = (Graph::new(), program.inputs());
    let known = inputs(&own, 0, count);
    let (outputs, factors) = (own.call(program, &known), inputs(&own, count, weights.len()));
    let pairs = weights.iter().zip(&factors).map(|(&(output, _), &w)| (outputs[output], w));
    let variables: Vec<Id> = of.into_iter().map(|i| known[i]).collect();
    let sums = own.pull_back(&pairs.collect::<Vec<_>>(), &variables);
    let transposed = own.finish(count + weights.len(), &sums);
    let weights = weights.iter().map(|(_, weight)| *weight);
    graph.call(&transposed, &at.iter().copied().chain(weights).collect::<Vec<_>>())
}
