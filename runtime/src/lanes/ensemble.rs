//! Many trajectories at once: lanes of one core times threads.

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::Lanes;
use super::registers::Of;
use crate::error::StepError;
use crate::group::phase::Phase;
use crate::number::{Registers, Scalar};
use crate::step::{NumberOf, Steps, advance_from};

/// Trajectories handed to a thread at a time.
const BLOCK: usize = 128;

/// A trajectory that stopped early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// Its index in the ensemble.
    pub index: usize,
    /// The step, counted from 0, that could not be made. The state is the one before it.
    pub step: u64,
    /// The reason.
    pub error: StepError,
}

/// Advances every state by `steps` steps, in place: in the lanes of the widest registers that the processor has, spread
/// over rayon's threads.
///
/// The result does not depend on the number of threads, on the grouping into lanes, or on the
/// processor's vector width: each trajectory gets the bits that [`advance_by`](crate::steps::advance_by)
/// gives. Each lane has a verdict of its own: a trajectory that is refused keeps its last good state and is
/// reported (sorted by index); the others go on, with the same bits.
pub fn advance_all<S>(step: &S, states: &mut [Phase<S::Group>], steps: u64) -> Vec<Failure>
where
    S: Lanes + Steps + Sync,
    Phase<S::Group>: Send,
{
    let blocks = states.par_chunks_mut(BLOCK).enumerate();
    let failures = blocks.map(|(block, states)| {
        let run = Dispatched { step, states, first: block * BLOCK, steps };
        Arch::new().dispatch(run)
    });
    failures.collect::<Vec<_>>().concat()
}

/// Steps of some trajectories, as something pulp can compile for several instruction sets.
struct Dispatched<'a, S: Steps> {
    step: &'a S,
    states: &'a mut [Phase<S::Group>],
    /// The index of the first in the ensemble.
    first: usize,
    steps: u64,
}

impl<S: Lanes + Steps> WithSimd for Dispatched<'_, S> {
    type Output = Vec<Failure>;

    #[inline(always)]
    fn with_simd<I: Simd>(self, instructions: I) -> Self::Output {
        let Self { step, states, first, steps } = self;
        let (registers, zero) = (Of(instructions), NumberOf::<S>::of(0.0));
        let mut failures = Vec::new();
        for (pack, states) in states.chunks_mut(Of::<I>::LANES).enumerate() {
            let first = first + pack * Of::<I>::LANES;
            let mut going: Vec<_> = (first..).zip(states).collect();
            let mut done = 0;
            while done < steps && !going.is_empty() {
                let length = S::TOGETHER.min(steps - done);
                // Together where all steps are right, else one by one.
                if !step.drive_lanes(registers, &mut going, length) {
                    going.retain_mut(|(index, state)| {
                        let moved = advance_from(step, state, zero, length).map_err(|why| {
                            let step = done + why.steps;
                            failures.push(Failure { index: *index, step, error: why.error });
                        });
                        moved.is_ok()
                    });
                }
                done += length;
            }
        }
        failures.sort_by_key(|failure| failure.index);
        failures
    }
}
