//! The program that accepts a step: each of its conditions, a hair inside and outside.

use coadjoint_symbolic::hamilton_jacobi::TermLimit;
#[cfg(feature = "judge")]
use coadjoint_symbolic::hamilton_jacobi::derive;
use coadjoint_symbolic::integrator::Integrator;
#[cfg(feature = "judge")]
use coadjoint_symbolic::integrator::{Plan, Predictor};
#[cfg(feature = "judge")]
use coadjoint_symbolic::judge::Judge;
use coadjoint_symbolic::lie::{Chart, catalogue};
use coadjoint_symbolic::number::ratio;
use coadjoint_symbolic::poly::Polynomial;
use coadjoint_symbolic::problem::{FrameChoice, Problem, Solver};
use coadjoint_symbolic::step::Step;

/// 60 c of a body.
const BODY: [i64; 3] = [40, 30, 24];

/// ½ Σ cᵢ pᵢ², 60 c being these in turn.
fn problem(group: &str, squares: [i64; 3], truncation: usize, solver: Option<Solver>) -> Problem {
    let algebra = catalogue::lookup(group).unwrap();
    let n = algebra.dim();
    let square = |i: usize| Polynomial::variable(n, i).pow(2).scale(&ratio(squares[i % 3], 120));
    let hamiltonian = (0..n).fold(Polynomial::zero(n), |sum, i| &sum + &square(i));
    Problem {
        name: "body".to_owned(),
        algebra,
        coordinates: (0..n).map(|i| format!("m{i}")).collect(),
        hamiltonian,
        symbols: Vec::new(),
        parameters: Vec::new(),
        source: String::new(),
        chart: Chart::Exponential,
        truncation,
        solver,
        frame: FrameChoice::Fixed,
        comoving: None,
        learned: false,
    }
}

fn built(problem: Problem) -> Step {
    let integrator = Integrator::build(problem, TermLimit::default()).unwrap();
    Step::build(&integrator).unwrap()
}

fn step(group: &str, squares: [i64; 3], truncation: usize, solver: Option<Solver>) -> Step {
    built(problem(group, squares, truncation, solver))
}

/// The coefficients of a step of size 1, where the radius of the series is this.
fn folded(step: &Step, radius: f64) -> Vec<f64> {
    let mut coefficients = step.fold(1.0, &[]).unwrap();
    coefficients[step.radius_at()] = radius * radius;
    coefficients
}

/// The verdict on x, what is left and the way, where the radius of the series is this.
fn verdict(group: &str, radius: f64, mu: &[f64], x: &[f64], left: f64, way: f64) -> bool {
    let step = step(group, BODY, 7, None);
    let inputs = [mu, x, &[left, way]].concat();
    step.kernel().programs().accept.run(&inputs, &folded(&step, radius)) == [1.0]
}

#[test]
fn each_condition_counts() {
    let (mu, x) = ([0.3, 0.4, 0.5], [0.1, 0.2, 0.3]);
    let unit = f64::EPSILON;
    let of = |left, way| verdict("SO3", 1.0, &mu, &x, left, way);
    assert!(of(0.0, 0.0) && of(4.0 * unit, 0.05));
    assert!(!of(4.01 * unit, 0.0) && !of(f64::NAN, 0.0));
    assert!(!of(0.0, 0.0501) && !of(0.0, f64::NAN));
    // The radius, of each factor by itself.
    let size = 0.5_f64.sqrt();
    let at = |radius| verdict("SO3", radius, &mu, &x, 0.0, 0.0);
    assert!(at(1.001 * size) && !at(0.999 * size));
    let two = |radius| verdict("SO3*SO3", radius, &[mu, mu].concat(), &[x, x].concat(), 0.0, 0.0);
    assert!(two(1.001 * size) && !two(0.999 * size));
    let beside = [[0.0; 3], mu].concat();
    let fast = |radius| verdict("SO3*SO3", radius, &beside, &[x, x].concat(), 0.0, 0.0);
    assert!(fast(1.001 * size) && !fast(0.999 * size));
    // A quarter turn with a radius, a sixth of a turn without.
    let turned = |radius, by: f64| verdict("SO3", radius, &mu, &[0.0, by, 0.0], 0.0, 0.0);
    let quarter = std::f64::consts::FRAC_PI_2;
    assert!(turned(1.0, 0.999 * quarter) && !turned(1.0, 1.001 * quarter));
    let sixth = std::f64::consts::FRAC_PI_3;
    assert!(turned(f64::MAX, 0.999 * sixth) && !turned(f64::MAX, 1.001 * sixth));
    assert!(!turned(1.0, f64::NAN) && !turned(1.0, f64::INFINITY));
}

/// K = 1, 3 and 5 limit the rate at which motions part, by Newton's method with its matrices, by the fixed point as the
/// turn. From K = 7 on the ratio of terms suffices.
#[test]
fn series_of_few_terms_limit_the_rate() {
    let accepted = |squares, truncation, solver, size: f64| {
        let step = step("SO3", squares, truncation, Some(solver));
        step.kernel().attempt(&folded(&step, 1e3), &[0.0, 0.0, size]).accepted
    };
    // Along the axis of a saddle x is short, and motions part at a rate of twice |μ|.
    let saddle = |truncation, size| accepted([120, -120, 12], truncation, Solver::Newton, size);
    assert!(saddle(1, 0.4) && !saddle(1, 0.6));
    assert!(saddle(3, 0.5) && !saddle(3, 2.5));
    assert!(saddle(5, 0.6) && !saddle(5, 2.5));
    assert!(saddle(7, 0.6));
    let turn = |truncation, size| accepted(BODY, truncation, Solver::FixedPoint, size);
    assert!(turn(1, 1.8) && !turn(1, 1.95));
    assert!(turn(7, 1.95));
}

