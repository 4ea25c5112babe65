//! Emitted code of a large system, cut into several functions, computes what the interpreter does.
#![allow(clippy::unwrap_used)]

use coadjoint::nalgebra::SVector;
use coadjoint::{GeneratingFunction, Phase};
use coadjoint_codegen::emit;
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::{FoldTable, Integrator};
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::{Options, read};
use coadjoint_program::Stepper;

/// Twenty spins.
const DIM: usize = 60;

mod built {
    include!(concat!(env!("OUT_DIR"), "/ring_20.rs"));
}

fn integrator() -> Integrator {
    let text = std::fs::read_to_string("systems/ring_20.toml").unwrap();
    let problem = read(&text, Options::default()).unwrap().problem;
    Integrator::build(problem, TermLimit::default()).unwrap()
}

#[test]
fn parts_compute_as_the_interpreter() {
    let integrator = integrator();
    let code = emit::file(emit::items(&integrator, &emit::Options::for_problem("ring")));
    assert!(code.contains("fn part3<"), "the ring is too short to be cut");

    let h = 0.05;
    let step = built::Ring20::new(h).unwrap();
    let slots = FoldTable::new(&integrator).fold(h, &[]).unwrap();
    let run = |program: &Program, p: &SVector<f64, DIM>| program.run(p.as_slice(), &slots);
    for shift in [0.3, 1.9] {
        let p = SVector::from_fn(|i, _| (1.3 * i as f64 + shift).sin());
        let near = |a: &[f64], b: Vec<f64>| {
            assert_eq!(a.len(), b.len());
            assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-14), "{a:?} {b:?}");
        };
        near(step.gradient(&p).as_slice(), run(&integrator.gradient, &p));
        let relative = step.value(&p) / run(&integrator.value, &p)[0] - 1.0;
        assert!(relative.abs() < 1e-13, "{relative:e}");
    }
}

#[test]
fn a_step_in_parts_is_that_of_the_kernel() {
    let step = built::Ring20::new(0.05).unwrap();
    let kernel = Step::build(&integrator()).unwrap();
    let slots = kernel.fold(0.05, &[]).unwrap();
    let mu = SVector::<f64, DIM>::from_fn(|i, _| (0.7 * i as f64).cos());
    let mut phase = Phase::<built::Ring20Group>::at_identity(mu);
    let mut g = [1.0, 0.0, 0.0, 0.0].repeat(DIM / 3);
    let mut moved = mu.as_slice().to_vec();
    step.advance_by(&mut phase, 10).unwrap();
    assert_eq!(kernel.kernel().advance(&slots, &mut g, &mut moved, 10).steps, 10);
    assert!((phase.momentum - SVector::<f64, DIM>::from_vec(moved)).amax() < 1e-14);
}
