//! Polynomial models of the paper's body in the paper's box, with exact flow as data.
#![allow(clippy::unwrap_used)]

use coadjoint::SO3;
use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint_learn::data::{ReducedData, RowPolicy, TOLERANCE, reduce};
use coadjoint_learn::polynomial::{fit_polynomial, select_polynomial};
use coadjoint_learn::truth::{MomentumBox, Separable, add_noise, phase_pairs};
use coadjoint_learn::{LearnError, MomentumFunction};

fn reduced<C: Chart<SO3>>(count: usize, seed: u64, noise: f64) -> ReducedData {
    let group = SO3::new();
    let pairs = phase_pairs(&group, &Separable::paper(), 0.1, MomentumBox::PAPER, count, seed);
    let pairs = add_noise(&group, &pairs, noise, seed + 1000);
    let tolerance = if noise > 0.0 { f64::INFINITY } else { TOLERANCE };
    reduce::<SO3, C>(&group, &pairs.into(), tolerance, RowPolicy::Refuse).unwrap().data
}

fn error(model: &impl MomentumFunction, data: &ReducedData) -> f64 {
    let mut x = [0.0; 3];
    let mut sum = 0.0;
    for i in 0..data.count() {
        model.gradient(data.p.column(i).as_slice(), &mut x);
        sum += (0..3).map(|j| (x[j] - data.x[(j, i)]).powi(2)).sum::<f64>();
    }
    sum / (3 * data.count()) as f64
}

/// Bounds for 500 samples at Δt = 0.1: degree 6 ≤ 5e-12, degree 8 ≤ 1e-14. The Cayley
/// chart (the paper's) measures 1.6e-12 and 2.4e-15, the exponential chart 1.3e-21 and 1.5e-27.
#[test]
fn degrees_six_and_eight_reach_their_bars_in_both_charts() {
    for (train, test) in [
        (reduced::<Cayley>(500, 1, 0.0), reduced::<Cayley>(100, 2, 0.0)),
        (reduced::<Exponential>(500, 1, 0.0), reduced::<Exponential>(100, 2, 0.0)),
    ] {
        for (degree, bar) in [(6, 5e-12), (8, 1e-14)] {
            let mse = error(&fit_polynomial(&train, degree, 0.0).unwrap(), &test);
            assert!(mse <= bar, "degree {degree}: {mse:e}");
        }
    }
}

#[test]
fn cross_validation_takes_a_high_degree_for_exact_data_and_a_low_one_for_noise() {
    let exact = select_polynomial(&reduced::<Exponential>(200, 1, 0.0), 2..=6, 0).unwrap();
    assert_eq!(exact.best.degree, 6);
    assert!(error(&exact.model, &reduced::<Exponential>(100, 2, 0.0)) < 1e-19);
    let noisy = select_polynomial(&reduced::<Exponential>(200, 1, 0.05), 2..=6, 0).unwrap();
    assert!(noisy.best.degree <= 3, "{:?}", noisy.best);
    // The noise of an increment is √2·0.05 a coordinate; the model averages it out.
    assert!(error(&noisy.model, &reduced::<Exponential>(100, 2, 0.0)) < 1e-4);
}

#[test]
fn too_few_samples_are_refused_unless_a_ridge_decides() {
    let train = reduced::<Exponential>(20, 1, 0.0);
    let error = fit_polynomial(&train, 6, 0.0).unwrap_err();
    assert!(matches!(error, LearnError::NotDetermined { terms: 83, samples: 20, .. }), "{error}");
    assert!(fit_polynomial(&train, 6, 1e-10).is_ok());
}
