//! Steps as programs make the runtime's steps, to rounding, on every group and chart.
#![allow(clippy::unwrap_used)]

use coadjoint::generating::PolynomialFunction;
use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::groups::{CayleyMatrixGroup, MatrixGroup};
use coadjoint::steps::advance;
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::{Options, read};
use coadjoint_program::Stepper;
use coadjoint_tests::backends::entries_of;
use coadjoint_tests::bridge::{matrix_group, series_function};
use coadjoint_tests::kernels::{SYSTEMS, integrator, integrator_by, limited, unlimited};
use nalgebra::{DMatrix, DVector};

fn momentum(n: usize, size: f64) -> Vec<f64> {
    (0..n).map(|i| size * (1.3 + 2.1 * i as f64).sin()).collect()
}

fn compare<G, C>(
    name: &str,
    integrator: &Integrator,
    group: G,
    runtime: &PolynomialFunction<G, C>,
    h: f64,
) where
    G: LieGroup<Scalar = f64, Vector = DVector<f64>>,
    C: Chart<G>,
{
    let step = Step::build(integrator).unwrap();
    let kernel = step.kernel();
    let slots = unlimited(&step, h);
    let n = kernel.dim;
    let mut phase = Phase::<G>::new(group.identity(), DVector::from_vec(momentum(n, 0.9)));
    let mut g = step.element_of(&entries_of(&group, &phase.group_element));
    let mut mu = phase.momentum.as_slice().to_vec();
    const STEPS: u64 = 20;
    let outcome = kernel.advance(&slots, &mut g, &mut mu, STEPS);
    assert_eq!(outcome.steps, STEPS, "{name}: refused");
    let most = if integrator.hessian.is_some() { 8 } else { 12 };
    assert!(outcome.corrections <= most, "{name}: {} corrections", outcome.corrections);
    assert!(outcome.residual <= 4.0 * f64::EPSILON, "{name}: {:e} is left", outcome.residual);
    for _ in 0..STEPS {
        advance(runtime, &mut phase).unwrap();
    }
    let scale = phase.momentum.amax();
    for (found, wanted) in mu.iter().zip(&phase.momentum) {
        assert!((found - wanted).abs() < 4e-14 * scale, "{name}: μ {found} for {wanted}");
    }
    let found = kernel.programs.matrix.run(&g, &[]);
    let wanted = entries_of(&group, &phase.group_element);
    let largest = wanted.iter().fold(1.0_f64, |a, b| a.max(b.abs()));
    for (found, wanted) in found.iter().zip(&wanted) {
        assert!((found - wanted).abs() < 1e-13 * largest, "{name}: g {found} for {wanted}");
    }
    watched(name, &step, &slots, &momentum(n, 0.9), &mu, &g);
}

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

/// Energy and Casimirs at the end are what they were.
fn watched(name: &str, step: &Step, slots: &[f64], start: &[f64], mu: &[f64], g: &[f64]) {
    let kernel = step.kernel();
    let [before, after] = [start, mu].map(|mu| kernel.watch(slots, g, mu));
    // Up to the error of the truncation, which may be small.
    assert!((before[0] - after[0]).abs() < 1e-2 * before[0].abs(), "{name}: energy");
    for (before, after) in before.iter().zip(&after).skip(1) {
        assert!((before - after).abs() < 1e-13 * before.abs().max(1.0), "{name}: Casimir");
    }
}

#[test]
fn programs_make_the_steps_of_the_runtime() {
    let mut tried = 0;
    let newton = [3, 5, 7].map(|truncation| (Solver::Newton, truncation));
    for (group, hamiltonian) in SYSTEMS {
        for (solver, truncation) in newton.into_iter().chain([(Solver::FixedPoint, 5)]) {
            if truncation == 7 && group.starts_with("SU3") {
                continue;
            }
            for chart in ["exp", "cayley"] {
                let algebra = lie::catalogue::lookup(group).unwrap();
                let cayley = chart == "cayley";
                if cayley && lie::Chart::Cayley.check(&algebra).is_err() {
                    continue;
                }
                let name = format!("{group}, {chart}, K = {truncation}, {solver:?}");
                let integrator = integrator_by(solver, group, hamiltonian, chart, truncation);
                // The runtime's function of a series knows no frame; `fields` compares steps in frames.
                if !integrator.frame.is_empty() {
                    continue;
                }
                let own = matrix_group(&algebra).unwrap();
                let h = 0.2;
                if cayley {
                    let own: CayleyMatrixGroup = own.into_cayley().unwrap();
                    let runtime =
                        series_function(own.clone(), Cayley, &integrator.series, h).unwrap();
                    compare(&name, &integrator, own, &runtime, h);
                } else {
                    let own: MatrixGroup = own;
                    let runtime =
                        series_function(own.clone(), Exponential, &integrator.series, h).unwrap();
                    compare(&name, &integrator, own, &runtime, h);
                }
                tried += 1;
            }
        }
    }
    assert!(tried > 60, "{tried}");
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

#[test]
fn a_frame_moves_as_far_as_it_spins() {
    // A body that spins many turns a step: the motion about its axis is in the frame.
    let text = "group = \"SO3\"\ncoordinates = [\"a\", \"b\", \"c\"]\nhamiltonian = \"a^2/3 + b^2/3.2 + c^2/4\"\n[integrator]\nframe = \"comoving\"\n";
    let options = Options { truncation: Some(7), ..Options::default() };
    let problem = read(text, options).unwrap().problem;
    let integrator = Integrator::build(problem, TermLimit::default()).unwrap();
    assert!(!integrator.frame.is_empty());
    let step = Step::build(&integrator).unwrap();
    let advance = |h: f64, steps: u64| {
        let slots = unlimited(&step, h);
        let (mut g, mut mu) = (vec![1.0, 0.0, 0.0, 0.0], vec![0.3, 0.2, 1.0]);
        assert_eq!(step.kernel().advance(&slots, &mut g, &mut mu, steps).steps, steps);
        (g, mu)
    };
    // Long and short steps to the same time.
    let ((g, mu), (h, nu)) = (advance(2.0, 300), advance(0.25, 2400));
    for (a, b) in mu.iter().zip(&nu) {
        assert!((a - b).abs() < 1e-6, "{mu:?} {nu:?}");
    }
    let aligned = g.iter().zip(&h).map(|(a, b)| a * b).sum::<f64>();
    assert!((aligned.abs() - 1.0).abs() < 1e-6, "{g:?} {h:?}");
}
