//! The evaluation of a program, compiled for this processor.
//!
//! A fused product is one instruction on every processor of the last ten years, but on x86-64 a program compiled for
//! all of them has to call a function for it. Here the evaluation is compiled once more with the instructions of AVX2
//! and FMA, and taken where the processor has them; the bits are the same.

use alloc::vec::Vec;

use crate::fold::{Fold, FoldError, Values};
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

/// [`Fold::fold_by`], and [`Fold::radius_by`] for a ratio, by the best code there is for this processor.
pub(crate) fn fold<T: Values>(
    fold: &Fold<'_>,
    step: f64,
    (symbols, products): (&[T], &[T]),
    ratio: f64,
    coefficients: &mut [T],
) -> Result<T, FoldError> {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has the feature, as was just asked.
        #[allow(unsafe_code)]
        return unsafe { fold_avx2(fold, step, (symbols, products), ratio, coefficients) };
    }
    folded(fold, step, (symbols, products), ratio, coefficients)
}

/// The same with wide registers. Calling it needs a processor that has AVX2.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2")]
fn fold_avx2<T: Values>(
    fold: &Fold<'_>,
    step: f64,
    known: (&[T], &[T]),
    ratio: f64,
    coefficients: &mut [T],
) -> Result<T, FoldError> {
    folded(fold, step, known, ratio, coefficients)
}

#[inline(always)]
fn folded<T: Values>(
    fold: &Fold<'_>,
    step: f64,
    (symbols, products): (&[T], &[T]),
    ratio: f64,
    coefficients: &mut [T],
) -> Result<T, FoldError> {
    let nothing = T::each(|_| f64::NAN);
    let product = |number: u32| products.get(number as usize).copied().unwrap_or(nothing);
    fold.fold_by(step, symbols, product, coefficients)?;
    Ok(fold.radius_by(step, product, ratio))
}
