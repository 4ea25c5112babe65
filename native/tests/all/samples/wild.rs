//! Kernels of random programs over all kinds of nodes: no step of anything, but every branch of the loop.

use coadjoint_program::{Graph, Id, Kernel, KernelParts, Program, Programs};

use super::Sample;
use super::chance::Chance;

/// Shape of a random kernel.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub dim: usize,
    pub element: usize,
    pub constants: usize,
    pub slots: usize,
    /// Nodes of each program, roughly.
    pub nodes: usize,
    pub corrections: u32,
    pub comoving: bool,
    /// Flows between kicks; 0 without kicks.
    pub flows: u32,
}

pub fn kernel(shape: Shape, chance: &mut Chance) -> Sample {
    let Shape { dim: n, element: m, constants: k, .. } = shape;
    let programs = Programs {
        guess: random(shape, n, n + k, None, chance),
        correct: random(shape, 2 * n + k, 2 * n + 2, None, chance),
        accept: rarely_no(shape, 2 * n + 2, 4, Some(0), chance),
        transport: random(shape, m + 2 * n, m + n, Some(m), chance),
        frame: shape.comoving.then(|| random(shape, m + n + 1, m + n, None, chance)),
        sound: rarely_no(shape, m + n, 2, None, chance),
        watch: random(shape, m + n, 1, None, chance),
        matrix: random(shape, m, m, None, chance),
    };
    let parts = KernelParts {
        dim: n,
        element: m,
        tolerance: 0.5,
        near: 3.0,
        corrections: shape.corrections,
        programs,
    };
    let mut kernel = Kernel::new(parts).unwrap();
    if shape.flows > 0 {
        let kick = random(shape, m + n, n, None, chance);
        kernel = kernel.with_kicks(kick, shape.flows).unwrap();
    }
    let slots = (0..kernel.slots()).map(|_| chance.number()).collect();
    Sample { kernel, slots, draw }
}

fn draw(kernel: &Kernel, chance: &mut Chance) -> (Vec<f64>, Vec<f64>) {
    let special = [0.0, -0.0, f64::INFINITY, f64::NAN, 5e-324, 1e300];
    let mut list = |count: usize| {
        let mut number = || match chance.below(40) {
            0 => special[chance.below(special.len())],
            _ => 2.0 * chance.number(),
        };
        (0..count).map(|_| number()).collect::<Vec<f64>>()
    };
    let g = list(kernel.element());
    (g, list(kernel.dim()))
}

/// A random graph on the inputs; its nodes, the last of them using most of it.
fn grow(graph: &mut Graph, shape: Shape, inputs: usize, chance: &mut Chance) -> Vec<Id> {
    let mut ids: Vec<Id> = (0..inputs).map(|i| graph.input(i)).collect();
    ids.extend((0..shape.slots).map(|i| graph.slot(i)));
    ids.extend([graph.zero(), graph.epsilon()]);
    ids.extend([1.0, -1.0, 0.3, 1e-200, f64::MAX].map(|value| graph.constant(value)));
    for _ in 0..shape.nodes {
        // Of late nodes more often, so that little is left unused.
        let recent = ids.len().min(20);
        let [a, b, c, d] = std::array::from_fn(|_| match chance.below(3) {
            0 => ids[chance.below(ids.len())],
            _ => ids[ids.len() - 1 - chance.below(recent)],
        });
        ids.push(match chance.below(13) {
            0 | 1 => graph.add(a, b),
            2 | 3 => graph.sub(a, b),
            4 => graph.mul(a, b),
            5 | 6 => graph.times_plus(a, b, c),
            7 => graph.div(a, b),
            8 => graph.neg(a),
            9 => graph.abs(a),
            10 => graph.sqrt(a),
            11 => graph.round(a),
            _ => graph.select(a, b, c, d),
        });
    }
    ids
}

/// Between −2 and 2, and a number whatever a is.
fn within(graph: &mut Graph, a: Id) -> Id {
    let (low, high) = (graph.constant(-2.0), graph.constant(2.0));
    let below = graph.min(a, high);
    graph.select(low, below, below, low)
}

/// Random results; the one of number `restless` goes through the logistic map, so that steps are not all alike.
fn random(
    shape: Shape,
    inputs: usize,
    outputs: usize,
    restless: Option<usize>,
    chance: &mut Chance,
) -> Program {
    let mut graph = Graph::new();
    let ids = grow(&mut graph, shape, inputs, chance);
    let mut results = Vec::new();
    for _ in 0..outputs {
        let from = ids.len() - 1 - chance.below(ids.len().min(3 * outputs));
        // Now and then the bare value, which may be an input or not a number.
        results.push(match chance.below(8) {
            0 => ids[chance.below(ids.len())],
            _ => within(&mut graph, ids[from]),
        });
    }
    if let Some(i) = restless {
        let x = graph.input(i);
        let (one, factor) = (graph.constant(1.0), graph.constant(3.99));
        let rest = graph.sub(one, x);
        let product = graph.mul(x, rest);
        let product = graph.mul(factor, product);
        results[i] = within(&mut graph, product);
    }
    graph.finish(inputs, &results)
}

/// 1, but 0 where a few conditions hold at once, or a restless input comes near its peak.
fn rarely_no(
    shape: Shape,
    inputs: usize,
    conditions: usize,
    restless: Option<usize>,
    chance: &mut Chance,
) -> Program {
    let mut graph = Graph::new();
    let ids = grow(&mut graph, shape, inputs, chance);
    let one = graph.constant(1.0);
    let mut result = graph.zero();
    for _ in 0..conditions {
        let late = ids.len().div_ceil(2);
        let [a, b] = std::array::from_fn(|_| ids[ids.len() - 1 - chance.below(late)]);
        result = graph.select(a, b, result, one);
    }
    if let Some(i) = restless {
        let (x, peak, zero) = (graph.input(i), graph.constant(0.99), graph.zero());
        result = graph.select(x, peak, result, zero);
    }
    graph.finish(inputs, &[result])
}
