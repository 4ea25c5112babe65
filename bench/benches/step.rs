//! Criterion micro-benchmarks: one step, every method at the same step length.
//!
//! Time per step says nothing about accuracy; `work-precision` compares at equal error. These are for watching one
//! method while changing it: `cargo bench -p coadjoint-bench -- "free-body-a/DMV10"`.

#![allow(clippy::expect_used)]

use std::hint::black_box;

use coadjoint_bench::{
    method::{Method, Setting},
    ours, peers,
    problem::{self, Problem},
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Steps per run: enough that starting values and conversions do not count.
const STEPS: u32 = 256;

fn steps(criterion: &mut Criterion) {
    let problems = match problem::all() {
        Ok(problems) => problems,
        Err(error) => {
            eprintln!("{error}");
            return;
        }
    };
    for mut problem in problems {
        let step = 0.25 * problem.time_scale;
        problem.end = f64::from(STEPS) * step;
        let mut group = criterion.benchmark_group(problem.name);
        group.throughput(Throughput::Elements(u64::from(STEPS)));
        for method in rows(&problem) {
            let run = || method.run(black_box(&problem), Setting::Step(step));
            group.bench_function(method.name(), |bencher| bencher.iter(run));
        }
        group.finish();
    }
}

/// The methods that solve the problem with a fixed step.
fn rows(problem: &Problem) -> Vec<Box<dyn Method>> {
    let mut methods = ours::all();
    methods.extend(peers::all());
    methods.retain(|method| {
        method.applies(problem)
            && matches!(method.settings(problem).first(), Some(Setting::Step(_)))
    });
    methods
}

criterion_group!(benches, steps);
criterion_main!(benches);
