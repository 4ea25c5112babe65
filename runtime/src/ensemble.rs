//! Many trajectories at once: lanes of one core times threads.

use nalgebra::SimdValue;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::error::StepError;
use crate::generating_function::GeneratingFunction;
use crate::lanes::{F64x8, LaneGroup, Lanes};
use crate::phase::Phase;
use crate::reconstruct::{Stopped, march};

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
/// processor's vector width: each trajectory gets the bits that [`advance_by`](crate::advance_by)
/// gives, but where that solves several steps at once ([`GeneratingFunction::LINEARISES`]), which
/// rounds otherwise. A trajectory that fails keeps its last good state and is reported (sorted by
/// index); the others go on.
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

/// Up to eight states: in lanes if all goes well, one by one if some lane fails.
fn advance_pack<S: Lanes>(
    step: &S,
    packed: &S::Over<F64x8>,
    states: &mut [Phase<S::Group>],
    first: usize,
    steps: u64,
    failures: &mut Vec<Failure>,
) {
    let Some(lead) = states.first() else { return };
    // A partial pack repeats its first state in the lanes left over.
    let mut lanes = Aligned(<S::Group as LaneGroup>::splat::<F64x8>(lead));
    for (lane, state) in states.iter().enumerate() {
        <S::Group as LaneGroup>::insert(&mut lanes.0, lane, state);
    }
    if Arch::new().dispatch(Run { step: packed, phase: &mut lanes.0, steps }).is_ok() {
        for (lane, state) in states.iter_mut().enumerate() {
            *state = <S::Group as LaneGroup>::extract(&lanes.0, lane);
        }
        return;
    }
    for (lane, state) in states.iter_mut().enumerate() {
        if let Err(Stopped { done, error }) = march(step, state, steps, false) {
            failures.push(Failure { index: first + lane, step: done, error });
        }
    }
}

/// `steps` steps, as something pulp can compile for several instruction sets.
struct Run<'a, S: GeneratingFunction> {
    step: &'a S,
    phase: &'a mut Phase<S::Group>,
    steps: u64,
}

impl<S: GeneratingFunction> WithSimd for Run<'_, S> {
    type Output = Result<(), StepError>;

    #[inline(always)]
    fn with_simd<I: Simd>(self, _simd: I) -> Self::Output {
        march(self.step, self.phase, self.steps, false).map(drop).map_err(|stopped| stopped.error)
    }
}