/// Where S₃ vanishes S₁ is the whole series, and motions may part at any rate: a spherical body, with K = 1 as with K = 3.
#[test]
fn a_series_that_ends_has_no_limit_of_the_rate() {
    for truncation in [1, 3] {
        let accepted = |squares| {
            let step = step("SO3", squares, truncation, Some(Solver::FixedPoint));
            step.kernel().attempt(&folded(&step, 1e3), &[0.0, 0.0, 3.8]).accepted
        };
        assert!(accepted([24; 3]) && !accepted([40, 30, 24]), "{truncation}");
    }
}

/// A coordinate of which S knows nothing.
#[test]
fn a_coordinate_that_is_not_finite_is_not_hidden_by_others() {
    let mut problem = problem("SO3*R1", BODY, 3, Some(Solver::FixedPoint));
    let last = Polynomial::variable(4, 3).pow(2).scale(&ratio(BODY[0], 120));
    problem.hamiltonian = &problem.hamiltonian - &last;
    let step = built(problem);
    let accepted =
        |last| step.kernel().attempt(&folded(&step, 1e3), &[0.1, 0.2, 0.3, last]).accepted;
    assert!(accepted(0.4) && !accepted(f64::NAN) && !accepted(f64::INFINITY));
}

/// What a kernel estimates of a residual is enough: each increment that it accepts solves its equation to rounding. By
/// Newton's method, by chords after a poor guess, by the fixed point; where the Hessian is truncated; where H is no square.
#[cfg(feature = "judge")]
#[test]
fn accepted_increments_solve_their_equation() {
    let quartic = |i: usize, mut problem: Problem| {
        let square = Polynomial::variable(problem.algebra.dim(), i).pow(2);
        let fourth = (&square * &square).scale(&ratio(1, 8));
        problem.hamiltonian = &problem.hamiltonian + &fourth;
        problem
    };
    let cayley = |problem: Problem| Problem { chart: Chart::Cayley, ..problem };
    let of = |group, truncation, solver| problem(group, BODY, truncation, solver);
    let flat = |truncation| problem("SO3", [40, 30, 0], truncation, None);
    let fixed = Some(Solver::FixedPoint);
    let poor = |degree, hessian_truncation| {
        let (solver, predictor) = (Solver::Newton, Predictor::Explicit(degree));
        Some(Plan { solver, predictor, hessian_truncation })
    };
    let problems = [
        (of("SO3", 7, None), None),
        (of("SO3", 7, None), poor(2, 7)),
        (of("SO3", 7, None), poor(4, 3)),
        (of("SO3", 9, None), None),
        (of("SO3", 5, fixed), None),
        (cayley(of("SO3", 7, None)), None),
        (quartic(0, of("SO3", 5, None)), None),
        (quartic(0, of("SO3", 5, None)), poor(2, 5)),
        (quartic(2, flat(3)), None),
        (quartic(2, flat(5)), poor(2, 5)),
        (quartic(0, of("SU2", 7, None)), None),
        (of("SE2", 5, None), None),
        (of("SE3", 5, None), None),
        (of("SE3", 3, None), poor(2, 3)),
        (quartic(0, of("SE3", 3, None)), None),
        (of("SL2", 5, None), None),
        (of("SO3*SE2", 3, fixed), None),
        (of("SO4", 3, None), None),
        (of("SO3^9", 3, None), None),
    ];
    for (problem, plan) in problems {
        let Problem { algebra, truncation, chart, .. } = &problem;
        let name = format!("{} {truncation} {chart:?} {plan:?}", algebra.name());
        let (dim, limit) = (algebra.dim(), TermLimit::default());
        let series = derive(algebra, *chart, &problem.hamiltonian, *truncation, limit).unwrap();
        let judge = Judge::of_problem(&problem, limit).unwrap();
        let mut setting = judge.at(1.0, &[]).unwrap();
        let integrator = Integrator::with_plan(problem, series, plan, limit).unwrap();
        let step = Step::build(&integrator).unwrap();
        let coefficients = step.fold(1.0, &[]).unwrap();
        let (mut accepted, mut worst) = (0, 0.0_f64);
        for k in 0..400 {
            let k = f64::from(k);
            let size = 1.8 * (0.5 + 0.5 * (0.77 * k).sin());
            let entry = |i: usize| size * ((1.3 + i as f64) * k + 0.2 * i as f64).sin();
            let mu: Vec<f64> = (0..dim).map(entry).collect();
            let found = step.kernel().attempt(&coefficients, &mu);
            if found.accepted {
                accepted += 1;
                let judged = setting.step(&mu).unwrap();
                let point = judged.at(&found.increment).unwrap();
                worst = worst.max(point.residual(0.5 * f64::EPSILON).relative());
            }
        }
        println!("{name}: {accepted} of 400, {worst:.3} of the bound");
        assert!(
            accepted > 50 && worst <= 1.0,
            "{name}: {accepted} of 400, {worst:.3} of the bound"
        );
    }
}
