//! A rigid body by the implicit midpoint rule: x = h Ω(p), p = (μ + Ad*μ)/2 to second order, by fixed points.
//!
//! Slots: the three 1/I, the step, and above which μ₃ a step is refused, μ₂ a state is unsound; the comoving rotation
//! about e₃ in a step.

use coadjoint_program::{Graph, Id, Kernel, KernelParts, Program, Programs};

use super::Sample;
use super::chance::Chance;

const TOLERANCE: f64 = 1e-14;
const NEAR: f64 = 2.0;

/// The body, its refusal and unsoundness set in where the coordinates reach these; with a comoving frame or without.
pub fn body(refuse: f64, unsound: f64, comoving: bool) -> Sample {
    let programs = Programs {
        guess: guess(),
        correct: correct(),
        accept: accept(),
        transport: transport(),
        frame: comoving.then(frame),
        sound: sound(),
        watch: watch(),
        matrix: matrix(),
    };
    let parts = KernelParts {
        dim: 3,
        element: 4,
        tolerance: TOLERANCE,
        near: NEAR,
        corrections: 30,
        programs,
    };
    let kernel = Kernel::new(parts).unwrap();
    let slots = vec![1.0, 1.0 / 2.0, 1.0 / 3.0, 0.02, refuse, unsound, 1e-3];
    Sample { kernel, slots, draw }
}

fn draw(_: &Kernel, chance: &mut Chance) -> (Vec<f64>, Vec<f64>) {
    let q: Vec<f64> = (0..4).map(|_| chance.number()).collect();
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    (q.iter().map(|x| x / norm).collect(), (0..3).map(|_| chance.number()).collect())
}

fn inputs(graph: &mut Graph, from: usize) -> [Id; 3] {
    std::array::from_fn(|i| graph.input(from + i))
}

fn cross(graph: &mut Graph, a: [Id; 3], b: [Id; 3]) -> [Id; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let away = graph.mul(a[k], b[j]);
        let away = graph.neg(away);
        graph.times_plus(a[j], b[k], away)
    })
}

fn largest(graph: &mut Graph, values: &[Id]) -> Id {
    let mut result = graph.zero();
    for &value in values {
        let value = graph.abs(value);
        result = graph.max(result, value);
    }
    result
}

/// 1 where a ≤ b, else 0.
fn flag(graph: &mut Graph, a: Id, b: Id, before: Id) -> Id {
    let zero = graph.zero();
    graph.select(a, b, before, zero)
}

/// μ itself; the constant is 1/max|μᵢ|.
fn guess() -> Program {
    let mut graph = Graph::new();
    let mu = inputs(&mut graph, 0);
    let scale = largest(&mut graph, &mu);
    let one = graph.constant(1.0);
    let inverse = graph.div(one, scale);
    graph.finish(3, &[mu[0], mu[1], mu[2], inverse])
}

fn correct() -> Program {
    let mut graph = Graph::new();
    let p = inputs(&mut graph, 0);
    let mu = inputs(&mut graph, 3);
    let inverse = graph.input(6);
    let h = graph.slot(3);
    let x: [Id; 3] = std::array::from_fn(|i| {
        let inertia = graph.slot(i);
        let rate = graph.mul(inertia, p[i]);
        graph.mul(h, rate)
    });
    let turned = cross(&mut graph, p, x);
    let half = graph.constant(0.5);
    let next: [Id; 3] = std::array::from_fn(|i| graph.times_plus(half, turned[i], mu[i]));
    let change: [Id; 3] = std::array::from_fn(|i| graph.sub(next[i], p[i]));
    let change = largest(&mut graph, &change);
    let moved = graph.mul(change, inverse);
    let bound = graph.mul(moved, half);
    graph.finish(7, &[next[0], next[1], next[2], x[0], x[1], x[2], bound, moved])
}

fn accept() -> Program {
    let mut graph = Graph::new();
    let mu = inputs(&mut graph, 0);
    let (bound, distance) = (graph.input(6), graph.input(7));
    let one = graph.constant(1.0);
    let tolerance = graph.constant(TOLERANCE);
    let near = graph.constant(NEAR);
    let most = graph.slot(4);
    let solved = flag(&mut graph, bound, tolerance, one);
    let close = flag(&mut graph, distance, near, solved);
    let inside = flag(&mut graph, mu[2], most, close);
    graph.finish(8, &[inside])
}

