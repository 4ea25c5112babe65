//! Acceptance of steps: for each of its conditions a case that goes wrong without it. `tests/src/bin/mutants.rs` takes out
//! one after another and expects a failure here.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::generating::{GeneratingFunction, PolynomialFunction};
use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::lanes::F64x4;
use coadjoint::solve::Integrator;
use coadjoint::solve::{Settings, Solver, solve, solve_from};
use coadjoint::steps::advance;
use coadjoint::steps::advance_with;
use coadjoint::{Phase, SO3, StepError};
use nalgebra::{Matrix3, SimdValue, Vector3};

type Terms = Vec<(f64, Vec<(usize, u32)>)>;

/// ½ Σ cᵢ pᵢ²
fn squares(c: [f64; 3]) -> Terms {
    (0..3).map(|i| (0.5 * c[i], vec![(i, 2)])).collect()
}

fn function<C: Chart<SO3>>(chart: C, terms: Terms) -> PolynomialFunction<SO3, C> {
    PolynomialFunction::new(SO3::new(), chart, terms).unwrap()
}

/// S₁ and S₃ of a series.
fn series(first: Terms, third: Terms) -> PolynomialFunction<SO3, Exponential> {
    let of = |order, terms: Terms| terms.into_iter().map(move |(c, factors)| (order, c, factors));
    let terms = of(1, first).chain(of(3, third));
    PolynomialFunction::of_series(SO3::new(), Exponential, terms).unwrap()
}

/// |x − ∂S(p)| at the p that x defines.
fn residual<S>(step: &S, mu: &Vector3<f64>, x: &Vector3<f64>) -> f64
where
    S: GeneratingFunction<Group = SO3>,
{
    let p = S::Chart::default().pull_back(step.group(), x, mu);
    (x - step.gradient(&p)).amax()
}

/// Beyond a fork: along the third axis x = (0, 0, θ) solves the equation of ½(a p₁² − a p₂² + θ p₃²), μ = (0, 0, 1), but
/// the solution that begins at the identity has left the axis before.
fn forked(theta: f64) -> PolynomialFunction<SO3, Exponential> {
    function(Exponential, squares([3.0, -3.0, theta]))
}

const AXIS: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);

#[test]
fn a_solution_beyond_a_fork_is_refused() {
    type Step<'a> = dyn Fn(&Vector3<f64>) -> Result<Vector3<f64>, StepError> + 'a;
    let refused = |step: &Step<'_>| {
        let error = step(&AXIS).unwrap_err();
        assert!(matches!(error, StepError::NotFollowed { .. }), "{error}");
    };
    // Beyond a sixth of a turn.
    for theta in [1.1, 1.5, 2.5] {
        refused(&|mu| solve(&forked(theta), mu).map(|solution| solution.x));
    }
    // Of a series with a radius, beyond a quarter of a turn.
    for theta in [1.6, 2.5] {
        let cubic = squares([3.0, -3.0, theta]);
        let step = series(cubic, vec![(1e-6, vec![(2, 4)])]);
        assert!(step.radius() > 10.0 && step.radius() < 1e6);
        refused(&|mu| solve(&step, mu).map(|solution| solution.x));
    }
    // Below, being near the guess is enough: on the axis the guess is exact.
    assert!(solve(&forked(1.0), &AXIS).is_ok());
}

/// Next to the axis there are two solutions, one near it, the right one far from it.
#[test]
fn another_solution_is_told_from_the_right_one() {
    let (step, mu) =
        (function(Exponential, squares([3.0, -3.0, 1.5])), Vector3::new(1e-3, 0.0, 1.0));
    let error = solve(&step, &mu).unwrap_err();
    assert!(matches!(error, StepError::NotFollowed { .. }), "{error}");
}

/// A body whose solution lies far from its guess is followed from the identity, in stretches short enough.
#[test]
fn a_solution_far_from_its_guess_is_followed() {
    let step = function(Exponential, squares([0.4, 1.0, 1.6]));
    let mut far = 0;
    for k in 0..60 {
        let mu = Vector3::new((1.0 + f64::from(k)).sin(), (2.0 * f64::from(k)).cos(), 0.9);
        let guess = 3.0 * mu + Vector3::new(0.5, -0.5, 0.0);
        let [near, other] = [solve(&step, &mu), solve_from(&step, &mu, guess)];
        if let (Ok(near), Ok(other)) = (&near, &other) {
            assert!((near.x - other.x).amax() < 1e-12, "{k}");
            assert!(residual(&step, &mu, &other.x) < 1e-14, "{k}");
            far += 1;
        }
        assert_eq!(near.is_ok(), other.is_ok(), "{k}");
    }
    assert!(far > 40, "{far}");
}

