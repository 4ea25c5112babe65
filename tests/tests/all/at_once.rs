//! Several steps solved at once, in the lanes of one number: the same steps as one by one.

use coadjoint::nalgebra::{Matrix6, Vector6};
use coadjoint::solve::{BlockModel, BlockNewton, LaggedModel, NewtonModel, Predict};
use coadjoint::{
    Chart, Exponential, GeneratingFunction, Integrator, Phase, SE3, StepError, advance, advance_by,
    lie_poisson, plumbing, solve::BLOCK, solve::Linearised, solve::LinearisedOf, solve::solve,
};

/// A heavy body with a rotor: not homogeneous, no symmetry, and few terms, for code in lanes of narrow
/// registers is slow to compile.
#[lie_poisson(group = SE3, truncation = 7)]
fn gyrostat(mu: [f64; 6]) -> f64 {
    let [a, b, c, _, _, w] = mu;
    (a * a + b * b / 2.0 + c * c / 3.0) / 2.0 + a / 5.0 + w / 2.0
}

/// Solved at once whatever the width of registers.
struct InLanes {
    step: Gyrostat,
    /// Whether steps may be refined.
    refines: bool,
}

impl InLanes {
    fn new(h: f64) -> Result<Self, StepError> {
        Ok(Self { step: Gyrostat::new(h)?, refines: true })
    }
}

impl GeneratingFunction for InLanes {
    type Group = SE3;
    type Chart = Exponential;

    fn group(&self) -> &SE3 {
        self.step.group()
    }

    fn value(&self, p: &Vector6<f64>) -> f64 {
        self.step.value(p)
    }

    fn gradient(&self, p: &Vector6<f64>) -> Vector6<f64> {
        self.step.gradient(p)
    }

    fn gradient_and_hessian(&self, p: &Vector6<f64>) -> (Vector6<f64>, Matrix6<f64>) {
        self.step.gradient_and_hessian(p)
    }
}

impl Predict for InLanes {
    fn predict_increment(&self, mu: &Vector6<f64>) -> Option<Vector6<f64>> {
        self.step.predict_increment(mu)
    }
}

impl NewtonModel for InLanes {
    fn bend(&self, x: f64) -> f64 {
        self.step.bend(x)
    }

    fn hessian_defect(&self, size: f64) -> f64 {
        self.step.hessian_defect(size)
    }
}

impl LaggedModel for InLanes {
    fn coarse_gradient(&self, p: &Vector6<f64>) -> Vector6<f64> {
        self.step.coarse_gradient(p)
    }

    fn fine_gradient(&self, p: &Vector6<f64>) -> Vector6<f64> {
        self.step.fine_gradient(p)
    }

    fn leading_product(&self, p: &Vector6<f64>, direction: &Vector6<f64>) -> Vector6<f64> {
        self.step.leading_product(p, direction)
    }
}

impl BlockModel for InLanes {
    fn linearise(&self, mu: &Vector6<f64>, pieces: u32, found: &mut LinearisedOf<Self>) -> bool {
        plumbing::linearise_in_lanes::<Gyrostat, _, 6>(&self.step.coefficients, mu, pieces, found);
        true
    }

    fn refine(&self, found: &mut LinearisedOf<Self>) -> bool {
        plumbing::refine_in_lanes::<Gyrostat, _, 6>(&self.step.coefficients, found);
        self.refines
    }
}

impl Integrator for InLanes {
    type Method = BlockNewton<Self>;
}

/// |Δ(μ, g)|
fn apart(a: &Phase<SE3>, b: &Phase<SE3>) -> f64 {
    (a.momentum - b.momentum).amax()
        + a.group_element.rotation.angle_to(&b.group_element.rotation)
        + (a.group_element.translation.vector - b.group_element.translation.vector).amax()
}

fn start() -> Phase<SE3> {
    Phase::at_identity(Vector6::new(1.0, 0.3, -0.4, 0.2, 0.8, -0.6))
}

