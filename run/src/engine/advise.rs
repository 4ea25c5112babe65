//! A step size that works where one was refused.

use coadjoint::StepError;

/// Halves of a refused step that are tried.
const MOST_HALVINGS: u32 = 24;

/// The error with the longest of h/2, h/4, … with which `works` says that the step can be made; as it is where there is
/// none, and where the length of the step is not to blame.
#[cold]
pub fn advise(error: StepError, h: f64, mut works: impl FnMut(f64) -> bool) -> StepError {
    if !error.asks_for_smaller_step() {
        return error;
    }
    let mut shorter = h;
    for _ in 0..MOST_HALVINGS {
        shorter *= 0.5;
        if works(shorter) {
            return error.with_usable_step(shorter);
        }
    }
    error
}
