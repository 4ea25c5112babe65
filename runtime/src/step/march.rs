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
#[inline(always)]
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
#[inline(always)]
pub(crate) fn block<S: Integrator + ?Sized>(
    generating: &S,
    method: &mut S::Method,
    phase: &mut Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    let start = phase.clone();
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    for done in 0..steps {
        let candidate = method.propose(generating, &phase.momentum, steps - done, settings);
        let Candidate { iterations, residual, .. } = candidate;
        let (iterations, residual) = if is_right(generating, &phase.momentum, &candidate, settings)
        {
            displace(generating, phase, &candidate.x);
            (iterations, residual)
        } else {
            match rescued(generating, phase, candidate, settings) {
                Ok(report) => report,
                Err(error) => {
                    method.forget();
                    if done > 0 {
                        move_frame(generating, phase, done);
                        sound(generating, phase, start, done, settings)?;
                    }
                    return Err(Stopped { steps: done, error });
                }
            }
        };
        worst.iterations = worst.iterations.max(iterations);
        worst.residual = worst.residual.simd_max(residual);
    }
    move_frame(generating, phase, steps);
    method.forget();
    sound(generating, phase, start, steps, settings).map(|()| worst)
}

/// A step whose candidate is not right, to its end: iterations and residual.
#[cold]
#[inline(never)]
fn rescued<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<(u32, ScalarOf<S>), StepError> {
    let Candidate { x, iterations, residual, .. } =
        rescue(generating, &phase.momentum, candidate, settings)?;
    displace(generating, phase, &x);
    Ok((iterations, residual))
}

/// Checks the state that so many steps have led to from `start`; where it is not sound, finds the step that was not.
#[inline(always)]
fn sound<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    start: Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<(), Stopped> {
    match check(generating.group(), phase) {
        Ok(()) => Ok(()),
        Err(_) => {
            *phase = start;
            one_by_one(generating, phase, steps, settings)
        }
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
