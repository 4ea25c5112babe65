//! The evaluation of a program, compiled for this processor.
//!
//! A fused product is one instruction on every processor of the last ten years, but on x86-64 a program compiled for
//! all of them has to call a function for it. Here the evaluation is compiled once more with the instructions of AVX2
//! and FMA, and taken where the processor has them; the bits are the same.

use alloc::vec::Vec;

use crate::number::Number;
use crate::program::Program;

/// [`Program::evaluate`] on inputs and coefficients in lists, by the best code there is for this processor.
pub(crate) fn evaluate<T: Number>(
    program: &Program,
    inputs: &[T],
    slots: &[T],
    nodes: &mut Vec<T>,
) {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has both features, as was just asked.
        #[allow(unsafe_code)]
        return unsafe { evaluate_fma(program, inputs, slots, nodes) };
    }
    program.evaluate(|i| inputs[i], |i| slots[i], nodes);
}

/// The same with fused products as instructions. Calling it needs a processor that has AVX2 and FMA.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
fn evaluate_fma<T: Number>(program: &Program, inputs: &[T], slots: &[T], nodes: &mut Vec<T>) {
    program.evaluate(|i| inputs[i], |i| slots[i], nodes);
}
