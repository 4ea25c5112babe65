//! Coefficients fitted to a motion: the same geometry, errors smaller by many orders.

use coadjoint::solve::{ByDimension, NewtonModel, Predict};
use coadjoint::{
    GeneratingFunction, Integrator, Phase, SE3, SO3, StepError,
    generating::Adjustable,
    generating::Reversed,
    generating::Term,
    generating::TermOf as Part,
    generating::VectorOf,
    lanes::F64x4,
    lanes::Lanes,
    laws, lie_poisson,
    nalgebra::{SimdValue, Vector3},
    tune::Fit,
    tune::FitError,
    tune::MAX_FITTED_TERMS,
    tune::fit,
};

#[lie_poisson(group = SO3, truncation = 5)]
fn fifth(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SO3, truncation = 9)]
fn ninth(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SE3, truncation = 5)]
fn top(mu: [f64; 6]) -> f64 {
    (mu[0] * mu[0] + mu[1] * mu[1]) / 4.0 + mu[2] * mu[2] / 2.0 + mu[3]
}

const INERTIA: [f64; 3] = [1.5, 2.0, 2.5];
const START: [f64; 3] = [2.0, 0.5, 1.0];
const STEP: f64 = 0.8;

fn series(step: f64) -> Result<Fifth, StepError> {
    Fifth::new(step, INERTIA)
}

fn fitted() -> Result<Fit<Fifth>, FitError> {
    fit(STEP, series, [START], 12.0)
}

/// The distance in momentum and attitude from a state reached by steps in which rounding rules.
fn error(step: &Fifth) -> Result<f64, StepError> {
    let (mut found, mut exact) = (Phase::<SO3>::at_identity(START), Phase::at_identity(START));
    step.advance_by(&mut found, 100)?;
    Ninth::new(STEP / 16.0, INERTIA)?.advance_by(&mut exact, 1600)?;
    let attitude = found.group_element.angle_to(&exact.group_element);
    Ok(attitude.max((found.momentum - exact.momentum).amax()))
}

#[test]
fn a_short_series_becomes_as_accurate_as_a_long_one() -> Result<(), FitError> {
    let fit = fitted()?;
    let (plain, fitted) = (error(&series(STEP)?)?, error(&fit.integrator)?);
    println!("plain {plain:.1e}, fitted {fitted:.1e}; one step {fit:?}");
    assert!(plain > 1e-5 && fitted < 1e-9, "{plain:e} {fitted:e}");
    // The samples left out tell what a step is off.
    assert!(fit.before > 1e-6 && fit.unseen < 1e-10 && fit.unseen < 10.0 * fit.fitted);
    Ok(())
}

#[test]
fn every_law_holds_for_the_fitted_map() -> Result<(), FitError> {
    let step = fitted()?.integrator;
    let points = [
        Phase::<SO3>::at_identity(START),
        // Far from the motion it was fitted to.
        Phase::<SO3>::at_identity([-0.3, 1.9, 0.8]),
    ];
    for law in laws::check(&step, None, &points)? {
        assert!(law.pass(), "{law:?}");
    }
    let mut body = points[0].clone();
    step.advance(&mut body)?;
    coadjoint::advance(&Reversed(&step), &mut body)?;
    assert!((body.momentum - points[0].momentum).amax() < 1e-14);
    Ok(())
}

#[test]
fn backwards_it_is_the_same_fit() -> Result<(), FitError> {
    let forward = fitted()?.integrator;
    let backward = fit(-STEP, series, [START], 12.0)?;
    assert!(backward.unseen < 1e-10, "{backward:?}");
    let mut body = Phase::<SO3>::at_identity(START);
    forward.advance(&mut body)?;
    backward.integrator.advance(&mut body)?;
    assert!((body.momentum - Vector3::from(START)).amax() < 1e-10);
    Ok(())
}

#[test]
fn a_top_is_fitted() -> Result<(), FitError> {
    let fit = fit(0.1, Top::<f64>::new, [[2.0, 3.0, 4.0, 1.0, 0.0, 0.0]], 20.0)?;
    println!("{:e} {:e} {:e}", fit.before, fit.fitted, fit.unseen);
    assert!(fit.unseen < fit.before / 30.0, "{:e} {:e}", fit.before, fit.unseen);
    let mut phase = Phase::<SE3>::at_identity([2.0, 3.0, 4.0, 1.0, 0.0, 0.0]);
    let before = phase.spatial_momentum(&SE3::new());
    fit.integrator.advance_by(&mut phase, 1000)?;
    assert!((phase.spatial_momentum(&SE3::new()) - before).amax() < 1e-11);
    Ok(())
}