/// The Cayley map: the unit quaternion along (1, x/2), and the rotation of μ by its inverse.
fn transport() -> Program {
    let mut graph = Graph::new();
    let q: [Id; 4] = std::array::from_fn(|i| graph.input(i));
    let mu = inputs(&mut graph, 4);
    let x = inputs(&mut graph, 7);
    let half = graph.constant(0.5);
    let v: [Id; 3] = std::array::from_fn(|i| graph.mul(half, x[i]));
    let mut square = graph.constant(1.0);
    for &v in &v {
        square = graph.times_plus(v, v, square);
    }
    let one = graph.constant(1.0);
    let norm = graph.sqrt(square);
    let w = graph.div(one, norm);
    let r = multiply(&mut graph, q, v, w);
    let two = graph.constant(2.0);
    let factor = graph.div(two, square);
    let once = cross(&mut graph, mu, v);
    let twice = cross(&mut graph, once, v);
    let moved: [Id; 3] = std::array::from_fn(|i| {
        let sum = graph.add(once[i], twice[i]);
        graph.times_plus(factor, sum, mu[i])
    });
    graph.finish(10, &[r[0], r[1], r[2], r[3], moved[0], moved[1], moved[2]])
}

/// q · w(1, v).
fn multiply(graph: &mut Graph, q: [Id; 4], v: [Id; 3], w: Id) -> [Id; 4] {
    let u = [q[1], q[2], q[3]];
    let turned = cross(graph, u, v);
    let mut scalar = q[0];
    for i in 0..3 {
        let minus = graph.neg(u[i]);
        scalar = graph.times_plus(minus, v[i], scalar);
    }
    let scalar = graph.mul(scalar, w);
    let [a, b, c] = std::array::from_fn(|i| {
        let sum = graph.add(u[i], turned[i]);
        let sum = graph.times_plus(q[0], v[i], sum);
        graph.mul(sum, w)
    });
    [scalar, a, b, c]
}

/// A rotation about e₃, its angle half the slot times the steps, by the tangent of half of it.
fn frame() -> Program {
    let mut graph = Graph::new();
    let q: [Id; 4] = std::array::from_fn(|i| graph.input(i));
    let mu = inputs(&mut graph, 4);
    let times = graph.input(7);
    let rate = graph.slot(6);
    let angle = graph.mul(rate, times);
    let zero = graph.zero();
    let mut square = graph.constant(1.0);
    square = graph.times_plus(angle, angle, square);
    let one = graph.constant(1.0);
    let norm = graph.sqrt(square);
    let w = graph.div(one, norm);
    let r = multiply(&mut graph, q, [zero, zero, angle], w);
    graph.finish(8, &[r[0], r[1], r[2], r[3], mu[0], mu[1], mu[2]])
}

fn sound() -> Program {
    let mut graph = Graph::new();
    let mut square = graph.constant(-1.0);
    for i in 0..4 {
        let q = graph.input(i);
        square = graph.times_plus(q, q, square);
    }
    let off = graph.abs(square);
    let one = graph.constant(1.0);
    let tolerance = graph.constant(1e-9);
    let unit = flag(&mut graph, off, tolerance, one);
    let second = graph.input(5);
    let most = graph.slot(5);
    let inside = flag(&mut graph, second, most, unit);
    graph.finish(7, &[inside])
}

fn watch() -> Program {
    let mut graph = Graph::new();
    let mu = inputs(&mut graph, 4);
    let mut energy = graph.zero();
    for (i, &mu) in mu.iter().enumerate() {
        let inertia = graph.slot(i);
        let rate = graph.mul(inertia, mu);
        energy = graph.times_plus(rate, mu, energy);
    }
    graph.finish(7, &[energy])
}

fn matrix() -> Program {
    let mut graph = Graph::new();
    let q = graph.input(0);
    graph.finish(4, &[q])
}