/// The chart's limit: half a turn, and the half turn of Cayley's parameter.
#[test]
fn steps_end_at_the_limit_of_the_chart() {
    let outside = |error: StepError| matches!(error, StepError::OutsideChart { .. });
    let limit = std::f64::consts::PI;
    let exponential = |theta| function(Exponential, squares([theta; 3]));
    let cayley = |length| function(Cayley, squares([length; 3]));
    assert!(solve(&exponential(0.99 * limit), &AXIS).is_ok());
    assert!(outside(solve(&exponential(1.01 * limit), &AXIS).unwrap_err()));
    // On the axis of Cayley's chart p = μ/(1 + x²/4).
    let within = solve(&cayley(1.8), &AXIS).unwrap();
    assert!(within.x.norm() < 2.0);
    let long = Vector3::new(0.0, 0.0, 5.0);
    assert!(outside(solve(&cayley(1.8), &long).unwrap_err()));
}

/// The last two terms of a series: accepted up to a ratio of one half, unless whoever asks knows better.
#[test]
fn series_are_judged_by_the_ratio_of_their_terms() {
    // ∂S₁ = 0.2 p₃, ∂S₃ = 4 c p₃³.
    let step = |ratio: f64| series(squares([0.0, 0.0, 0.2]), vec![(0.05 * ratio, vec![(2, 4)])]);
    assert!(solve(&step(0.499), &AXIS).is_ok());
    let error = solve(&step(0.501), &AXIS).unwrap_err();
    assert!(matches!(error, StepError::SeriesDiverges { .. }), "{error}");
    let mut phase = Phase::<SO3>::at_identity(AXIS);
    assert!(advance_with(&step(0.501), &mut phase, Settings::default().with_any_ratio()).is_ok());
}

#[test]
fn a_momentum_that_is_not_finite_is_named() {
    for bad in [f64::NAN, f64::INFINITY] {
        let error = solve(&forked(0.5), &Vector3::new(0.1, bad, 0.2)).unwrap_err();
        assert_eq!(error, StepError::NonFiniteState);
    }
}

/// S with another Hessian than its own, and a first guess of its own.
#[derive(Clone, Debug)]
struct Misled {
    step: PolynomialFunction<SO3, Exponential>,
    hessian: f64,
    guess: Option<Vector3<f64>>,
    rate: f64,
}

impl GeneratingFunction for Misled {
    type Group = SO3;
    type Chart = Exponential;

    fn group(&self) -> &SO3 {
        self.step.group()
    }

    fn value(&self, p: &Vector3<f64>) -> f64 {
        self.step.value(p)
    }

    fn gradient(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.step.gradient(p)
    }

    fn gradient_and_hessian(&self, p: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let (gradient, hessian) = self.step.gradient_and_hessian(p);
        (gradient, self.hessian * hessian)
    }

    fn largest_rate(&self) -> f64 {
        self.rate
    }
}

impl Integrator for Misled {
    fn solver(&self) -> Solver {
        Solver::Newton
    }

    fn predict(&self, mu: &Vector3<f64>) -> Vector3<f64> {
        self.guess.unwrap_or_else(|| Exponential.pull_back(self.group(), &self.gradient(mu), mu))
    }
}

fn misled(c: [f64; 3], hessian: f64) -> Misled {
    let step = function(Exponential, squares(c));
    Misled { step, hessian, guess: None, rate: f64::MAX }
}

/// A residual that is estimated to be small but is not: beyond a sixth of a turn estimates are measured.
#[test]
fn a_false_small_residual_is_measured() {
    let mu = Vector3::new(0.55, 0.0, 1.0);
    let mut judged = 0;
    for theta in [1.1, 1.2, 1.4] {
        let step = misled([0.95 * theta, theta, theta], 1e-9);
        match solve(&step, &mu) {
            Ok(solution) => assert!(residual(&step, &mu, &solution.x) < 1e-13, "{theta}"),
            Err(_) => judged += 1,
        }
    }
    assert!(judged > 0);
}