#[test]
fn a_motion_followed_for_long_is_sampled_all_along() -> Result<(), FitError> {
    // Whole steps lead from sample to sample: samples of a short while do not know the rest.
    let start = [2.0, 3.0, 4.0, 1.0, 0.0, 0.0];
    let short = fit(0.1, Top::<f64>::new, [start], 1.0)?.integrator;
    let long = fit(0.1, Top::<f64>::new, [start], 200.0)?.integrator;
    let fine = Top::new(0.1 / 32.0)?;
    let mut exact = Phase::<SE3>::at_identity(start);
    fine.advance_by(&mut exact, 200 * 32)?;
    let error = |step: &Top| {
        let mut found = Phase::<SE3>::at_identity(start);
        step.advance_by(&mut found, 200)?;
        Ok::<_, StepError>((found.momentum - exact.momentum).amax())
    };
    let (short, long) = (error(&short)?, error(&long)?);
    println!("{short:e} {long:e}");
    assert!(long < short / 3.0, "{short:e} {long:e}");
    Ok(())
}

#[test]
fn several_motions_share_a_fit_and_lanes_take_it() -> Result<(), FitError> {
    let momenta = [START, [1.2, 2.5, 0.6]];
    let fit = fit(0.4, series, momenta, 12.0)?;
    assert!(fit.unseen < fit.before / 20.0, "{:e} {:e}", fit.before, fit.unseen);
    let single = fit.integrator.poisson_map(&START.into())?;
    let packed = fit.integrator.splat::<F64x4>();
    let lanes = packed.poisson_map(&START.map(F64x4::splat).into())?;
    for i in 0..3 {
        assert_eq!(lanes[i].extract(2), single[i]);
    }
    Ok(())
}

#[test]
fn a_motion_that_does_not_move_keeps_the_series() -> Result<(), FitError> {
    let fit = fit(STEP, series, [[0.0; 3]], 12.0)?;
    assert_eq!(fit.unseen, fit.before);
    let mu = START.into();
    assert_eq!(fit.integrator.poisson_map(&mu)?, series(STEP)?.poisson_map(&mu)?);
    Ok(())
}

/// The series with a number of terms that nobody would fit.
#[derive(Debug)]
struct Endless(Fifth);

impl GeneratingFunction for Endless {
    type Group = SO3;
    type Chart = coadjoint::Exponential;

    fn group(&self) -> &SO3 {
        self.0.group()
    }

    fn value(&self, p: &VectorOf<Self>) -> f64 {
        self.0.value(p)
    }

    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        self.0.gradient(p)
    }
}

impl Predict for Endless {}
impl NewtonModel for Endless {}
impl Integrator for Endless {
    type Method = ByDimension<Self>;
}

impl Adjustable for Endless {
    fn truncation(&self) -> usize {
        5
    }

    fn terms(&self) -> usize {
        MAX_FITTED_TERMS + 1
    }

    fn term(&self, _: usize) -> Term<'_> {
        Term { of: Part::Series, monomial: &[], order: 5 }
    }

    fn adjusted(&self, _: &[f64]) -> Self {
        Self(self.0.clone())
    }
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let refused = |step, momenta: Vec<[f64; 3]>, duration| {
        fit(step, series, momenta, duration).map(|_| ()).unwrap_err().to_string()
    };
    for duration in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let message = refused(STEP, vec![START], duration);
        assert!(message.starts_with(&format!("duration {duration} is not usable")), "{message}");
    }
    assert!(refused(STEP, vec![START], 1e300).contains("at most 1000000"));
    assert!(refused(STEP, vec![], 12.0).contains("at least one momentum"));
    assert!(refused(0.0, vec![START], 12.0).contains("step size 0"));
    assert!(refused(STEP, vec![[f64::NAN, 0.0, 1.0]], 12.0).contains("not finite"));
    let endless = |step| Ok(Endless(series(step)?));
    let message = fit(STEP, endless, [START], 12.0).map(|_| ()).unwrap_err().to_string();
    assert!(message.starts_with("1025 terms of S would be fitted"), "{message}");
}
