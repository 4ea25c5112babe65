//! Lowered programs compute the polynomials they were made from.

use coadjoint_codegen::graph::{Graph, Node, SlotTerm, lower};
use proptest::prelude::*;

/// The polynomial term by term, the definition.
fn by_definition(terms: &[SlotTerm], inputs: &[f64], slots: &[f64]) -> f64 {
    let monomial = |term: &SlotTerm| {
        let powers = inputs.iter().zip(&term.exponents).map(|(x, &e)| x.powi(e as i32));
        powers.product::<f64>()
    };
    terms.iter().map(|term| slots[term.slot] * monomial(term)).sum()
}

/// Distinct monomials in three variables of degree up to 4 in each.
fn polynomial() -> impl Strategy<Value = Vec<SlotTerm>> {
    prop::collection::btree_set((0..5u32, 0..5u32, 0..5u32), 0..30).prop_map(|monomials| {
        let terms = monomials.into_iter().enumerate();
        terms.map(|(slot, (a, b, c))| SlotTerm { exponents: vec![a, b, c], slot }).collect()
    })
}

proptest! {
    #[test]
    fn programs_evaluate_their_polynomials(
        terms in polynomial(),
        other in polynomial(),
        inputs in prop::array::uniform3(-1.5..1.5f64),
    ) {
        let slots: Vec<f64> = (0..30).map(|i| 1.0 / f64::from(i + 3)).collect();
        let mut graph = Graph::new();
        let outputs = [lower(&mut graph, &terms), lower(&mut graph, &other)];
        let program = graph.finish(3, &outputs);
        let mut results = [f64::NAN; 2];
        program.run(&inputs, &slots, &mut Vec::new(), &mut results);
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
    let term = |a, b, slot| SlotTerm { exponents: vec![a, b], slot };
    let mut graph = Graph::new();
    let output = lower(&mut graph, &[term(2, 2, 0), term(4, 0, 1), term(0, 4, 2)]);
    let program = graph.finish(2, &[output]);
    assert!(program.cost().multiplications <= 7, "{:?}", program.cost());
}

#[test]
fn unused_nodes_are_left_out_and_operands_come_first() {
    let mut graph = Graph::new();
    let x = graph.input(0);
    let unused = graph.power(x, 7);
    let square = graph.power(x, 2);
    assert_ne!(unused, square);
    let program = graph.finish(1, &[square]);
    assert_eq!(program.nodes().len(), 2);
    assert_eq!(program.nodes()[0], Node::Input(0));
}
