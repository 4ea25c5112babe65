//! The motion of a comoving frame: the one place where it moves.

use super::moves::Moves;
use crate::generating::{GeneratingFunction, ScalarOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Moves a comoving frame on by so many steps; whether there is one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn move_frame<S, M>(generating: &S, state: &mut M, steps: u64) -> bool
where
    S: GeneratingFunction + ?Sized,
    M: Moves<S::Group>,
{
    let group = generating.group();
    let times = ScalarOf::<S>::of(steps as f64);
    let mut motion = 0;
    while let Some(mut y) = generating.frame(motion, state.momentum()) {
        for i in 0..y.dim() {
            y[i] *= times;
        }
        let (increment, moved) = group.exp_transport(&y, state.momentum());
        state.move_by(group, &increment, moved);
        motion += 1;
    }
    motion > 0
}