/// Short steps, where one matrix is all; longer ones, refined; and such as are too long for it. Blocks, and
/// what is left of them.
#[test]
fn steps_at_once_are_steps_one_by_one() -> Result<(), StepError> {
    for h in [0.02, 0.1, 0.3, 0.45, 0.6, 1.0] {
        let step = InLanes::new(h)?;
        let mut phase = start();
        for steps in [1, 2, 3, 4, 8, 9, 30, 30, 30, 30] {
            let (mut one, mut many) = (phase.clone(), phase.clone());
            for _ in 0..steps {
                advance(&step, &mut one)?;
            }
            let report = advance_by(&step, &mut many, steps)?;
            let refined = report.iterations > 1;
            assert!(if h < 0.2 { !refined } else { refined || h < 0.6 }, "{h} {steps}: {report:?}");
            let apart = apart(&one, &many);
            assert!(apart < 3e-14 * (1.0 + steps as f64), "{h} {steps}: {apart:e}");
            assert!(report.residual < 1e-15, "{h}: {report:?}");
            phase = one;
        }
    }
    Ok(())
}

/// Where steps cannot be refined, long ones go one by one.
#[test]
fn what_one_matrix_does_not_solve_is_solved_otherwise() -> Result<(), StepError> {
    let step = InLanes { refines: false, ..InLanes::new(0.5)? };
    let (mut one, mut many) = (start(), start());
    for _ in 0..200 {
        advance(&step, &mut one)?;
    }
    let report = advance_by(&step, &mut many, 200)?;
    assert!(apart(&one, &many) < 1e-11, "{:e}", apart(&one, &many));
    assert!(report.residual < 1e-15, "{report:?}");
    Ok(())
}

#[test]
fn a_state_that_is_not_finite_is_an_error() -> Result<(), StepError> {
    let step = InLanes::new(0.1)?;
    let mut phase = start();
    phase.momentum[4] = f64::NAN;
    let stopped = advance_by(&step, &mut phase, 20).err();
    assert_eq!(stopped.map(StepError::from), Some(StepError::NonFiniteState));
    let mut at_rest = Phase::<SE3>::at_identity(Vector6::zeros());
    advance_by(&step, &mut at_rest, 20)?;
    assert_eq!(at_rest.momentum, Vector6::zeros());
    Ok(())
}

/// Where momenta are guessed as they are, one linear equation is the whole solve.
#[test]
fn steps_are_solved_to_second_order() -> Result<(), StepError> {
    let solved = |h: f64| -> Result<[f64; 3], StepError> {
        let step = InLanes::new(h)?;
        let (group, chart) = (step.group(), Exponential);
        let mut found = Linearised::zeros(6);
        let mut worst = [0.0_f64; 3];
        for number in 0..4 {
            let mu = Vector6::from_fn(|i, _| (1.3 * f64::from(number) + 2.1 * i as f64).sin());
            assert!(step.linearise(&mu, 6, &mut found));
            for k in 0..BLOCK {
                let mu = found.start[k];
                let exact = solve(&step, &mu)?.x;
                let moved = mu + Vector6::repeat(1e-6);
                let shift = chart.pull_back(group, &found.x[k], &(moved - mu));
                let error = found.x[k] + found.response[k] * shift - solve(&step, &moved)?.x;
                let errors = [(found.x[k] - exact).amax(), found.correction[k], error.amax()];
                for (worst, error) in worst.iter_mut().zip(errors) {
                    *worst = error.max(*worst);
                }
            }
        }
        Ok(worst)
    };
    let (long, short) = (solved(0.4)?, solved(0.2)?);
    assert!(long[0] < 1e-12 && short[0] < 2e-15, "{long:?} {short:?}");
    assert!(long[2] < 1e-11 && short[2] < 1e-11, "{long:?} {short:?}");
    // The guess of x has order eight.
    let gain = (long[1] / short[1]).log2();
    assert!((8.3..9.7).contains(&gain), "{gain}");
    Ok(())
}

/// By a method of order six, in as many pieces as asked for.
#[test]
fn the_next_steps_are_guessed_to_their_order() -> Result<(), StepError> {
    let error = |h: f64, pieces: u32| -> Result<f64, StepError> {
        let (step, fine) = (InLanes::new(h)?, Gyrostat::new(h / 32.0)?);
        let mut found = Linearised::zeros(6);
        let mut phase = start();
        assert!(step.linearise(&phase.momentum, pieces, &mut found));
        let mut worst = 0.0_f64;
        for guess in found.start {
            worst = worst.max((guess - phase.momentum).amax());
            advance_by(&fine, &mut phase, 32)?;
        }
        Ok(worst)
    };
    // Its leading error is small: at these steps the next one shows too.
    let order = (error(0.2, 2)? / error(0.1, 2)?).log2();
    assert!((6.5..8.5).contains(&order), "{order}");
    let order = (error(0.2, 1)? / error(0.2, 2)?).log2();
    assert!((5.5..7.5).contains(&order), "{order} in pieces");
    Ok(())
}
