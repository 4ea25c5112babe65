//! Training networks: small ones, for the suite.
#![allow(clippy::unwrap_used)]

use std::panic::AssertUnwindSafe;

use coadjoint::SO3;
use coadjoint::groups::Cayley;
use coadjoint_learn::data::{PairRows, ReducedData};
use coadjoint_learn::network::{TrainingOptions, fit_network};
use coadjoint_learn::truth::{MomentumBox, Separable};
use coadjoint_learn::{Generating, evaluate, fit_hybrid};

use crate::support;

fn sample(count: usize, seed: u64) -> (PairRows<SO3>, ReducedData) {
    let (body, within) = (Separable::paper(), (0.1, MomentumBox::PAPER));
    support::sample::<SO3, Cayley>(&SO3::new(), &body, within, count, seed)
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

/// A plain network far below the paper's size reaches 1e-6 in x and 1e-5 in momentum (measured 3.2e-7 and 5.9e-6); the
/// hybrid gains a factor of fifty on it.
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
    let other = TrainingOptions { seed: 1, ..options };
    assert_ne!(once, fit_network(&train.p, &train.x, None, &other, &mut |_| {}).unwrap());
}

/// A training that is interrupted, in Adam before and after a checkpoint, at its end, and in the descent, ends with the
/// bits of one that was not. (The same for a killed process: `cli/tests/all/resume.rs`.)
#[test]
fn training_goes_on_from_a_checkpoint() {
    let (_, train) = sample(50, 1);
    let path = std::env::temp_dir().join(format!("coadjoint-neural-{}", std::process::id()));
    let plain = TrainingOptions { widths: vec![12], adam_steps: 180, lbfgs_steps: 320, ..small() };
    let fit = |options: &TrainingOptions, killed_at: usize| {
        let mut seen = Vec::new();
        let fitted = std::panic::catch_unwind(AssertUnwindSafe(|| {
            fit_network(&train.p, &train.x, None, options, &mut |now| {
                assert!(now.step != killed_at, "killed");
                seen.push(now.step);
            })
        }));
        (fitted.ok().map(Result::unwrap), seen.first().copied())
    };
    let whole = fit(&plain, usize::MAX).0.unwrap();
    let kept = TrainingOptions { checkpoint: Some(path.clone()), ..plain };
    for (killed_at, goes_on_at) in [(10, 0), (150, 100), (180, 100), (230, 200), (400, 300)] {
        assert_eq!(fit(&kept, killed_at).0, None);
        let (again, first) = fit(&kept, usize::MAX);
        assert_eq!(again.as_ref(), Some(&whole), "{killed_at}");
        assert!(first.is_some_and(|first| first >= goes_on_at), "{killed_at}: {first:?}");
        // Once more: it is finished, and nothing is computed but the last loss.
        assert_eq!(fit(&kept, usize::MAX), (again, None));
        std::fs::remove_file(&path).unwrap();
    }
}

/// A checkpoint that is damaged anywhere, cut off, or of other data is refused.
#[test]
fn damaged_and_foreign_checkpoints_are_refused() {
    let (_, train) = sample(20, 1);
    let path = std::env::temp_dir().join(format!("coadjoint-damaged-{}", std::process::id()));
    let checkpoint = Some(path.clone());
    let options =
        TrainingOptions { widths: vec![3], adam_steps: 10, lbfgs_steps: 20, checkpoint, ..small() };
    let fit = |gradients| fit_network(&train.p, gradients, None, &options, &mut |_| {});
    fit(&train.x).unwrap();
    let twice = 2.0 * &train.x;
    let other = fit(&twice).unwrap_err().to_string();
    assert!(other.contains("other data"), "{other}");
    let whole = std::fs::read(&path).unwrap();
    let refused = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let reason = fit(&train.x).unwrap_err().to_string();
        assert!(reason.contains("damaged") && reason.contains("delete it"), "{reason}");
    };
    for place in 0..whole.len() {
        let mut changed = whole.clone();
        changed[place] ^= 1 << (place % 8);
        refused(&changed);
    }
    refused(&whole[..whole.len() - 8]);
    refused(b"hello");
    std::fs::remove_file(path).unwrap();
}
