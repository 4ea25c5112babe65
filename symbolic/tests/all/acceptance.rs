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

/// With pᵢ⁴/8 more.
#[cfg(feature = "judge")]
fn quartic(i: usize, mut problem: Problem) -> Problem {
    let square = Polynomial::variable(problem.algebra.dim(), i).pow(2);
    let fourth = (&square * &square).scale(&ratio(1, 8));
    problem.hamiltonian = &problem.hamiltonian + &fourth;
    problem
}

/// Newton's method from a guess of this degree.
#[cfg(feature = "judge")]
fn poor(degree: usize, hessian_truncation: usize) -> Option<Plan> {
    let (solver, predictor) = (Solver::Newton, Predictor::Explicit(degree));
    Some(Plan { solver, predictor, hessian_truncation })
}

/// The step of a problem with this plan, its coefficients at step size 1, and the judge of the problem.
#[cfg(feature = "judge")]
fn judged(problem: Problem, plan: Option<Plan>) -> (Step, Vec<f64>, Judge) {
    let Problem { algebra, truncation, chart, hamiltonian, .. } = &problem;
    let limit = TermLimit::default();
    let series = derive(algebra, *chart, hamiltonian, *truncation, limit).unwrap();
    let judge = Judge::of_problem(&problem, limit).unwrap();
    let step = Step::build(&Integrator::with_plan(problem, series, plan, limit).unwrap()).unwrap();
    let coefficients = step.fold(1.0, &[]).unwrap();
    (step, coefficients, judge)
}

/// A momentum of many, up to this size.
#[cfg(feature = "judge")]
fn momentum(dim: usize, k: u32, size: f64) -> Vec<f64> {
    let k = f64::from(k);
    let size = size * (0.5 + 0.5 * (0.77 * k).sin());
    (0..dim).map(|i| size * ((1.3 + i as f64) * k + 0.2 * i as f64).sin()).collect()
}

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
    step.kernel().programs.accept.run(&inputs, &folded(&step, radius)) == [1.0]
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

/// If S₃ vanishes, S₁ is the whole series, and motions may part at any rate: a spherical body, with K = 1 as with K = 3.
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
    for (group, place) in [("SO3*R1", 3), ("R1*SO3", 0)] {
        let mut problem = problem(group, BODY, 3, Some(Solver::FixedPoint));
        let unknown = Polynomial::variable(4, place).pow(2).scale(&ratio(BODY[place % 3], 120));
        problem.hamiltonian = &problem.hamiltonian - &unknown;
        let step = built(problem);
        let accepted = |unknown| {
            let mut mu = [0.1, 0.2, 0.3, 0.15];
            mu[place] = unknown;
            step.kernel().attempt(&folded(&step, 1e3), &mu).accepted
        };
        assert!(accepted(0.4) && !accepted(f64::NAN) && !accepted(f64::INFINITY), "{group}");
    }
}

