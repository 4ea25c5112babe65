//! The first guess along the flow has the order it says, on several groups.

#![allow(clippy::unwrap_used)]

use coadjoint::nalgebra::SVector;
use coadjoint::{LieGroup, SE3, SO3, groups::FixedDimension, groups::SU3};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::{FoldTable, Integrator, Plan, Predictor};
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::system::{Options, read};

/// |x_guess − x| at a step, x solving p = (d^R exp_x)ᵀ μ with x = ∂S/∂p(p) by plain iteration.
fn error<G, const N: usize>(integrator: &Integrator, step: f64) -> f64
where
    G: LieGroup<Scalar = f64, Vector = SVector<f64, N>> + FixedDimension + Default,
{
    let group = G::default();
    let slots = FoldTable::new(integrator).fold(step, &[]).unwrap();
    let run = |program: &Program, p: &SVector<f64, N>| {
        SVector::<f64, N>::from_vec(program.run(p.as_slice(), &slots))
    };
    let mu = SVector::<f64, N>::from_fn(|i, _| (1.3 + i as f64).sin());
    let mut p = mu;
    for _ in 0..60 {
        p = group.dexp_transpose(&run(&integrator.gradient, &p), &mu);
    }
    let guess = run(&integrator.predictor, &mu);
    (guess - run(&integrator.gradient, &p)).amax()
}

fn has_order<G, const N: usize>(file: &str, step: f64)
where
    G: LieGroup<Scalar = f64, Vector = SVector<f64, N>> + FixedDimension + Default,
{
    let text = std::fs::read_to_string(format!("../examples/{file}.toml")).unwrap();
    let options = Options { truncation: Some(7), ..Options::default() };
    let problem = read(&text, options).unwrap().problem;
    let limit = TermLimit::default();
    let series = Integrator::build(problem.clone(), limit).unwrap().series;
    for degree in [4, 6, 8] {
        let plan = Plan {
            solver: Solver::Newton,
            predictor: Predictor::Flow(degree),
            hessian_truncation: 7,
        };
        let integrator =
            Integrator::with_plan(problem.clone(), series.clone(), Some(plan), limit).unwrap();
        let (coarse, fine) =
            (error::<G, N>(&integrator, step), error::<G, N>(&integrator, step / 2.0));
        let order = (coarse / fine).log2();
        let expected = degree as f64 + 1.0;
        assert!((order - expected).abs() < 0.4, "{file}: {order} for {expected} ({coarse:e})");
    }
}

#[test]
fn guesses_along_the_flow_have_their_order() {
    has_order::<SO3, 3>("free_body_full_inertia", 4.0);
    // Terms linear in the momentum.
    has_order::<SO3, 3>("gyrostat", 0.6);
    has_order::<SE3, 6>("kirchhoff_body", 0.2);
    has_order::<SE3, 6>("kovalevskaya_top", 0.2);
    // Structure constants other than one.
    has_order::<SU3, 8>("su3_quadratic", 0.2);
}
