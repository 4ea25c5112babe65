//! Work in rayon's threads and in the widest vectors that the processor has, with feature `ensemble`.

use alloc::vec::Vec;

use super::lanes::LANES;

/// The fewest packs that are worth a thread of their own.
const FEWEST: usize = 64;

/// The places, whole packs of them, that each thread gets.
pub fn share(places: usize) -> usize {
    places.div_ceil(LANES).div_ceil(count()).max(FEWEST) * LANES
}

#[cfg(feature = "ensemble")]
fn count() -> usize {
    rayon::current_num_threads()
}

#[cfg(not(feature = "ensemble"))]
fn count() -> usize {
    1
}

/// Does work with each part; results are in the order of the parts.
pub fn each<T: Send, R: Send>(parts: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    // Closures that are not inlined would not be compiled for the processor.
    let work = |part| {
        wide(
            #[inline(always)]
            || work(part),
        )
    };
    #[cfg(feature = "ensemble")]
    if parts.len() > 1 {
        use rayon::prelude::*;
        return parts.into_par_iter().map(work).collect();
    }
    parts.into_iter().map(work).collect()
}

/// Does work compiled for the processor's own vectors. Results are the same for all.
#[cfg(feature = "ensemble")]
#[inline(always)]
pub fn wide<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}

/// Does work.
#[cfg(not(feature = "ensemble"))]
#[inline(always)]
pub fn wide<R>(work: impl FnOnce() -> R) -> R {
    work()
}
