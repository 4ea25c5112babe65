//! Several trajectories side by side, in the lanes of SIMD numbers.

#[cfg(feature = "ensemble")]
pub mod ensemble;
#[cfg(feature = "ensemble")]
mod registers;

pub use simba::simd::{AutoF64x4 as F64x4, AutoF64x8 as F64x8};

use crate::group::phase::Phase;
use crate::number::Registers;
use crate::step::Steps;
use crate::step::printed::BLOCK;

/// An integrator whose steps ensembles make in lanes: what the attribute generates.
///
/// A lane computes the same bits as the integrator alone.
pub trait Lanes {
    /// The most steps that lanes make together: where steps go by those before them, any number.
    #[doc(hidden)]
    const TOGETHER: u64 = BLOCK;

    /// Makes steps of several trajectories by straight-line programs, where the integrator has such programs and all steps
    /// are right; whether it did. Trajectories are given with their indices.
    #[doc(hidden)]
    #[inline(always)]
    fn drive_lanes<R: Registers>(
        &self,
        registers: R,
        phases: &mut [(usize, &mut Phase<<Self as Steps>::Group>)],
        steps: u64,
    ) -> bool
    where
        Self: Steps,
    {
        let _ = (registers, phases, steps);
        false
    }
}