/// A kernel's estimate of a residual suffices: each increment that it accepts solves its equation to rounding. By
/// Newton's method, by chords after a poor guess, by the fixed point; where the Hessian is truncated; where H is no square.
#[cfg(feature = "judge")]
#[test]
fn accepted_increments_solve_their_equation() {
    let cayley = |problem: Problem| Problem { chart: Chart::Cayley, ..problem };
    let of = |group, truncation, solver| problem(group, BODY, truncation, solver);
    let flat = |truncation| problem("SO3", [40, 30, 0], truncation, None);
    let fixed = Some(Solver::FixedPoint);
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
        let dim = algebra.dim();
        let (step, coefficients, judge) = judged(problem, plan);
        let mut setting = judge.at(1.0, &[]).unwrap();
        let (mut accepted, mut worst) = (0, 0.0_f64);
        for k in 0..400 {
            let mu = momentum(dim, k, 1.8);
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

/// Next to a solution the bound that a correction gives its residual holds, however far away it began: by Newton's method
/// and by chords, and where the Hessian knows nothing of the correction, as that of p₃⁴ does not at p₃ = 0.
#[cfg(feature = "judge")]
#[test]
fn the_residual_of_a_correction_is_within_its_acceptance_bound() {
    let of = |group, truncation| problem(group, BODY, truncation, None);
    let flat = |truncation| quartic(2, problem("SO3", [40, 30, 0], truncation, None));
    let problems = [
        (of("SO3", 7), None),
        (of("SO3", 7), poor(2, 7)),
        (quartic(0, of("SO3", 5)), None),
        (flat(3), None),
        (flat(5), poor(2, 5)),
        (of("SE3", 3), poor(2, 3)),
        (of("SO4", 3), None),
    ];
    for (problem, plan) in problems {
        let name = format!("{} {} {plan:?}", problem.algebra.name(), problem.truncation);
        let dim = problem.algebra.dim();
        let (step, coefficients, judge) = judged(problem, plan);
        let mut setting = judge.at(1.0, &[]).unwrap();
        let programs = &step.kernel().programs;
        let mut seen = 0;
        for k in 0..100 {
            let mut mu = momentum(dim, k, 1.2);
            mu[2] *= 0.03;
            if !step.kernel().attempt(&coefficients, &mu).accepted {
                continue;
            }
            let scale = mu.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
            let guess = programs.guess.run(&mu, &coefficients);
            let (guess, constants) = guess.split_at(dim);
            let correct =
                |p: &[f64]| programs.correct.run(&[p, &mu, constants].concat(), &coefficients);
            let solved = (0..8).fold(guess.to_vec(), |p, _| correct(&p)[..dim].to_vec());
            let moved = |distance: f64| {
                let by = |i: usize| ((0.7 + 2.1 * i as f64) * f64::from(k) + 1.0).sin();
                (0..dim).map(|i| solved[i] + distance * scale * by(i)).collect::<Vec<f64>>()
            };
            let mut flat = solved.clone();
            flat[2] = 0.0;
            // Nearer to it a correction within the flat direction is trusted, which no guess has left.
            let is_far = solved[2].abs() > 2e-3 * scale;
            let starts = [1e-6, 1e-4, 9e-4, 1e-2, 4e-2].map(moved);
            for p in starts.iter().chain(is_far.then_some(&flat)) {
                let corrected = correct(p);
                let judged = setting.step(&mu).unwrap();
                let left =
                    judged.at(&corrected[dim..2 * dim]).unwrap().residual(0.5 * f64::EPSILON);
                let bound = 2.0 * corrected[2 * dim] + left.bound;
                assert!(left.residual <= bound, "{name}: {left:?}, {bound:e} at {p:?} for {mu:?}");
                seen += 1;
            }
        }
        assert!(seen > 200, "{name}: {seen}");
    }
}

/// A poor guess is corrected as often as it takes.
#[cfg(feature = "judge")]
#[test]
fn acceptance_waits_for_corrections() {
    let (step, coefficients, _) = judged(problem("SO3", BODY, 7, None), poor(2, 7));
    let (near, far) = ([1e-3, 2e-3, 1e-3], [0.5, 0.6, 0.4]);
    for mu in [near, far] {
        assert!(step.kernel().attempt(&coefficients, &mu).accepted, "{mu:?}");
    }
}

/// At the folded radius the bounds on the last two terms have the largest ratio that is accepted, ½, to the root of 2 by which
/// it is searched. On the unit sphere the gradient of pᵐ of degree D is at most D Π (mᵢ/D)^{mᵢ/2} long (O. Kellogg, 1928), so
/// that of S₃, of degree 3, is ½ of that of S₁, of degree 1, at a square of the radius of half the ratio of their sums.
#[test]
fn the_folded_radius_is_where_the_bounds_have_the_largest_ratio() {
    let problem = problem("SO3", BODY, 3, None);
    let Problem { algebra, chart, hamiltonian, .. } = &problem;
    let series = coadjoint_symbolic::hamilton_jacobi::derive(
        algebra,
        *chart,
        hamiltonian,
        3,
        TermLimit::default(),
    )
    .unwrap();
    let bound = |k: usize| -> f64 {
        let gradient = |(factors, value): (Vec<(u32, u32)>, _)| {
            let degree = factors.iter().map(|(_, power)| f64::from(*power)).sum::<f64>();
            let each = factors.iter().map(|&(_, power)| {
                let power = f64::from(power);
                (power / degree).powf(0.5 * power)
            });
            coadjoint_symbolic::number::nearest_float(&value).abs() * degree * each.product::<f64>()
        };
        series.order(k).factors().map(gradient).sum()
    };
    let exact = (0.5 * bound(1) / bound(3)).sqrt();
    let step = built(problem);
    let radius = step.fold(1.0, &[]).unwrap()[step.radius_at()].sqrt();
    assert!(radius <= exact * (1.0 + 1e-12) && radius * 1.0906 > exact, "{radius} {exact}");
}
