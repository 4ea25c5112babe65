//! The geometry of learned maps, for models of every kind and any weights: the runtime's laws.
#![allow(clippy::unwrap_used)]

use coadjoint::groups::{Cayley, Chart, Coordinates, Exponential};
use coadjoint::laws::check;
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_learn::data::{ReducedData, RowPolicy, Tolerances, reduce};
use coadjoint_learn::network::{Activation, DenseNetwork, Layer};
use coadjoint_learn::polynomial::{Basis, PolynomialModel, Scaling, fit_polynomial};
use coadjoint_learn::truth::{MomentumBox, Quadratic, Relativistic, phase_pairs};
use coadjoint_learn::{
    DataGroup, GaussianProcessOptions, Generating, Model, MomentumFunction, fit_gaussian_process,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Uniform numbers in [−size, size].
fn draw(rng: &mut ChaCha8Rng, count: usize, size: f64) -> Vec<f64> {
    (0..count).map(|_| size * (2.0 * rng.random::<f64>() - 1.0)).collect()
}

fn scaling(dim: usize) -> Scaling {
    Scaling { centre: vec![0.1; dim], half_width: vec![2.0; dim] }
}

fn random_polynomial(dim: usize, rng: &mut ChaCha8Rng) -> PolynomialModel {
    let basis = Basis::new(dim, 4);
    let coefficients = draw(rng, basis.len(), 0.1 / dim as f64);
    PolynomialModel::zero(basis, scaling(dim)).with_coefficients(&coefficients)
}

fn random_network(dim: usize, activation: Activation, rng: &mut ChaCha8Rng) -> DenseNetwork {
    let hidden = vec![
        Layer { inputs: dim, weights: draw(rng, 20 * dim, 0.5), biases: draw(rng, 20, 0.5) },
        Layer { inputs: 20, weights: draw(rng, 200, 0.5), biases: draw(rng, 10, 0.5) },
    ];
    let (mean, output) = (draw(rng, dim, 0.3), draw(rng, 10, 0.5));
    DenseNetwork::new(activation, scaling(dim), mean, 0.4, hidden, output).unwrap()
}

/// The bars. Derivatives in the laws are differences of eighth order, good to 1e-11 or so.
fn keeps_the_geometry<G: LieGroup<Scalar = f64>, C: Chart<G>>(
    group: &G,
    name: &str,
    // Not a type for each model: the laws are compiled once for each group and chart.
    function: &dyn MomentumFunction,
) {
    let dim = group.dim();
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let mut vector = |size| {
        let entries = draw(&mut rng, dim, size);
        G::Vector::from_entries(dim, |i| entries[i])
    };
    let points: Vec<_> =
        (0..4).map(|_| Phase::<G>::new(group.exp(&vector(1.0)), vector(1.2))).collect();
    let map = Generating::<G, C, _>::new(group.clone(), function);
    for point in &points {
        let moved = coadjoint::steps::poisson_map(&map, &point.momentum).unwrap();
        let way = (0..dim).map(|i| (moved[i] - point.momentum[i]).abs()).fold(0.0, f64::max);
        assert!(way > 1e-3, "{name}: the map must do something");
    }
    let laws = check(&map, None, &points).unwrap();
    for (law, bar) in [
        ("poisson", 1e-10),
        ("symplectic", 1e-10),
        ("equivariant", 1e-10),
        ("momentum", 1e-14),
        ("casimirs", 1e-13),
    ] {
        let found = laws.iter().find(|l| l.name == law).unwrap();
        println!("{name} {} {law}: {:.1e}", C::NAME, found.value);
        assert!(found.value <= bar, "{name}, {}: {law} {:e}", C::NAME, found.value);
    }
}

fn random_weights<G: LieGroup<Scalar = f64>, C: Chart<G>>(group: &G) {
    let dim = group.dim();
    for seed in 0..3 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        keeps_the_geometry::<G, C>(group, "random polynomial", &random_polynomial(dim, &mut rng));
        for activation in [Activation::Tanh, Activation::Logistic] {
            let network = random_network(dim, activation, &mut rng);
            keeps_the_geometry::<G, C>(group, "random network", &network);
            let polynomial = random_polynomial(dim, &mut rng);
            let hybrid = Model::Hybrid { polynomial, network };
            keeps_the_geometry::<G, C>(group, "random hybrid", &hybrid);
        }
    }
}

#[test]
fn random_weights_on_so3() {
    random_weights::<_, Exponential>(&SO3::new());
    random_weights::<_, Cayley>(&SO3::new());
}

#[test]
fn random_weights_on_se3() {
    random_weights::<_, Exponential>(&SE3::new());
}

fn data<G: DataGroup, C: Chart<G>>(
    group: &G,
    truth: &impl MomentumFunction,
    count: usize,
) -> ReducedData {
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let rows = phase_pairs(group, truth, 0.2, wide, count, 1).into();
    reduce::<G, C>(group, &rows, Tolerances::default(), RowPolicy::Refuse).unwrap().data
}

fn fitted<G: DataGroup, C: Chart<G>>(group: &G, truth: &impl MomentumFunction) {
    let train = data::<G, C>(group, truth, 80);
    let polynomial = fit_polynomial(&train, 3, 0.0).unwrap();
    keeps_the_geometry::<G, C>(group, "fitted polynomial", &polynomial);
    let options = GaussianProcessOptions { largest: 60, ..Default::default() };
    let process = fit_gaussian_process(&train, &options).unwrap();
    keeps_the_geometry::<G, C>(group, "Gaussian process", &process);
    trained_networks::<G, C>(group, &train);
}

fn trained_networks<G: DataGroup, C: Chart<G>>(group: &G, train: &ReducedData) {
    use coadjoint_learn::network::{TrainingOptions, fit_network};
    let options = TrainingOptions {
        widths: vec![16, 16],
        adam_steps: 20,
        lbfgs_steps: 60,
        ..Default::default()
    };
    let (network, _) = fit_network(&train.p, &train.x, None, &options, &mut |_| {}).unwrap();
    keeps_the_geometry::<G, C>(group, "trained network", &network);
    let (hybrid, _) =
        coadjoint_learn::fit_hybrid(&train.p, &train.x, 2, &options, &mut |_| {}).unwrap();
    keeps_the_geometry::<G, C>(group, "trained hybrid", &hybrid);
}

#[test]
fn fitted_models_on_so3() {
    let truth = Relativistic { weights: vec![1.0 / 1.5, 0.5, 0.4], ripple: 0.3 };
    fitted::<_, Exponential>(&SO3::new(), &truth);
    fitted::<_, Cayley>(&SO3::new(), &truth);
}

#[test]
fn fitted_models_of_the_heavy_top() {
    let top = Quadratic::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]);
    fitted::<_, Exponential>(&SE3::new(), &top);
}
