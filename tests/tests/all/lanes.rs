//! SIMD lanes compute the bits of the scalar integrator.

use coadjoint::nalgebra::SimdValue;
use coadjoint::{
    Phase, SO3, StepError, lanes::F64x4, lanes::F64x8, lanes::LaneGroup, lanes::Lanes,
    lanes::ensemble, lie_poisson,
};

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

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

fn in_lanes<L>(step: &RigidBody, states: &[Phase<SO3>], steps: u64) -> Result<(), StepError>
where
    L: coadjoint::Scalar + SimdValue<Element = f64>,
{
    let expected = one_by_one(step, states.to_vec(), steps);
    let packed = step.splat::<L>();
    for (states, expected) in states.chunks(L::LANES).zip(expected.chunks(L::LANES)) {
        let mut lanes = <SO3 as LaneGroup>::splat::<L>(&states[0]);
        for (lane, state) in states.iter().enumerate() {
            <SO3 as LaneGroup>::insert(&mut lanes, lane, state);
        }
        packed.advance_by(&mut lanes, steps)?;
        let got: Vec<_> =
            (0..states.len()).map(|lane| <SO3 as LaneGroup>::extract(&lanes, lane)).collect();
        assert_same_bits(&got, expected);
    }
    Ok(())
}

#[test]
fn lanes_equal_scalars_bit_for_bit() -> Result<(), StepError> {
    for h in [0.01, 0.3, 0.5] {
        let step = RigidBody::new(h, [1.5, 2.0, 2.5])?;
        in_lanes::<F64x4>(&step, &states(16), 40)?;
        in_lanes::<F64x8>(&step, &states(16), 40)?;
    }
    Ok(())
}

/// Steps of more than a quarter turn have to be confirmed, which ensembles do one by one.
#[test]
fn long_steps_of_an_ensemble_are_those_of_its_trajectories() -> Result<(), StepError> {
    let step = RigidBody::new(0.9, [1.5, 2.0, 2.5])?;
    let mut advanced = states(16);
    assert!(ensemble::advance_all(&step, &mut advanced, 40).is_empty());
    assert_same_bits(&advanced, &one_by_one(&step, states(16), 40));
    Ok(())
}

#[test]
fn an_ensemble_equals_its_trajectories_and_reports_the_bad_ones() -> Result<(), StepError> {
    let step = RigidBody::new(0.4, [1.5, 2.0, 2.5])?;
    let mut initial = states(1003);
    initial[17].momentum[1] = f64::INFINITY;
    initial[640].momentum *= 1e4;
    let mut advanced = initial.clone();
    let failures = ensemble::advance_all(&step, &mut advanced, 25);
    let bad: Vec<usize> = failures.iter().map(|failure| failure.index).collect();
    assert_eq!(bad, [17, 640]);
    assert_same_bits(&advanced, &one_by_one(&step, initial, 25));
    Ok(())
}

#[test]
fn ensembles_check_their_states_where_printed_loops_do() {
    assert_eq!(coadjoint::plumbing::BLOCK, coadjoint_program::BLOCK);
}