/// ½·0.3 |p|² and waves so short that Newton's method does not always settle on one.
struct Rough(SO3);

impl Rough {
    const HEIGHT: f64 = 4.0;
    const WAVES: f64 = 1000.0;
}

impl GeneratingFunction for Rough {
    type Group = SO3;
    type Chart = Exponential;

    fn group(&self) -> &SO3 {
        &self.0
    }

    fn value(&self, p: &Vector3<f64>) -> f64 {
        let waves = p.map(|p| (Self::WAVES * p).sin()).sum();
        0.15 * p.norm_squared() + Self::HEIGHT / Self::WAVES.powi(2) * waves
    }

    fn gradient(&self, p: &Vector3<f64>) -> Vector3<f64> {
        p.map(|p| 0.3 * p + Self::HEIGHT / Self::WAVES * (Self::WAVES * p).cos())
    }

    fn gradient_and_hessian(&self, p: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let curve = p.map(|p| 0.3 - Self::HEIGHT * (Self::WAVES * p).sin());
        (self.gradient(p), Matrix3::from_diagonal(&curve))
    }
}

impl Integrator for Rough {}

/// Whatever Newton's method has come to: an equation that is not solved is refused.
#[test]
fn an_equation_that_is_not_solved_is_refused() {
    let step = Rough(SO3::new());
    let mut refused = 0;
    for k in 0..200 {
        let k = f64::from(k);
        let mu = Vector3::new(k.sin(), (1.7 * k).cos(), (0.3 * k).sin());
        match solve(&step, &mu) {
            Ok(solution) => {
                let left = residual(&step, &mu, &solution.x);
                assert!(left < 1e-11, "{k}: {left:e}");
            }
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 0);
}

/// A first correction that the Hessian at the guess knows nothing of: at p₃ = 0 that of p₃⁴ vanishes.
#[test]
fn a_long_first_correction_is_not_trusted() {
    let step = function(Exponential, vec![(2.0, vec![(2, 4)])]);
    let mu = Vector3::new(0.0, 0.0, 0.04) + Vector3::new(1.0, 0.0, 0.0);
    let found = solve_from(&step, &mu, Vector3::new(1.0, 0.0, 0.0)).unwrap();
    assert!(residual(&step, &mu, &found.x) < 1e-15, "{:e}", residual(&step, &mu, &found.x));
}

/// The rate at which motions part, where S limits it.
#[test]
fn motions_that_part_too_fast_are_refused() {
    let mu = Vector3::new(0.2, 0.3, 0.9);
    let at = |rate| Misled { rate, ..misled([0.1, 0.5, 0.9], 1.0) };
    let accepted = |rate| solve(&at(rate), &mu).is_ok();
    assert!(accepted(f64::MAX) && accepted(1.2) && !accepted(0.3));
    let error = solve(&at(0.3), &mu).unwrap_err();
    assert!(matches!(error, StepError::SeriesDiverges { .. }), "{error}");
    // Motions of a spherical body turn alike: they part to second order only.
    let spherical = Misled { rate: 0.3, ..misled([0.9; 3], 1.0) };
    assert!(solve(&spherical, &AXIS).is_ok());
}

/// One lane that must be refused refuses them all, and leaves the state as it was.
#[test]
fn a_refused_lane_refuses_its_neighbours() {
    let of = |theta: f64| {
        PolynomialFunction::new(SO3::<F64x4>::new(), Exponential, squares([3.0, -3.0, theta]))
            .unwrap()
    };
    let lanes = |third: [f64; 4]| {
        let [zero, momentum] = [F64x4::splat(0.0), F64x4::from(third)];
        Phase::<SO3<F64x4>>::at_identity(Vector3::new(zero, zero, momentum))
    };
    let mut good = lanes([1.0, 0.5, 0.2, 0.1]);
    assert!(advance(&of(0.9), &mut good).is_ok());
    let mut bad = lanes([0.1, 1.5, 0.2, 0.1]);
    let before = format!("{bad:?}");
    assert!(advance(&of(0.9), &mut bad).is_err());
    assert_eq!(format!("{bad:?}"), before);
}
