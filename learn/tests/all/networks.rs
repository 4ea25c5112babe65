//! Training networks: small ones, for the suite.
#![allow(clippy::unwrap_used)]

use coadjoint::SO3;
use coadjoint::groups::Cayley;
use coadjoint_learn::data::{PairRows, ReducedData, RowPolicy, Tolerances, reduce};
use coadjoint_learn::network::{Activation, TrainingOptions, fit_network};
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use coadjoint_learn::{Generating, evaluate, fit_hybrid};

fn sample(count: usize, seed: u64) -> (PairRows<SO3>, ReducedData) {
    let group = SO3::new();
    let rows: PairRows<SO3> =
        phase_pairs(&group, &Quadratic::paper(), 0.1, MomentumBox::PAPER, count, seed).into();
    let reduced = reduce::<SO3, Cayley>(&group, &rows, Tolerances::default(), RowPolicy::Refuse);
    (rows, reduced.unwrap().data)
}

fn small() -> TrainingOptions {
    TrainingOptions {
        widths: vec![32, 32],
        adam_steps: 100,
        rate: 5e-3,
        lbfgs_steps: 500,
        ..Default::default()
    }
}

/// The bars for the plain network (1e-6 in x, 1e-5 in momentum) are met by a net far below
/// the paper's size (measured 3.2e-7 and 5.9e-6); the hybrid gains a factor of fifty on it.
#[test]
fn plain_and_hybrid_networks_reach_their_bars() {
    let group = SO3::new();
    let (_, train) = sample(200, 1);
    let (rows, test) = sample(100, 2);
    let (network, _) = fit_network(&train.p, &train.x, None, &small(), &mut |_| {}).unwrap();
    let plain = evaluate(&Generating::<_, Cayley, _>::new(group, &network), &group, &rows, &test);
    assert!(plain.mse.x.unwrap() <= 1e-6 && plain.mse.momentum.unwrap() <= 1e-5, "{plain:?}");
    let (hybrid, _) = fit_hybrid(&train.p, &train.x, 2, &small(), &mut |_| {}).unwrap();
    let hybrid = evaluate(&Generating::<_, Cayley, _>::new(group, &hybrid), &group, &rows, &test);
    assert!(hybrid.mse.x.unwrap() <= plain.mse.x.unwrap() / 20.0, "{hybrid:?}");
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let (_, train) = sample(50, 1);
    let options = TrainingOptions { adam_steps: 20, lbfgs_steps: 20, ..small() };
    let once = fit_network(&train.p, &train.x, None, &options, &mut |_| {}).unwrap();
    assert_eq!(once, fit_network(&train.p, &train.x, None, &options, &mut |_| {}).unwrap());
    let other = TrainingOptions { seed: 1, activation: Activation::Logistic, ..options };
    assert_ne!(once, fit_network(&train.p, &train.x, None, &other, &mut |_| {}).unwrap());
}

/// A training interrupted in the middle of Adam ends with the bits of one that was not. (The same
/// for a killed process: `cli/tests/all/resume.rs`.)
#[test]
fn training_goes_on_from_a_checkpoint() {
    let (_, train) = sample(50, 1);
    let path = std::env::temp_dir().join(format!("coadjoint-neural-{}", std::process::id()));
    let plain = TrainingOptions { adam_steps: 80, lbfgs_steps: 60, ..small() };
    let whole = fit_network(&train.p, &train.x, None, &plain, &mut |_| {}).unwrap();
    let kept = TrainingOptions { checkpoint: Some(path.clone()), ..plain };
    let interrupted = std::panic::catch_unwind(|| {
        fit_network(&train.p, &train.x, None, &kept, &mut |now| assert!(now.step < 70, "killed"))
    });
    assert!(interrupted.is_err() && path.exists());
    let mut first = None;
    let again =
        fit_network(&train.p, &train.x, None, &kept, &mut |now| first = first.or(Some(now.step)))
            .unwrap();
    assert_eq!((again, first), (whole, Some(50)));
    std::fs::remove_file(path).unwrap();
}
