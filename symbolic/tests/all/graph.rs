//! Lowered programs compute the polynomials they were made from.

use coadjoint_symbolic::graph::{Graph, Node, SlotTerm, lower};
use proptest::prelude::*;

/// The polynomial term by term, the definition.
fn by_definition(terms: &[SlotTerm], inputs: &[f64], slots: &[f64]) -> f64 {
    let monomial = |term: &SlotTerm| {
        let powers = term.factors.iter().map(|&(i, e)| inputs[i as usize].powi(e as i32));
        powers.product::<f64>()
    };
    terms.iter().map(|term| slots[term.slot] * monomial(term)).sum()
}

/// Distinct monomials in three variables of degree up to 4 in each.
fn polynomial() -> impl Strategy<Value = Vec<SlotTerm>> {
    prop::collection::btree_set((0..5u32, 0..5u32, 0..5u32), 0..30).prop_map(|monomials| {
        let terms = monomials.into_iter().enumerate();
        terms.map(|(slot, (a, b, c))| term(&[a, b, c], slot)).collect()
    })
}

fn term(exponents: &[u32], slot: usize) -> SlotTerm {
    let factors = (0..).zip(exponents.iter().copied()).filter(|&(_, exponent)| exponent > 0);
    SlotTerm { factors: factors.collect(), slot }
}

proptest! {
    #[test]
    fn programs_evaluate_their_polynomials(
        terms in polynomial(),
        other in polynomial(),
        inputs in prop::array::uniform3(-1.5..1.5f64),
    ) {
        let slots: Vec<f64> = (0..30).map(|i| 1.0 / f64::from(i + 3)).collect();
        let graph = Graph::new();
        let outputs = [lower(&graph, &terms), lower(&graph, &other)];
        let program = graph.finish(3, &outputs);
        let results = program.run(&inputs, &slots);
        for (result, terms) in results.iter().zip([&terms, &other]) {
            let expected = by_definition(terms, &inputs, &slots);
            prop_assert!((result - expected).abs() <= 1e-11 * (1.0 + expected.abs()));
        }
    }
}

#[test]
fn reflection_symmetric_terms_are_evaluated_in_squares() {
    // x²y² + x⁴ + y⁴: term by term it takes 9 products; Horner in squares
    // takes 7.
    let graph = Graph::new();
    let output = lower(&graph, &[term(&[2, 2], 0), term(&[4, 0], 1), term(&[0, 4], 2)]);
    let program = graph.finish(2, &[output]);
    assert!(program.cost().multiplications <= 7, "{:?}", program.cost());
}

#[test]
fn unused_nodes_are_left_out_and_operands_come_first() {
    let graph = Graph::new();
    let x = graph.input(0);
    let unused = graph.power(x, 7);
    let square = graph.power(x, 2);
    assert_ne!(unused, square);
    let program = graph.finish(1, &[square]);
    assert_eq!(program.nodes().len(), 2);
    assert_eq!(program.nodes()[0], Node::Input(0));
}

#[test]
fn many_variables_cost_in_proportion_to_the_terms() {
    // Σ cᵢ xᵢ² xᵢ₊₁ on a line, beyond the width where all terms are looked at together.
    let operations = |sites: u32| {
        let terms: Vec<SlotTerm> = (0..sites)
            .map(|i| SlotTerm { factors: vec![(i, 2), (i + 1, 1)], slot: i as usize })
            .collect();
        let inputs: Vec<f64> = (0..=sites).map(|i| 0.5 + f64::from(i % 7) / 4.0).collect();
        let slots: Vec<f64> = (0..sites).map(|i| 1.0 / f64::from(i + 1)).collect();
        let graph = Graph::new();
        let output = lower(&graph, &terms);
        let program = graph.finish(sites as usize + 1, &[output]);
        let value = program.run(&inputs, &slots);
        let expected = by_definition(&terms, &inputs, &slots);
        assert!((value[0] - expected).abs() <= 1e-13 * expected.abs());
        program.cost().total()
    };
    // A power, two products and a sum for each term.
    assert_eq!(operations(400) - operations(200), operations(600) - operations(400));
    assert!(operations(400) <= 4 * 400);
}
