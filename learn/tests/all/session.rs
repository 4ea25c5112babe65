//! Sessions: the choice of a model and its checkpoints; groups by name, and polynomials in exact monomial form.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use coadjoint::SO3;
use coadjoint::groups::{Chart, Exponential};
use coadjoint_learn::catalogue::{Visitor, visit};
use coadjoint_learn::data::{RowPolicy, TOLERANCE, reduce};
use coadjoint_learn::network::{Progress, TrainingOptions};
use coadjoint_learn::polynomial::{Basis, PolynomialModel, Scaling, fit_polynomial};
use coadjoint_learn::truth::{MomentumBox, Separable, phase_pairs};
use coadjoint_learn::{
    DataGroup, Dataset, Generating, GroupChoice, Kind, LearnError, ModelFile, MomentumFunction,
    Request, Summary, evaluate, exact_polynomial, learn, remove_checkpoints,
};

use crate::support::{WIDE, bump, csv_of};

/// Learns a free body on any group of the catalogue and gives the test error of μ″.
struct Learn;

impl Visitor for Learn {
    type Output = f64;

    fn visit<G: DataGroup, C: Chart<G>>(self, group: G) -> f64 {
        let dim = group.dim();
        let weights = (0..dim).map(|i| 1.0 / (1.0 + 0.3 * i as f64)).collect();
        let body = Separable::quadratic(weights);
        let pairs =
            |count, seed| phase_pairs(&group, &body, 0.1, MomentumBox::UNIT, count, seed).into();
        let (train, test) = (pairs(60, 1), pairs(10, 2));
        let reduced =
            |pairs| reduce::<G, C>(&group, pairs, TOLERANCE, RowPolicy::Refuse).unwrap().data;
        let model = fit_polynomial(&reduced(&train), 3, 0.0).unwrap();
        let map = Generating::<G, C, _>::new(group.clone(), &model);
        let figures = evaluate(&map, &group, &test, &reduced(&test));
        assert!(figures.unsolved.is_empty());
        figures.mse.momentum.unwrap()
    }
}

#[test]
fn any_group_of_the_catalogue_in_either_chart() {
    for (group, chart) in [
        ("SO3", "cayley"),
        ("SE3", "exp"),
        ("SE3", "cayley"),
        ("SE23", "cayley"),
        ("SO4", "exp"),
        ("SL2", "exp"),
    ] {
        let mse = visit(&group.into(), chart, Learn).unwrap();
        // Degree 3; the worst, SL2 with its structure constants 2, measures 2.3e-8.
        assert!(mse < 1e-7, "{group} {chart}: {mse:e}");
    }
    assert!(matches!(visit(&"SU3".into(), "cayley", Learn), Err(LearnError::NoChart { .. })));
    assert!(matches!(visit(&"SO3".into(), "polar", Learn), Err(LearnError::NoChart { .. })));
    assert!(matches!(visit(&"XY9".into(), "exp", Learn), Err(LearnError::UnknownGroup { .. })));
    // The compiled and the run-time exponential are the same chart.
    assert_eq!(<Exponential as Chart<coadjoint::SO3>>::NAME, "exp");
}

#[test]
fn the_exact_monomial_form_is_the_model() {
    let basis = Basis::new(3, 4);
    let coefficients: Vec<f64> = (0..basis.terms().len()).map(|k| (k as f64 * 0.7).sin()).collect();
    let scaling = Scaling { centre: vec![0.3, -0.1, 0.7], half_width: vec![2.0, 1.5, 0.9] };
    let model = PolynomialModel::zero(basis, scaling).with_coefficients(&coefficients);
    let exact = exact_polynomial(&model).unwrap();
    for p in [[0.1, 0.2, 0.3], [-1.0, 0.8, 1.4]] {
        assert!((exact.evaluate(&p) - model.value(&p)).abs() < 1e-12);
    }
}

#[test]
fn groups_of_model_files_are_names_or_algebras() {
    use coadjoint_codegen::system::read_group;
    let by_brackets = "[algebra]\ngenerators = [\"a\", \"b\", \"c\"]\n\
                       brackets = [\"[a, b] = -1/3*c\", \"[b, c] = a\", \"[c, a] = b\"]\n";
    let by_basis =
        "[algebra]\nname = \"affine\"\nbasis = [[[1, 0], [0, 0]], [[0, \"1/2\"], [0, 0]]]\n";
    for text in ["group = \"SO3\"\n", by_brackets, by_basis] {
        let algebra = read_group(text).unwrap();
        let group = GroupChoice::of(&algebra);
        let json = serde_json::to_string(&group).unwrap();
        let read: GroupChoice = serde_json::from_str(&json).unwrap();
        assert_eq!((&read, read.algebra().unwrap()), (&group, algebra), "{json}");
        assert_eq!(matches!(group, GroupChoice::Named(_)), text.contains("SO3"));
    }
    for wrong in [
        r#"{"name": "SO3", "generators": ["a", "b"], "brackets": [[0, 1, [[0, "1"]]]]}"#,
        r#"{"name": "x", "generators": ["a", "b"], "brackets": [[0, 7, [[0, "1"]]]]}"#,
        r#"{"name": "x", "generators": ["a", "b"], "brackets": [[0, 1, [[0, "1/0"]]]]}"#,
        r#"{"name": "x", "generators": ["a"], "brackets": [], "basis": [[["1", "2"]]]}"#,
        r#"{"name": "x", "generators": [], "brackets": []}"#,
    ] {
        let read: GroupChoice = serde_json::from_str(wrong).unwrap();
        assert!(matches!(read.algebra(), Err(LearnError::UnknownGroup { .. })), "{wrong}");
    }
}

/// A file of pairs of this truth.
fn pairs(name: &str, truth: &impl MomentumFunction, count: usize) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("coadjoint-choice-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let data = folder.join(format!("{name}.csv"));
    let pairs = phase_pairs(&SO3::new(), truth, 0.1, WIDE, count, 1);
    std::fs::write(&data, csv_of(&SO3::new(), &pairs)).unwrap();
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
    learn(request, Dataset::files(data, None)?, progress)
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
    let data = pairs("body", &Separable::paper(), 150);
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
