//! `auto` compares every kind of model the build has, on the same held-out samples, and says so.
#![allow(clippy::unwrap_used)]

use std::path::PathBuf;

use coadjoint::SO3;
use coadjoint_learn::data::{RowPolicy, Tolerances, write_pairs};
use coadjoint_learn::truth::{Bump, MomentumBox, Quadratic, phase_pairs};
use coadjoint_learn::{
    Kind, LearnError, MomentumFunction, NetworkSettings, Request, learn, remove_checkpoints,
};

fn request(name: &str, truth: &impl MomentumFunction, count: usize) -> Request {
    let folder = std::env::temp_dir().join(format!("coadjoint-choice-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let data = folder.join(format!("{name}.csv"));
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let pairs = phase_pairs(&SO3::new(), truth, 0.1, wide, count, 1);
    write_pairs(&data, &SO3::new(), &pairs).unwrap();
    Request {
        data,
        test: None,
        group: "SO3".into(),
        chart: "exp".into(),
        step: 0.1,
        kind: Kind::Auto,
        degree: None,
        ridge: 0.0,
        group_loss: false,
        tolerances: Tolerances::default(),
        policy: RowPolicy::Refuse,
        momenta_only: false,
        start: None,
        seed: 0,
        network: NetworkSettings { widths: vec![24, 24], evaluations: 300, ..Default::default() },
        drift_steps: 10,
    }
}

fn bump() -> Bump {
    Bump {
        weights: vec![1.0 / 1.5, 0.5, 0.4],
        height: 1.5,
        sharpness: vec![1.2, 0.7, 0.9],
        centre: vec![0.5, -0.3, 0.8],
    }
}

/// On a bump no polynomial is exact; the choice names every kind with its figure.
#[test]
fn auto_names_every_kind_it_compared() {
    let (file, summary) = learn(&request("bump", &bump(), 100), &mut |_, _, _| {}).unwrap();
    println!("{}", summary.choice);
    for kind in ["polynomial degree", "Gaussian process"] {
        assert!(summary.choice.contains(kind), "{}", summary.choice);
    }
    let networks = ["network [24, 24]", "hybrid of degree 2"];
    assert!(networks.iter().all(|kind| summary.choice.contains(kind)), "{}", summary.choice);
    // The first model in the sentence is the one that was fitted.
    let first = match summary.model.as_str() {
        "gp" => "Gaussian process",
        "hybrid" => "hybrid",
        "network" => "network",
        _ => "polynomial",
    };
    assert!(summary.choice.starts_with(first), "{} {}", summary.model, summary.choice);
    assert_eq!(file.model.name(), summary.model);
    assert!(summary.drifts.unwrap().casimir < 1e-12);
}

/// Exact data of a free body: the polynomial wins by so much that networks are not tried.
#[test]
fn a_polynomial_wins_on_the_free_body() {
    let request = request("body", &Quadratic::paper(), 150);
    let (_, summary) = learn(&request, &mut |_, _, _| {}).unwrap();
    assert_eq!(summary.model, "polynomial");
    assert!(summary.choice.contains("networks not tried"), "{}", summary.choice);
}

/// A checkpoint left by another task is refused, not trained over; training resumes from the right one.
#[test]
fn checkpoints_of_a_session_belong_to_it() {
    let base: PathBuf = std::env::temp_dir().join(format!("coadjoint-base-{}", std::process::id()));
    let mut request = request("checkpoint", &bump(), 60);
    request.kind = Kind::Network;
    request.network.checkpoint = Some(base.clone());
    let once = learn(&request, &mut |_, _, _| {}).unwrap();
    // Finished already: the same bits without training.
    let mut evaluations = 0;
    let again = learn(&request, &mut |_, _, _| evaluations += 1).unwrap();
    assert_eq!((once.0, evaluations), (again.0, 0));
    let other = Request { seed: 1, ..request };
    let error = learn(&other, &mut |_, _, _| {}).unwrap_err();
    assert!(matches!(error, LearnError::Checkpoint { .. }), "{error}");
    remove_checkpoints(&base).unwrap();
    learn(&other, &mut |_, _, _| {}).unwrap();
    remove_checkpoints(&base).unwrap();
}
