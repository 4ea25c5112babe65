//! `frame = comoving`: every way to step moves the frame. The cases `comoving_*` of the command compare motions and laws.
#![allow(clippy::unwrap_used)]

use coadjoint::generating::Reversed;
use coadjoint::steps::{advance, poisson_map};
use coadjoint::{Phase, SE3, StepError, lie_poisson};
use coadjoint_tests::matrix_free::MatrixFree;

/// A symmetric top in a frame that turns about its axis: a linear term, too.
#[lie_poisson(group = SE3, truncation = 3, frame = comoving)]
pub fn short(mu: [f64; 6], transverse: f64, axial: f64, weight: f64, frame: f64) -> f64 {
    let [x, y, z, _, v, _] = mu;
    (x * x + z * z) / (2.0 * transverse) + y * y / (2.0 * axial) + weight * v - frame * y
}

pub const MU: [f64; 6] = [0.3, -1.7, 0.8, 0.2, 0.9, -0.4];

/// A top that spins slowly: the moments of inertia, the weight, and the rate of the frame.
const SLOW: [f64; 4] = [0.9, 0.7, 0.6, 0.4];

pub fn slow(step: f64) -> Result<Short, StepError> {
    let [transverse, axial, weight, frame] = SLOW;
    Short::new(step, transverse, axial, weight, frame)
}

#[test]
fn every_way_to_step_moves_the_frame() -> Result<(), StepError> {
    let step = slow(0.2)?;
    let start = Phase::<SE3>::at_identity(MU);
    // More steps than the frame makes at once.
    let (mut one, mut many) = (start.clone(), start.clone());
    for _ in 0..300 {
        step.advance(&mut one)?;
    }
    step.advance_by(&mut many, 300)?;
    let close = |a: &Phase<SE3>, b: &Phase<SE3>| {
        (a.momentum - b.momentum).amax() < 1e-12
            && a.group_element.rotation.angle_to(&b.group_element.rotation) < 1e-12
    };
    assert!(close(&one, &many), "{one:?} {many:?}");

    let mut next = start.clone();
    advance(&step, &mut next)?;
    let moved = poisson_map(&step, &start.momentum)?;
    assert!((moved - next.momentum).amax() < 1e-15);
    let back = poisson_map(&Reversed(&step), &moved)?;
    assert!((back - start.momentum).amax() < 1e-14);
    let matrix_free = poisson_map(&MatrixFree(step), &start.momentum)?;
    assert!((matrix_free - moved).amax() < 1e-14);
    Ok(())
}
