//! SIMD lanes compute the bits of the scalar integrator.

use std::mem::discriminant;

use coadjoint::groups::{Product, SE2};
use coadjoint::lanes::{F64x4, F64x8, Lanes, ensemble};
use coadjoint::nalgebra::{SVector, SimdValue};
use coadjoint::plumbing::Number;
use coadjoint::steps::{Steps, Stopped};
use coadjoint::{Phase, SE3, SO3, Scalar, StepError, lie_poisson};

use crate::comoving::{MU, slow};
use crate::emitted_steps::side_by_side::SideBySide;
use crate::smooth::Relativistic;

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

const INERTIA: [f64; 3] = [1.5, 2.0, 2.5];

/// States of very different speed, so that lanes need different numbers of Newton steps.
fn states(count: usize) -> Vec<Phase<SO3>> {
    (0..count)
        .map(|i| {
            let a = i as f64;
            let size = 0.1 + 0.35 * (a % 11.0);
            Phase::at_identity([size * (0.7 * a).cos(), 0.3 * size, size * (1.3 * a).sin()])
        })
        .collect()
}

fn one_by_one(step: &RigidBody, mut states: Vec<Phase<SO3>>, steps: u64) -> Vec<Phase<SO3>> {
    for state in &mut states {
        // One that fails stays where it was before the step that failed.
        step.advance_by(state, steps).ok();
    }
    states
}

fn assert_same_bits(left: &[Phase<SO3>], right: &[Phase<SO3>]) {
    for (index, (left, right)) in left.iter().zip(right).enumerate() {
        assert_eq!(left.momentum, right.momentum, "momentum {index}");
        assert_eq!(left.group_element.coords, right.group_element.coords, "attitude {index}");
    }
}

fn in_lanes<L>(h: f64, states: &[Phase<SO3>], steps: u64) -> Result<(), StepError>
where
    L: Scalar + SimdValue<Element = f64>,
{
    let expected = one_by_one(&RigidBody::new(h, INERTIA)?, states.to_vec(), steps);
    let packed = RigidBody::<L>::new(L::splat(h), INERTIA.map(L::splat))?;
    for (states, expected) in states.chunks(L::LANES).zip(expected.chunks(L::LANES)) {
        let mut lanes = Phase::<SO3<L>>::new(
            SimdValue::splat(states[0].group_element),
            SVector::<L, 3>::splat(states[0].momentum),
        );
        for (lane, state) in states.iter().enumerate() {
            lanes.group_element.replace(lane, state.group_element);
            lanes.momentum.replace(lane, state.momentum);
        }
        packed.advance_by(&mut lanes, steps)?;
        let alone =
            |lane| Phase::new(lanes.group_element.extract(lane), lanes.momentum.extract(lane));
        assert_same_bits(&(0..states.len()).map(alone).collect::<Vec<_>>(), expected);
    }
    Ok(())
}

#[test]
fn lanes_equal_scalars_bit_for_bit() -> Result<(), StepError> {
    for h in [0.01, 0.3, 0.5] {
        in_lanes::<F64x4>(h, &states(16), 40)?;
        in_lanes::<F64x8>(h, &states(16), 40)?;
    }
    Ok(())
}

/// An ensemble in steps that are refused for some, each of which ends as it does alone: the indices of those refused.
fn refused<S: Lanes + Steps + Sync>(
    step: &S,
    mut states: Vec<Phase<S::Group>>,
    steps: u64,
    alone: impl Fn(&S, &mut Phase<S::Group>, u64) -> Result<(), Stopped>,
) -> Vec<usize>
where
    Phase<S::Group>: Send,
{
    let mut others = states.clone();
    let failures = ensemble::advance_all(step, &mut states, steps);
    for (index, (state, other)) in states.iter().zip(&mut others).enumerate() {
        // Alone it is told, too, which step would do.
        let stopped = alone(step, other, steps).err();
        let stopped = stopped.map(|stopped| (stopped.steps, discriminant(&stopped.error)));
        let failed = failures.iter().find(|failure| failure.index == index);
        let failed = failed.map(|failure| (failure.step, discriminant(&failure.error)));
        assert_eq!(failed, stopped, "{index}");
        // The text of a number tells every bit.
        assert_eq!(format!("{state:?}"), format!("{other:?}"), "{index}");
    }
    failures.into_iter().map(|failure| failure.index).collect()
}

