//! Criterion: what a generated step costs, attitude included. The benchmark's name says how many
//! Newton iterations a step took on average; the throughput line gives steps per second.
//!
//! `cargo bench -p coadjoint-bench --bench generated`

#![allow(clippy::expect_used)]

use std::hint::black_box;

use coadjoint::{Integrator, Phase, SE3, SO3, advance, lie_poisson};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SO3, truncation = 13)]
fn accurate_body(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0
}

#[lie_poisson(group = SE3, truncation = 7)]
fn heavy_top(mu: [f64; 6], inertia: [f64; 3], mgl: f64) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
        + mgl * mu[5]
}

/// Steps per measured run.
const STEPS: u32 = 1000;

/// Runs [`STEPS`] steps and returns the Newton iterations made.
fn run<S: Integrator>(step: &S, start: &Phase<S::Group>) -> u32 {
    let mut phase = start.clone();
    let mut iterations = 0;
    for _ in 0..STEPS {
        iterations +=
            advance(step, &mut phase).expect("the step is well inside the chart").iterations;
    }
    black_box(phase);
    iterations
}

fn measure<S: Integrator>(
    criterion: &mut Criterion,
    name: &str,
    h: f64,
    step: &S,
    start: &Phase<S::Group>,
) {
    let iterations = f64::from(run(step, start)) / f64::from(STEPS);
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(u64::from(STEPS)));
    group.bench_function(format!("h = {h}, {iterations:.2} Newton iterations"), |bencher| {
        bencher.iter(|| run(step, black_box(start)));
    });
    group.finish();
}

fn generated(criterion: &mut Criterion) {
    let body = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    for h in [0.1, 0.2, 0.3, 0.4, 0.5] {
        let step = RigidBody::new(h, [1.5, 2.0, 2.5]).expect("valid parameters");
        measure(criterion, "rigid body, K = 7", h, &step, &body);
    }
    for h in [0.25, 0.5, 0.8] {
        let step = AccurateBody::new(h).expect("valid step");
        measure(criterion, "rigid body, K = 13", h, &step, &body);
    }
    let top = Phase::<SE3>::at_identity([2.0, 0.5, 1.0, 0.1, 0.2, 0.97]);
    for h in [0.05, 0.1] {
        let step = HeavyTop::new(h, [1.5, 2.0, 2.5], 1.0).expect("valid parameters");
        measure(criterion, "heavy top, K = 7", h, &step, &top);
    }
}

criterion_group!(benches, generated);
criterion_main!(benches);
