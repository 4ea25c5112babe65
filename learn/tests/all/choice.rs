//! `auto` compares every kind of model the build has, on the same held-out samples, and says so.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::network::{Progress, TrainingOptions};
use coadjoint_learn::truth::{Quadratic, phase_pairs};
use coadjoint_learn::{
    Kind, LearnError, ModelFile, MomentumFunction, Request, Source, Summary, learn,
    remove_checkpoints,
};

use crate::support::{WIDE, bump};

/// A file of pairs of this truth.
fn pairs(name: &str, truth: &impl MomentumFunction, count: usize) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("coadjoint-choice-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let data = folder.join(format!("{name}.csv"));
    let pairs = phase_pairs(&SO3::new(), truth, 0.1, WIDE, count, 1);
    write_pairs(&data, &SO3::new(), &pairs).unwrap();
    data
}

fn request(kind: Kind) -> Request {
    let network = TrainingOptions { widths: vec![24, 24], ..TrainingOptions::budget(300) };
    let (group, chart) = ("SO3".into(), "exp".into());
    Request { group, chart, step: 0.1, kind, network, drift_steps: 10, ..Request::default() }
}

fn learnt(
    request: &Request,
    data: &Path,
    progress: &mut dyn FnMut(Progress),
) -> Result<(ModelFile, Summary), LearnError> {
    learn(request, Source::Files(data, None), progress)
}

/// On a bump no polynomial is exact; the choice names every kind with its figure.
#[test]
fn auto_names_every_kind_it_compared() {
    let data = pairs("bump", &bump(), 100);
    let (file, summary) = learnt(&request(Kind::Auto), &data, &mut |_| {}).unwrap();
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
    let data = pairs("body", &Quadratic::paper(), 150);
    let (_, summary) = learnt(&request(Kind::Auto), &data, &mut |_| {}).unwrap();
    assert_eq!(summary.model, "polynomial");
    assert!(summary.choice.contains("networks not tried"), "{}", summary.choice);
}

/// A checkpoint left by another task is refused, not trained over; training resumes from the right one.
#[test]
fn checkpoints_of_a_session_belong_to_it() {
    let base: PathBuf = std::env::temp_dir().join(format!("coadjoint-base-{}", std::process::id()));
    let data = pairs("checkpoint", &bump(), 60);
    let mut request = request(Kind::Network);
    request.network.checkpoint = Some(base.clone());
    let once = learnt(&request, &data, &mut |_| {}).unwrap();
    // Finished already: the same bits without training.
    let mut evaluations = 0;
    let again = learnt(&request, &data, &mut |_| evaluations += 1).unwrap();
    assert_eq!((once.0, evaluations), (again.0, 0));
    let other = Request { seed: 1, ..request };
    let error = learnt(&other, &data, &mut |_| {}).unwrap_err();
    assert!(matches!(error, LearnError::Checkpoint(..)), "{error}");
    remove_checkpoints(&base).unwrap();
    learnt(&other, &data, &mut |_| {}).unwrap();
    remove_checkpoints(&base).unwrap();
}
