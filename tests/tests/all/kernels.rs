//! Steps as programs: of many dimensions, and refused. `laws` measures those on every group and chart.
#![allow(clippy::unwrap_used)]

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::{Options, read};
use coadjoint_program::Stepper;
use coadjoint_tests::kernels::{integrator, limited, unlimited};
use nalgebra::DMatrix;

/// A body in space may move as fast as it likes: of its translation the series knows only the first term.
#[test]
fn momenta_beyond_the_radius_are_those_that_the_series_depends_on() {
    let steps = |hamiltonian: &str, first: f64, fourth: f64| {
        let integrator = integrator("SO3*R3", hamiltonian, "exponential", 7);
        let step = Step::build(&integrator).unwrap();
        let slots = limited(&step, 0.1, 5.0);
        let mut g = step.element_of(DMatrix::<f64>::identity(7, 7).as_slice());
        let mut mu = [first, 0.5, 0.7, fourth, 1.0, 2.0];
        step.kernel().advance(&slots, &mut g, &mut mu, 20).steps
    };
    let body = "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8";
    assert_eq!(steps(body, 0.9, 1e3), 20);
    assert_eq!(steps(body, 6.0, 1.0), 0);
    assert_eq!(steps(&format!("{body} + a*d/9"), 0.9, 1e3), 0);
}

/// Far beyond 24 dimensions, and as many operations as the interpreter evaluates as data: a chain of spins keeps the
/// length of each, and takes the steps of a chain with Newton's method where both are short.
#[test]
fn many_dimensions_have_a_kernel_by_the_fixed_point() {
    let chain = |sites: usize, solver| {
        let text = format!(
            "group = \"SO3^{sites}\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"sum(i, 0..{sites}, z[i]^2/3 - \
             x[i]*x[(i + 1) % {sites}] - y[i]*y[(i + 1) % {sites}])\"\n[integrator]\ntruncation = 3\n"
        );
        let options = Options { solver, ..Options::default() };
        Integrator::build(read(&text, options).unwrap().problem, TermLimit::default()).unwrap()
    };
    let end = |integrator: &Integrator| {
        let step = Step::build(integrator).unwrap();
        let kernel = step.kernel();
        let n = kernel.dim;
        let slots = unlimited(&step, 0.05);
        let mut g: Vec<f64> = (0..n / 3).flat_map(|_| [1.0, 0.0, 0.0, 0.0]).collect();
        let mut mu: Vec<f64> = (0..n).map(|i| (1.3 * i as f64).cos()).collect();
        let start = mu.clone();
        assert_eq!(kernel.advance(&slots, &mut g, &mut mu, 20).steps, 20);
        let length = |mu: &[f64]| mu.iter().map(|x| x * x).sum::<f64>();
        for (before, after) in start.chunks(3).zip(mu.chunks(3)) {
            assert!((length(before) - length(after)).abs() < 1e-13);
        }
        mu
    };
    let large = chain(64, None);
    assert!(large.hessian.is_none());
    end(&large);
    let small = [Solver::Newton, Solver::FixedPoint].map(|solver| end(&chain(3, Some(solver))));
    for (a, b) in small[0].iter().zip(&small[1]) {
        assert!((a - b).abs() < 1e-13, "{small:?}");
    }
}

#[test]
fn steps_driven_too_hard_are_refused_and_leave_the_state() {
    let integrator = integrator("SO3", "a^2/3 + b^2/4 + c^2/5", "exp", 5);
    let step = Step::build(&integrator).unwrap();
    let slots = unlimited(&step, 0.5);
    for start in [vec![1e9, 1e8, 1e9], vec![f64::NAN, 1.0, 1.0], vec![1.0, f64::INFINITY, 1.0]] {
        let (mut g, mut mu) = (vec![1.0, 0.0, 0.0, 0.0], start.clone());
        let outcome = step.kernel().advance(&slots, &mut g, &mut mu, 10);
        assert_eq!(outcome.steps, 0);
        assert_eq!(g, [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(
            mu.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
            start.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        );
    }
    // Beyond the radius of the series.
    let slots = limited(&step, 0.1, 0.5);
    let (mut g, mut mu) = (vec![1.0, 0.0, 0.0, 0.0], vec![0.5, 0.3, 0.1]);
    assert_eq!(step.kernel().advance(&slots, &mut g, &mut mu, 10).steps, 0);
    let (mut g, mut mu) = (vec![1.0, 0.0, 0.0, 0.0], vec![0.3, 0.3, 0.1]);
    assert_eq!(step.kernel().advance(&slots, &mut g, &mut mu, 10).steps, 10);
}
