//! Runs of which the generic solver makes many steps, and the step with which it makes none.

use coadjoint::StepError;

use super::recorder::Outcome;
use super::tally::Warning;
use crate::engine::{Motion, Numbers};

/// The share of steps, and their number, from which on a run says that they were slow: such a step takes hundreds of times as
/// long, so that this share makes a run several times as long.
const SHARE: f64 = 0.01;
const FEWEST: u64 = 10;

/// Each step that is tried is this part of the one before it.
const SHRINKS: f64 = 0.9;
/// The steps that are tried, down to an eighth.
const TRIALS: i32 = 20;
/// A step is tried over the run, up to this number of steps.
const TRIED: u64 = 20_000;

/// The warning about this number of steps, if many were slow; `shorter` finds a step that avoids it.
pub(crate) fn many(
    rescued: u64,
    steps: u64,
    shorter: impl FnOnce() -> Option<f64>,
) -> Option<Warning> {
    let many = rescued >= FEWEST && rescued as f64 >= SHARE * steps as f64;
    many.then(|| Warning::Slow { rescued, steps, step: shorter() })
}

/// The warning about a run of steps of this size from `start`, if many were slow; `other` makes steps of another size. The step
/// that it advises is found by trying, and so does not depend on the speed of the machine.
pub(super) fn slow<'a>(
    outcome: &Outcome,
    size: f64,
    start: &Numbers,
    other: impl Fn(f64) -> Result<Motion<'a>, StepError>,
) -> Option<Warning> {
    let (steps, rescued) = (outcome.steps, outcome.solver?.rescued);
    let serves = |step: &f64| {
        let Ok(motion) = other(*step) else { return false };
        let count = ((steps as f64 * size / step).ceil() as u64).min(TRIED);
        let (mut state, mut made, mut block) = (start.clone(), 0, 1);
        while made < count {
            let next = block.min(count - made);
            match motion.advance(&mut state, made, next) {
                Ok(Some(solved)) if solved.rescued == 0 => made += next,
                _ => return false,
            }
            block = (2 * block).min(64);
        }
        true
    };
    // Three digits say enough.
    let shorter = |trial| format!("{:.2e}", size * SHRINKS.powi(trial)).parse().ok();
    many(rescued, steps, || (1..=TRIALS).filter_map(shorter).find(serves))
}
