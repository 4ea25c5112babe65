//! Gaussian process, saved models, and what holds for any weights.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::PathBuf;

use coadjoint::{Exponential, Integrator, LieGroup, Phase, SO3, advance, poisson_map};
use coadjoint_learn::data::{PairRows, ReducedData, RowPolicy, Tolerances, reduce};
use coadjoint_learn::network::{Activation, DenseNetwork, Layer};
use coadjoint_learn::polynomial::{Basis, PolynomialModel, Scaling, fit_polynomial};
use coadjoint_learn::truth::{MomentumBox, Quadratic, Relativistic, phase_pairs};
use coadjoint_learn::{
    GaussianProcessOptions, Generating, LearnError, Model, ModelFile, MomentumFunction,
    TrainingRecord, drifts, evaluate, fit_gaussian_process,
};
use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

type Map<M> = Generating<SO3, Exponential, M>;

fn sample(h: &impl MomentumFunction, count: usize, seed: u64) -> (PairRows<SO3>, ReducedData) {
    let group = SO3::new();
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let rows: PairRows<SO3> = phase_pairs(&group, h, 0.2, wide, count, seed).into();
    let reduced =
        reduce::<SO3, Exponential>(&group, &rows, Tolerances::default(), RowPolicy::Refuse);
    (rows, reduced.unwrap().data)
}

fn random_network(seed: u64) -> DenseNetwork {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut draw = |n: usize| -> Vec<f64> { (0..n).map(|_| rng.random::<f64>() - 0.5).collect() };
    let hidden = vec![
        Layer { inputs: 3, weights: draw(60), biases: draw(20) },
        Layer { inputs: 20, weights: draw(200), biases: draw(10) },
    ];
    let scaling = Scaling { centre: draw(3), half_width: vec![2.0, 1.5, 2.5] };
    DenseNetwork::new(Activation::Tanh, scaling, draw(3), 0.4, hidden, draw(10)).unwrap()
}

fn random_polynomial(seed: u64) -> PolynomialModel {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let basis = Basis::new(3, 4);
    let draw: Vec<f64> = (0..basis.len()).map(|_| 0.05 * (rng.random::<f64>() - 0.5)).collect();
    let scaling = Scaling { centre: vec![0.0; 3], half_width: vec![2.0; 3] };
    PolynomialModel::zero(basis, scaling).with_coefficients(&draw)
}

