//! Gaussian process, saved models, and what holds for any weights.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::PathBuf;

use coadjoint::groups::Exponential;
use coadjoint::{Phase, SO3};
use coadjoint_learn::data::{PairRows, ReducedData};
use coadjoint_learn::polynomial::fit_polynomial;
use coadjoint_learn::truth::Separable;
use coadjoint_learn::{
    Generating, LearnError, Model, ModelFile, MomentumFunction, Scaled, TrainingRecord, drifts,
    evaluate, fit_gaussian_process,
};
use nalgebra::Vector3;

use crate::support::{self, WIDE, bump, random, relativistic};

type Map<M> = Generating<SO3, Exponential, M>;

fn sample(truth: &impl MomentumFunction, count: usize, seed: u64) -> (PairRows<SO3>, ReducedData) {
    support::sample::<SO3, Exponential>(&SO3::new(), truth, (0.2, WIDE), count, seed)
}

fn random_network(seed: u64) -> coadjoint_learn::network::DenseNetwork {
    support::random_network(3, &mut random(seed))
}

fn random_polynomial(seed: u64) -> coadjoint_learn::polynomial::PolynomialModel {
    support::random_polynomial(3, &mut random(seed))
}

/// Gradients and Hessians of every function against central differences.
#[test]
fn derivatives_agree_with_differences() {
    let weights = vec![1.0 / 1.5, 0.5, 0.4];
    let process = fit_gaussian_process(&sample(&bump(), 40, 1).1, 20).unwrap();
    let functions: [(&str, &dyn MomentumFunction, f64); 8] = [
        (
            "quadratic",
            &Separable { linear: vec![0.1, 0.0, -0.3], ..Separable::quadratic(weights.clone()) },
            1e-9,
        ),
        (
            "quartic",
            &Separable { quartic: vec![0.3, 0.1, 0.2], ..Separable::quadratic(weights) },
            1e-9,
        ),
        ("relativistic", &relativistic(), 1e-9),
        ("bump", &bump(), 1e-9),
        ("polynomial", &random_polynomial(3), 1e-9),
        ("network", &random_network(3), 1e-9),
        ("process", &process, 1e-7),
        ("scaled", &Scaled { factor: 0.7, function: bump() }, 1e-9),
    ];
    let p = [0.4, -0.9, 1.1];
    for (name, function, bar) in functions {
        let (mut gradient, mut hessian) = ([0.0; 3], [0.0; 9]);
        function.gradient_and_hessian(&p, &mut gradient, &mut hessian);
        for j in 0..3 {
            let at = |change: f64| {
                let (mut moved, mut slope) = (p, [0.0; 3]);
                moved[j] += change;
                function.gradient(&moved, &mut slope);
                (function.value(&moved), slope)
            };
            let (up, down) = (at(1e-5), at(-1e-5));
            assert!(((up.0 - down.0) / 2e-5 - gradient[j]).abs() < bar, "{name} {j}");
            for i in 0..3 {
                let bend = (up.1[i] - down.1[i]) / 2e-5;
                assert!((bend - hessian[i * 3 + j]).abs() < bar, "{name} {i} {j}");
            }
        }
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

/// A process has something to win where no polynomial is exact.
#[test]
fn the_gaussian_process_beats_its_mean() {
    let truth = relativistic();
    let (_, train) = sample(&truth, 150, 1);
    let (rows, test) = sample(&truth, 60, 2);
    let process = fit_gaussian_process(&train, 600).unwrap();
    let mean = fit_polynomial(&train, 2, 0.0).unwrap();
    let group = SO3::new();
    let found = evaluate(&Map::new(group, &process), &group, &rows, &test);
    let prior = evaluate(&Map::new(group, &mean), &group, &rows, &test);
    // Measured: 1/770 in x, 1/2000 in momentum.
    assert!(found.mse.x.unwrap() < 5e-3 * prior.mse.x.unwrap(), "{found:?} {prior:?}");
    assert!(found.mse.momentum.unwrap() < 5e-3 * prior.mse.momentum.unwrap());
}

fn path(name: &str) -> PathBuf {
    let directory = std::env::temp_dir().join(format!("coadjoint-models-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    directory.join(name)
}

#[test]
fn models_of_every_kind_read_back_to_the_same_bits() {
    let (_, train) = sample(&Separable::paper(), 40, 1);
    let models = [
        Model::Polynomial(random_polynomial(4)),
        Model::Network(random_network(4)),
        Model::Hybrid { polynomial: random_polynomial(2), network: random_network(3) },
        Model::GaussianProcess(fit_gaussian_process(&train, 20).unwrap()),
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
            LearnError::Model(_, reason) => reason,
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
