//! Derivatives of random programs against those that dual numbers carry along.

use coadjoint_program::{Argument, Function, Graph, Id, Program};

use crate::numbers::{Chance, Dual, evaluate};

const INPUTS: usize = 4;
const SLOTS: usize = 3;
const OUTPUTS: usize = 3;
const FUNCTIONS: [Function; 10] = [
    Function::Exp,
    Function::Ln,
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Atan,
    Function::Tanh,
    Function::Power(3, 2),
    Function::Power(-5, 3),
    Function::Power(-1, 2),
];

/// All arguments of the random programs.
fn arguments() -> Vec<Argument> {
    (0..INPUTS).map(Argument::Input).chain((0..SLOTS).map(Argument::Slot)).collect()
}

/// A program of all nodes and functions whose values stay of moderate size.
fn random(chance: &mut Chance) -> Program {
    let graph = Graph::new();
    let mut ids: Vec<Id> = (0..INPUTS).map(|i| graph.input(i)).collect();
    ids.extend((0..SLOTS).map(|i| graph.slot(i)));
    let [one, third, half] = [1.0, 1.0 / 3.0, 0.5].map(|value| graph.constant(value));
    for _ in 0..14 {
        let [a, b, c, d] = std::array::from_fn(|_| ids[chance.below(ids.len())]);
        // At least one, for roots and logarithms and as divisors.
        let positive = graph.times_plus(a, a, one);
        ids.push(match chance.below(13) {
            0 => graph.add(a, b),
            1 => graph.sub(a, b),
            2 => graph.mul(a, b),
            3 => graph.times_plus(a, b, c),
            4 => graph.div(b, positive),
            5 => graph.neg(a),
            6 => graph.abs(a),
            7 => graph.sqrt(positive),
            8 => graph.select(a, b, c, d),
            9 => {
                let k = graph.round(graph.mul(graph.round(b), third));
                graph.scale(graph.function(Function::Tanh, a), k)
            }
            10 => graph.times_plus(graph.exponent(positive), b, a),
            _ => {
                let function = FUNCTIONS[chance.below(FUNCTIONS.len())];
                let bounded = graph.function(Function::Atan, a);
                let bounded = match function {
                    Function::Ln | Function::Power(..) => positive,
                    _ => graph.mul(bounded, half),
                };
                graph.function(function, bounded)
            }
        });
    }
    let last = ids.len() - OUTPUTS;
    graph.finish(INPUTS, &ids[last..])
}

/// The derivative of each output along v.
fn by_duals(program: &Program, at: &[f64], v: &[f64]) -> Vec<f64> {
    let numbers: Vec<Dual> = at.iter().zip(v).map(|(&x, &v)| Dual(x, v)).collect();
    let (inputs, slots) = numbers.split_at(INPUTS);
    evaluate(program, inputs, slots).into_iter().map(|Dual(_, slope)| slope).collect()
}

/// The sums of the derivatives of the outputs in all inputs and slots, each times its weight.
fn by_reverse_mode(program: &Program, weights: &[f64]) -> Program {
    let graph = Graph::new();
    let inputs: Vec<Id> = (0..INPUTS).map(|i| graph.input(i)).collect();
    let slots = (0..SLOTS).map(|i| graph.slot(i));
    let variables: Vec<Id> = inputs.iter().copied().chain(slots).collect();
    let outputs = graph.call(program, &inputs).into_iter();
    let outputs: Vec<_> = outputs.zip(weights.iter().map(|&w| graph.constant(w))).collect();
    graph.finish(INPUTS, &graph.pull_back(&outputs, &variables))
}

fn close(found: f64, expected: f64, scale: f64, about: &str) {
    let bound = 1e-11 * (scale + found.abs());
    assert!((found - expected).abs() <= bound, "{about}: {found} is not {expected}");
}

#[test]
fn passes_agree_with_dual_numbers() {
    let mut chance = Chance(1);
    let of = arguments();
    let mut compared = 0;
    for _ in 0..400 {
        let program = random(&mut chance);
        let draw = |chance: &mut Chance, n| -> Vec<f64> {
            (0..n).map(|_| chance.between(-1.5, 1.5)).collect()
        };
        let (at, v) = (draw(&mut chance, of.len()), draw(&mut chance, of.len()));
        let w = draw(&mut chance, OUTPUTS);
        let (inputs, slots) = at.split_at(INPUTS);
        let with = |more: &[f64]| [inputs, more].concat();
        let expected = by_duals(&program, &at, &v);
        let scale = expected.iter().fold(1.0_f64, |most, value| most.max(value.abs()));
        // At a kink, or where a value leaves the range, nothing is to be compared.
        if scale >= 1e6 {
            continue;
        }
        let forward = program.push_forward(&of).run(&with(&v), slots);
        for (found, expected) in forward.iter().zip(&expected) {
            close(*found, *expected, scale, "forward mode");
        }
        let backward = by_reverse_mode(&program, &w).run(inputs, slots);
        let along: f64 = backward.iter().zip(&v).map(|(a, b)| a * b).sum();
        let size: f64 = backward.iter().zip(&v).map(|(a, b)| (a * b).abs()).sum();
        let expected: f64 = expected.iter().zip(&w).map(|(a, b)| a * b).sum();
        close(along, expected, scale + size, "reverse mode");
        // The Hessian's product with v is the derivative of the gradient along v.
        let gradient = program.gradient(&of);
        let expected = by_duals(&gradient, &at, &v);
        let scale = expected.iter().fold(scale, |most, value| most.max(value.abs()));
        if scale >= 1e6 {
            continue;
        }
        let hessian = gradient.push_forward(&of).run(&with(&v), slots);
        for (found, expected) in hessian.iter().zip(&expected) {
            close(*found, *expected, scale, "the Hessian's product");
        }
        compared += 1;
    }
    assert!(compared > 300, "{compared}");
}

/// ∇(q^(3/2)) at 0 is 0, not 0/0; what does not depend on an argument has the derivative 0 whatever it is.
#[test]
fn derivatives_are_numbers_where_there_is_one() {
    let graph = Graph::new();
    let (x, y, zero) = (graph.input(0), graph.input(1), graph.zero());
    let power = graph.function(Function::Power(3, 2), x);
    let one = graph.constant(1.0);
    let program = graph.finish(2, &[graph.select(y, zero, power, graph.div(one, y))]);
    assert_eq!(program.gradient(&[Argument::Input(0)]).run(&[0.0, 0.0], &[]), [0.0]);
    assert_eq!(program.gradient(&[Argument::Input(0)]).run(&[4.0, 0.0], &[]), [3.0]);
}

#[test]
fn outside_the_domain_the_derivative_is_not_a_number_either() {
    for function in [Function::Ln, Function::Power(1, 2), Function::Power(5, 3)] {
        let graph = Graph::new();
        let y = graph.function(function, graph.input(0));
        let slope = graph.finish(1, &[y]).gradient(&[Argument::Input(0)]);
        assert!(slope.run(&[-2.0], &[])[0].is_nan(), "{function:?}");
    }
    let graph = Graph::new();
    let y = graph.function(Function::Sin, graph.input(0));
    assert!(graph.finish(1, &[y]).gradient(&[Argument::Input(0)]).run(&[2e8], &[])[0].is_nan());
}
