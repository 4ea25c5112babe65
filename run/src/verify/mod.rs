//! Judges trajectories and ensembles afterwards, step by step in doubled precision.
// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod course;
mod follow;
mod found;
mod said;
mod states;

use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::system::System;

pub use follow::{Follower, Quota, judge_of};
pub use found::Found;

/// The reason for which runs with kicks are not judged.
pub const KICKED: &str =
    "a system with a potential is not judged: between its kicks the motion is free";

/// The reason for which runs of a system are not judged; `None` if they are.
pub fn unjudged(system: &System<Hamiltonian>) -> Option<&'static str> {
    let driven = "a system with a velocity, a torque or damping is not judged";
    let acts = || system.drive().is_some().then_some(driven);
    let breaks = || system.problem.smooth().is_some_and(|smooth| !smooth.breaks().is_empty());
    let divided = || breaks().then_some("a system whose steps end at breaks is not judged");
    system.potential.as_ref().map(|_| KICKED).or_else(acts).or_else(divided)
}
