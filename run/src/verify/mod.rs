//! Judges trajectories and ensembles afterwards, step by step in doubled precision.
// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod course;
mod follow;
mod found;
mod states;

pub use follow::{Follower, Sample, judge_of};
pub use found::Found;
