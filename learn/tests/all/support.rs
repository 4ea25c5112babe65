//! Truths, data and random models that several tests use.

use coadjoint::groups::Chart;
use coadjoint_learn::data::{PairRows, PhasePair, ReducedData, RowPolicy, TOLERANCE, reduce};
use coadjoint_learn::network::DenseNetwork;
use coadjoint_learn::polynomial::{Basis, PolynomialModel, Scaling};
use coadjoint_learn::truth::{Bump, MomentumBox, Relativistic, phase_pairs};
use coadjoint_learn::{DataGroup, MomentumFunction, matrix_of};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::json;

/// [−2, 2]ⁿ.
pub const WIDE: MomentumBox = MomentumBox { low: -2.0, high: 2.0 };

/// A body with a bump, which no polynomial is exact on.
pub fn bump() -> Bump {
    Bump {
        weights: vec![1.0 / 1.5, 0.5, 0.4],
        height: 1.5,
        sharpness: vec![1.2, 0.7, 0.9],
        centre: vec![0.5, -0.3, 0.8],
    }
}

/// Another truth that is no polynomial.
pub fn relativistic() -> Relativistic {
    Relativistic { weights: vec![1.0 / 1.5, 0.5, 0.4], ripple: 0.3 }
}

/// Pairs as CSV: `mu_…`, `mu_next_…`, `g_…`, `g_next_…`.
pub fn csv_of<G: DataGroup>(group: &G, pairs: &[PhasePair<G>]) -> String {
    let (dim, size) = (group.dim(), group.matrix_size());
    let entries = || (1..=size).flat_map(|i| (1..=size).map(move |j| format!("{i}{j}")));
    let momentum = |name: &'static str| (1..=dim).map(move |i| format!("{name}_{i}"));
    let attitude = |name: &'static str| entries().map(move |at| format!("{name}_{at}"));
    let names = momentum("mu").chain(momentum("mu_next"));
    let names = names.chain(attitude("g")).chain(attitude("g_next")).collect::<Vec<_>>();
    let line = |pair: &PhasePair<G>| {
        let ends = [&pair.before, &pair.after];
        let momenta = ends.into_iter().flat_map(|end| (0..dim).map(|i| end.momentum[i]));
        let attitudes = ends.into_iter().flat_map(|end| {
            let g = matrix_of(group, &end.group_element).transpose();
            g.iter().copied().collect::<Vec<_>>()
        });
        let cells = momenta.chain(attitudes).map(|value| value.to_string());
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    names.join(",") + "\n" + &pairs.iter().map(line).collect::<String>()
}

/// Exact pairs, one step apart, and their reduction.
pub fn sample<G: DataGroup, C: Chart<G>>(
    group: &G,
    truth: &impl MomentumFunction,
    (step, momenta): (f64, MomentumBox),
    count: usize,
    seed: u64,
) -> (PairRows<G>, ReducedData) {
    let rows: PairRows<G> = phase_pairs(group, truth, step, momenta, count, seed).into();
    let reduced = reduce::<G, C>(group, &rows, TOLERANCE, RowPolicy::Refuse);
    (rows, reduced.unwrap().data)
}

pub fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// Uniform numbers in [−size, size].
pub fn draw(rng: &mut ChaCha8Rng, count: usize, size: f64) -> Vec<f64> {
    (0..count).map(|_| size * (2.0 * rng.random::<f64>() - 1.0)).collect()
}

fn scaling(dim: usize) -> Scaling {
    Scaling { centre: vec![0.1; dim], half_width: vec![2.0; dim] }
}

pub fn random_polynomial(dim: usize, rng: &mut ChaCha8Rng) -> PolynomialModel {
    let basis = Basis::new(dim, 4);
    let coefficients = draw(rng, basis.terms().len(), 0.1 / dim as f64);
    PolynomialModel::zero(basis, scaling(dim)).with_coefficients(&coefficients)
}

pub fn random_network(dim: usize, rng: &mut ChaCha8Rng) -> DenseNetwork {
    let mut layer = |inputs: usize, outputs: usize| {
        let weights = draw(rng, inputs * outputs, 0.5);
        json!({ "inputs": inputs, "weights": weights, "biases": draw(rng, outputs, 0.5) })
    };
    let hidden = [layer(dim, 20), layer(20, 10)];
    let (mean, output) = (draw(rng, dim, 0.3), draw(rng, 10, 0.5));
    let network = json!({
        "activation": "tanh", "scaling": scaling(dim), "mean": mean, "scale": 0.4,
        "hidden": hidden, "output": output,
    });
    serde_json::from_value(network).unwrap()
}
