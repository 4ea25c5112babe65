//! The interpreter's loop, compiled for this processor.
//!
//! A fused product is one instruction on every processor of the last ten years, but on x86-64 a program compiled for
//! all of them has to call a function for it. Here the same loop is compiled once more with the instructions of
//! AVX2 and FMA, and taken where the processor has them; the bits are the same.

use crate::drive::Memory;
use crate::kernel::Kernel;
use crate::packed::Packed;
use crate::stepper::Outcome;

/// [`drive::block`](crate::drive::block), by the best code there is for this processor.
pub(crate) fn block<T: Packed<L>, const L: usize>(
    kernel: &Kernel,
    memory: &mut Memory<T>,
    length: u64,
    live: [bool; L],
    outcome: &mut Outcome,
) -> [u64; L] {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has both features, as was just asked.
        #[allow(unsafe_code)]
        return unsafe { block_fma(kernel, memory, length, live, outcome) };
    }
    crate::drive::block(kernel, memory, length, live, outcome)
}

/// The same with fused products as instructions. Calling it needs a processor that has AVX2 and FMA.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn block_fma<T: Packed<L>, const L: usize>(
    kernel: &Kernel,
    memory: &mut Memory<T>,
    length: u64,
    live: [bool; L],
    outcome: &mut Outcome,
) -> [u64; L] {
    crate::drive::block(kernel, memory, length, live, outcome)
}
