//! Poisson maps from momenta alone, in the boxes of the paper's Table 2.
#![allow(clippy::unwrap_used)]

use coadjoint::groups::Exponential;
use coadjoint::solve::Integrator;
use coadjoint::steps::poisson_map;
use coadjoint::{LieGroup, SO3};
use coadjoint_learn::data::MomentumPairs;
use coadjoint_learn::momentum::fit_poisson;
use coadjoint_learn::truth::{MomentumBox, Quadratic, exact_momentum_flow, momentum_pairs};
use coadjoint_learn::{Generating, MomentumFunction};
use nalgebra::Vector3;

fn pairs(step: f64, count: usize, seed: u64) -> MomentumPairs {
    let group = SO3::new();
    momentum_pairs(&group, MomentumBox::UNIT, count, seed, |mu| {
        exact_momentum_flow(&group, &Quadratic::paper(), mu, step)
    })
}

fn error(map: &impl Integrator<Group = SO3>, test: &MomentumPairs) -> f64 {
    let mut sum = 0.0;
    for (before, after) in test.before.column_iter().zip(test.after.column_iter()) {
        let mu = Vector3::new(before[0], before[1], before[2]);
        let next = poisson_map(map, &mu).unwrap();
        sum += (0..3).map(|j| (next[j] - after[j]).powi(2)).sum::<f64>();
    }
    sum / (3 * test.len()) as f64
}

/// [−1, 1]³, Δt = 1, 200 samples: degree 4 ≤ 1e-11, degree 6 ≤ 1e-15.
#[test]
fn table_two_bars() {
    let (train, test) = (pairs(1.0, 200, 1), pairs(1.0, 100, 2));
    for (degree, bar) in [(4, 1e-11), (6, 1e-15)] {
        let (model, _) = fit_poisson::<SO3, Exponential>(&SO3::new(), &train, degree).unwrap();
        let map = Generating::<SO3, Exponential, _>::new(SO3::new(), &model);
        let mse = error(&map, &test);
        assert!(mse <= bar, "degree {degree}: {mse:e}");
    }
}

/// Section 5.4: 1000 pairs of forward Euler, start (2, 0.5, 1), 2000 steps. The learned map keeps
/// the Casimir to rounding (bar 1e-12) and the energy within 2e-3; Euler itself drifts away.
#[test]
fn geometrized_euler_keeps_casimir_and_energy() {
    let group = SO3::new();
    let body = Quadratic::paper();
    let step = 0.1;
    let euler = |mu: &Vector3<f64>| {
        let mut xi = [0.0; 3];
        body.gradient(mu.as_slice(), &mut xi);
        mu + group.ad_star(&Vector3::from(xi), mu) * step
    };
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    let train = momentum_pairs(&group, wide, 1000, 1, euler);
    let (model, _) = fit_poisson::<SO3, Exponential>(&group, &train, 4).unwrap();
    let map = Generating::<SO3, Exponential, _>::new(group, &model);
    let start = Vector3::new(2.0, 0.5, 1.0);
    let (mut mu, mut plain) = (start, start);
    let energy = |mu: &Vector3<f64>| body.value(mu.as_slice());
    let (mut casimir, mut drift) = (0.0_f64, 0.0_f64);
    for _ in 0..2000 {
        mu = poisson_map(&map, &mu).unwrap();
        plain = euler(&plain);
        casimir = casimir.max((mu.norm_squared() / start.norm_squared() - 1.0).abs());
        drift = drift.max((energy(&mu) / energy(&start) - 1.0).abs());
    }
    assert!(casimir <= 1e-12, "{casimir:e}");
    assert!(drift <= 2e-3, "{drift:e}");
    assert!((energy(&plain) / energy(&start) - 1.0).abs() > 0.1);
}
