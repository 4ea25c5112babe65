//! Many steps in a row, in blocks that do not depend on one another's past.

use nalgebra::SimdPartialOrd;

use super::frame::move_frame;
use super::phase::Phase;
use super::{StepReport, advance_with, check, displace};
use crate::error::{StepError, Stopped};
use crate::generating::ScalarOf;
use crate::number::scalar::Scalar;
use crate::solve::{Candidate, CandidateOf, Integrator, Method, Settings, is_right, rescue};

/// Steps in a block. A comoving frame moves on once in each: few enough steps for its integrals, which drift by
/// rounding, to be the same in all of them. Methods forget what was before it, so that a run may be resumed at the end
/// of any block.
pub(crate) const STEPS_PER_BLOCK: u64 = 256;

/// The steps of [`advance_by`](super::advance_by).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn march<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    let mut method = S::Method::begin(generating);
    let mut done = 0;
    while done < steps {
        let length = STEPS_PER_BLOCK.min(steps - done);
        let report = block(generating, &mut method, phase, length, settings)
            .map_err(|stopped| Stopped { steps: done + stopped.steps, ..stopped })?;
        worst.iterations = worst.iterations.max(report.iterations);
        worst.residual = worst.residual.simd_max(report.residual);
        done += length;
    }
    Ok(worst)
}

/// So many steps, at most [`STEPS_PER_BLOCK`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn block<S: Integrator + ?Sized>(
    generating: &S,
    method: &mut S::Method,
    phase: &mut Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    // Of its own, so that it can stay in registers from step to step.
    let mut now = phase.clone();
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    for done in 0..steps {
        let candidate = method.propose(generating, &now.momentum, steps - done, settings);
        let report = if is_right(generating, &now.momentum, &candidate, settings) {
            displace(generating, &mut now, &candidate.x);
            StepReport { iterations: candidate.iterations, residual: candidate.residual }
        } else {
            let mut next = now.clone();
            match rescued(generating, &mut next, candidate, settings) {
                Ok(report) => {
                    now = next;
                    report
                }
                Err(error) => {
                    method.forget();
                    if done > 0 {
                        finish(generating, phase, now, done, settings)?;
                    }
                    return Err(Stopped { steps: done, error });
                }
            }
        };
        worst.iterations = worst.iterations.max(report.iterations);
        worst.residual = worst.residual.simd_max(report.residual);
    }
    method.forget();
    finish(generating, phase, now, steps, settings).map(|()| worst)
}

/// A step whose candidate is not right, to its end.
#[cold]
#[inline(never)]
fn rescued<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let Candidate { x, iterations, residual, .. } =
        rescue(generating, &phase.momentum, candidate, settings)?;
    displace(generating, phase, &x);
    Ok(StepReport { iterations, residual })
}

/// Moves the frame of the state that so many steps have led to from `phase`, and checks it; where it is not sound, finds
/// the step that was not.
#[cfg_attr(not(debug_assertions), inline(always))]
fn finish<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    mut now: Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<(), Stopped> {
    move_frame(generating, &mut now, steps);
    match check(generating.group(), &now) {
        Ok(()) => {
            *phase = now;
            Ok(())
        }
        Err(_) => one_by_one(generating, phase, steps, settings),
    }
}

/// The same steps, each checked.
#[cold]
#[inline(never)]
fn one_by_one<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<(), Stopped> {
    for done in 0..steps {
        let stopped = |error: StepError| Stopped { steps: done, error };
        advance_with(generating, phase, settings).map_err(stopped)?;
    }
    Ok(())
}