fn hat(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// D Φ B DΦᵀ = B∘Φ with B(μ)v = μ̂ v (MATH: B_jk = −Σ c_jk^l μ_l, on so(3)\* B = −μ̂ up to sign,
/// and both sides carry the same sign); derivatives by central differences of step 1e-5.
fn poisson_defect(map: &impl Integrator<Group = SO3>, mu: &Vector3<f64>) -> f64 {
    let h = 1e-5;
    let mut derivative = Matrix3::zeros();
    for j in 0..3 {
        let step = Vector3::ith(j, h);
        let up = poisson_map(map, &(mu + step)).unwrap();
        let down = poisson_map(map, &(mu - step)).unwrap();
        derivative.set_column(j, &((up - down) / (2.0 * h)));
    }
    let image = poisson_map(map, mu).unwrap();
    (derivative * hat(mu) * derivative.transpose() - hat(&image)).amax()
}

/// Momentum ≤ 1e-14 and Casimir ≤ 1e-13 relative for any weights (the bars), here after
/// one step; the map is Poisson and equivariant (bars 1e-10, less what differences leave).
#[test]
fn random_weights_keep_the_geometry() {
    fn check<M: MomentumFunction>(function: M) {
        let group = SO3::new();
        let map = Map::new(group, function);
        for (i, mu) in [[1.0, -0.5, 0.8], [0.2, 1.5, -1.0], [-1.2, 0.3, 0.1]].iter().enumerate() {
            let mu = Vector3::from(*mu);
            let start = Phase::<SO3>::new(group.exp(&Vector3::new(0.3, i as f64, -0.2)), mu);
            let mut phase = start.clone();
            advance(&map, &mut phase).unwrap();
            assert!((phase.momentum - mu).norm() > 1e-3, "the map must do something");
            let spatial = start.spatial_momentum(&group);
            let drift = (phase.spatial_momentum(&group) - spatial).amax() / spatial.amax();
            assert!(drift <= 1e-14, "{drift:e}");
            assert!((phase.momentum.norm_squared() / mu.norm_squared() - 1.0).abs() <= 1e-13);
            assert!(poisson_defect(&map, &mu) < 1e-9, "{:e}", poisson_defect(&map, &mu));
            // Equivariance: k·Φ(α) = Φ(k·α).
            let k = group.exp(&Vector3::new(-0.7, 0.4, 1.1));
            let mut moved = Phase::<SO3>::new(group.compose(&k, &start.group_element), mu);
            advance(&map, &mut moved).unwrap();
            let expected = group.compose(&k, &phase.group_element);
            assert!(moved.group_element.angle_to(&expected) < 1e-14);
            assert_eq!(moved.momentum, phase.momentum);
        }
    }
    for seed in 0..5 {
        check(random_network(seed));
        check(random_polynomial(seed));
    }
}

/// Along 1000 steps the bars hold with the growth of rounding: momentum 1e-13, Casimir 1e-12.
#[test]
fn a_thousand_steps_of_random_weights_drift_by_rounding() {
    let group = SO3::new();
    let map = Map::new(group, random_polynomial(1));
    let start = Phase::<SO3>::at_identity(Vector3::new(1.0, -0.5, 0.8));
    let found = drifts(&map, &group, &start, 1000, None).unwrap();
    assert!(found.momentum < 1e-13 && found.casimir < 1e-12, "{found:?}");
}

/// A process has something to win where no polynomial is exact, and says how sure it is.
#[test]
fn the_gaussian_process_beats_its_mean_and_knows_where_it_is_unsure() {
    let truth = Relativistic { weights: vec![1.0 / 1.5, 0.5, 0.4], ripple: 0.3 };
    let (_, train) = sample(&truth, 150, 1);
    let (rows, test) = sample(&truth, 60, 2);
    let options = GaussianProcessOptions::default();
    let process = fit_gaussian_process(&train, &options).unwrap();
    let mean = fit_polynomial(&train, options.mean_degree, 0.0).unwrap();
    let group = SO3::new();
    let found = evaluate(&Map::new(group, &process), &group, &rows, &test);
    let prior = evaluate(&Map::new(group, &mean), &group, &rows, &test);
    // Measured: 1/770 in x, 1/2000 in momentum.
    assert!(found.mse.x.unwrap() < 5e-3 * prior.mse.x.unwrap(), "{found:?} {prior:?}");
    assert!(found.mse.momentum.unwrap() < 5e-3 * prior.mse.momentum.unwrap());
    // The Hessian is the derivative of the gradient.
    let p = [0.4, -0.9, 1.1];
    let (mut gradient, mut hessian) = ([0.0; 3], [0.0; 9]);
    process.gradient_and_hessian(&p, &mut gradient, &mut hessian);
    for j in 0..3 {
        let (mut up, mut down) = (p, p);
        up[j] += 1e-5;
        down[j] -= 1e-5;
        let (mut above, mut below) = ([0.0; 3], [0.0; 3]);
        process.gradient(&up, &mut above);
        process.gradient(&down, &mut below);
        for i in 0..3 {
            assert!(((above[i] - below[i]) / 2e-5 - hessian[i * 3 + j]).abs() < 1e-7);
        }
        let slope = (process.value(&up) - process.value(&down)) / 2e-5;
        assert!((slope - gradient[j]).abs() < 1e-7);
    }
    // Far away it is less sure than at a sample, by a lot.
    let uncertainty = process.uncertainty().unwrap();
    let near = uncertainty.deviation(train.p.column(0).as_slice());
    let far = uncertainty.deviation(&[9.0, 9.0, 9.0]);
    assert!((0..3).all(|i| far[i] > 20.0 * near[i]), "{near:?} {far:?}");
}

fn path(name: &str) -> PathBuf {
    let directory = std::env::temp_dir().join(format!("coadjoint-models-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    directory.join(name)
}

#[test]
fn models_of_every_kind_read_back_to_the_same_bits() {
    let (_, train) = sample(&Quadratic::paper(), 40, 1);
    let options = GaussianProcessOptions { largest: 20, ..Default::default() };
    let models = [
        Model::Polynomial(random_polynomial(4)),
        Model::Network(random_network(4)),
        Model::Hybrid { polynomial: random_polynomial(2), network: random_network(3) },
        Model::GaussianProcess(fit_gaussian_process(&train, &options).unwrap()),
    ];
    for model in models {
        let path = path(model.name());
        let file = ModelFile::new("SO3", "exp", 0.2, true, model, TrainingRecord::default());
        file.save(&path).unwrap();
        assert_eq!(ModelFile::load(&path).unwrap(), file);
    }
}

#[test]
fn damaged_and_foreign_files_are_refused_with_the_reason() {
    let reason = |name: &str, text: &[u8]| {
        let path = path(name);
        std::fs::write(&path, text).unwrap();
        match ModelFile::load(&path).unwrap_err() {
            LearnError::Model { reason, .. } => reason,
            other => panic!("{other}"),
        }
    };
    assert!(reason("a", b"\xff\xfe\x00").contains("not a text file"));
    assert!(reason("b", b"{\"format\": \"coadjoint-mo").contains("not whole JSON"));
    assert!(reason("c", b"{\"layers\": []}").contains("`format` is not `coadjoint-model`"));
    assert!(
        reason("d", b"{\"format\": \"coadjoint-model\", \"version\": 9}").contains("version 9")
    );
    let good = {
        let path = path("good");
        let model = Model::Polynomial(random_polynomial(4));
        ModelFile::new("SO3", "exp", 0.2, true, model, TrainingRecord::default())
            .save(&path)
            .unwrap();
        std::fs::read_to_string(&path).unwrap()
    };
    let fewer = good.replace("\"degree\":4", "\"degree\":3");
    assert!(reason("e", fewer.as_bytes()).contains("takes 19 coefficients, 34 are given"));
    let step = good.replace("\"step\":0.2", "\"step\":0.0");
    assert!(reason("f", step.as_bytes()).contains("not a usable time"));
    assert!(matches!(ModelFile::load(&path("missing")), Err(LearnError::File { .. })));
}
