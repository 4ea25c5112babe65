//! Many trajectories at once: lanes of one core times threads.

use nalgebra::SimdValue;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::{F64x8, LaneGroup, Lanes};
use crate::error::StepError;
use crate::generating::GeneratingFunction;
use crate::group::phase::Phase;
use crate::solve::Integrator;
use crate::step::advance_by;
use crate::step::drive::BLOCK as STEPS_PER_BLOCK;

/// Lanes per pack.
const WIDTH: usize = <F64x8 as SimdValue>::LANES;

/// Something made of packs, each within one line of the cache: otherwise every coefficient of a step
/// is read from two.
#[repr(align(64))]
struct Aligned<T>(T);

/// Trajectories handed to a thread at a time.
const BLOCK: usize = 16 * WIDTH;

/// A trajectory that stopped early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// Its index in the ensemble.
    pub index: usize,
    /// The step, counted from 0, that could not be made. The state is the one before it.
    pub step: u64,
    /// Why.
    pub error: StepError,
}

/// Advances every state by `steps` steps, in place: packs of eight lanes, compiled for what the
/// processor has, spread over rayon's threads.
///
/// The result does not depend on the number of threads, on the grouping into packs, or on the
/// processor's vector width: each trajectory gets the bits that [`advance_by`](crate::steps::advance_by)
/// gives. Each lane has a verdict of its own: a trajectory that is refused keeps its last good state and is
/// reported (sorted by index); the others go on, with the same bits.
pub fn advance_all<S>(step: &S, states: &mut [Phase<S::Group>], steps: u64) -> Vec<Failure>
where
    S: Lanes + Sync,
    S::Over<F64x8>: Sync,
    Phase<S::Group>: Send,
{
    let packed = Aligned(step.splat::<F64x8>());
    let blocks = states.par_chunks_mut(BLOCK).enumerate();
    let failures = blocks.map(|(block, states)| {
        let mut failures = Vec::new();
        for (pack, states) in states.chunks_mut(WIDTH).enumerate() {
            let first = block * BLOCK + pack * WIDTH;
            advance_pack(step, &packed.0, states, first, steps, &mut failures);
        }
        failures
    });
    failures.collect::<Vec<_>>().concat()
}

/// Up to eight states, block of steps by block: in lanes where all goes well, one by one where a lane is refused.
fn advance_pack<S: Lanes>(
    step: &S,
    packed: &S::Over<F64x8>,
    states: &mut [Phase<S::Group>],
    first: usize,
    steps: u64,
    failures: &mut Vec<Failure>,
) {
    let mut stopped = [false; WIDTH];
    let mut done = 0;
    while done < steps {
        let length = STEPS_PER_BLOCK.min(steps - done);
        let Some(mut lanes) = pack::<S>(states, &stopped) else { return };
        let run = Run { step: packed, phase: &mut lanes.0, steps: length };
        let together = Arch::new().dispatch(run);
        for (lane, state) in states.iter_mut().enumerate() {
            if stopped[lane] {
                continue;
            }
            if together {
                *state = <S::Group as LaneGroup>::extract(&lanes.0, lane);
                continue;
            }
            if let Err(why) = advance_by(step, state, length) {
                stopped[lane] = true;
                let step = done + why.steps;
                failures.push(Failure { index: first + lane, step, error: why.error });
            }
        }
        done += length;
    }
}

/// A phase point in every lane.
type LanePhase<S> = Phase<<<S as GeneratingFunction>::Group as LaneGroup>::Over<F64x8>>;

/// The states in lanes, the first of those that go on in lanes left over; none if no state goes on.
fn pack<S: Lanes>(
    states: &[Phase<S::Group>],
    stopped: &[bool; WIDTH],
) -> Option<Aligned<LanePhase<S>>> {
    let going = || states.iter().enumerate().filter(|(lane, _)| !stopped[*lane]);
    let (_, lead) = going().next()?;
    let mut lanes = Aligned(<S::Group as LaneGroup>::splat::<F64x8>(lead));
    for (lane, state) in going() {
        <S::Group as LaneGroup>::insert(&mut lanes.0, lane, state);
    }
    Some(lanes)
}

/// A block of steps, as something pulp can compile for several instruction sets.
struct Run<'a, S: Integrator> {
    step: &'a S,
    phase: &'a mut Phase<S::Group>,
    steps: u64,
}

impl<S: Integrator> WithSimd for Run<'_, S> {
    /// Whether all steps were made in all lanes.
    type Output = bool;

    #[inline(always)]
    fn with_simd<I: Simd>(self, _simd: I) -> Self::Output {
        self.step.drive(self.phase, self.steps).steps == self.steps
    }
}