/// By [`refused`] of steps that the attribute makes.
macro_rules! refused {
    ($step:expr, $states:expr, $steps:expr) => {
        refused(&$step, $states, $steps, |step, state, steps| {
            step.advance_by(state, steps).map(drop)
        })
    };
}

#[lie_poisson(group = SE3, truncation = 7)]
fn fluid(mu: [f64; 6]) -> f64 {
    let [a, b, c, u, v, w] = mu;
    (a * a + b * b / 2.0 + c * c / 3.0 + u * u + v * v / 2.0 + w * w / 4.0) / 2.0
}

/// States of very different speed: some need one correction, some more.
fn uneven() -> Vec<Phase<SE3>> {
    let sizes = [0.05, 0.3, 1.0, 2.6, 0.0, 0.7, 1.7, 0.2];
    let state = |(k, size): (usize, f64)| {
        let mu = SVector::from_fn(|i, _| size * (1.3 * k as f64 + 2.1 * i as f64).sin());
        Phase::<SE3>::at_identity(mu)
    };
    sizes.into_iter().enumerate().map(state).collect()
}

#[test]
fn an_ensemble_equals_its_trajectories_and_reports_the_bad_ones() -> Result<(), StepError> {
    let mut initial = states(1003);
    initial[17].momentum[1] = f64::INFINITY;
    initial[640].momentum *= 1e4;
    assert_eq!(refused!(RigidBody::new(0.4, INERTIA)?, initial, 25), [17, 640]);
    // Steps of more than a quarter turn have to be confirmed, which ensembles do one by one.
    assert_eq!(refused!(RigidBody::new(0.9, INERTIA)?, states(16), 40), [0; 0]);
    // Long series; in some packs a lane is refused, so that all of them go one by one.
    for h in [0.05, 0.3, 0.8] {
        refused!(Fluid::new(h)?, uneven(), 10);
    }
    // In a comoving frame, by collocation, and on a product.
    assert_eq!(refused!(slow(0.2)?, vec![Phase::<SE3>::at_identity(MU); 11], 300), [0; 0]);
    let mut fast = states(21);
    fast[9].momentum[0] = f64::NAN;
    assert_eq!(refused!(Relativistic::new(0.3, INERTIA)?, fast, 600), [9]);
    let start = Phase::<Product<SO3, SE2, 6>>::at_identity([0.4, 0.8, -0.3, 0.2, -0.6, 0.5]);
    assert_eq!(refused!(SideBySide::new(0.05)?, vec![start; 9], 200), [0; 0]);
    Ok(())
}

#[test]
fn ensembles_check_their_states_where_printed_loops_do() {
    assert_eq!(coadjoint::plumbing::BLOCK, coadjoint_program::BLOCK);
}

/// As the interpreter of programs rounds: to the even one of two integers, in scalars and in lanes.
#[test]
fn numbers_are_rounded_as_programs_round_them() {
    for x in [0.0, 0.3, 0.5, 1.5, 2.5, 2.7, 1e9 + 0.5, 4503599627370495.5, 1e300, f64::INFINITY] {
        for x in [x, -x] {
            let rounded = x.round_ties_even();
            assert_eq!(Number::simd_round(x).to_bits(), rounded.to_bits(), "{x}");
            assert_eq!(Number::simd_round(F64x4::splat(x)), F64x4::splat(rounded), "{x}");
            let x = x as f32;
            assert_eq!(Number::simd_round(x).to_bits(), x.round_ties_even().to_bits(), "{x}");
        }
    }
}
