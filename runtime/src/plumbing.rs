//! What generated code calls. Not part of the public interface; it may change at any time.

use crate::error::StepError;
use crate::scalar::Scalar;

/// All coefficients of a generated step as data: sums of factor · h^power · Π symbolᵢ^powerᵢ.
#[derive(Debug)]
pub struct Table<const SYMBOLS: usize> {
    /// Summands: factor, power of h, power of each symbol.
    pub terms: &'static [(f64, u8, [u8; SYMBOLS])],
    /// Where the summands of base number i end.
    pub ends: &'static [u32],
    /// Slots: a base and the integer that multiplies it.
    pub slots: &'static [(u32, u32)],
    /// The first so many bases belong to the series S₁ + … + S_K, S_k having the power k of h.
    pub series: usize,
}

/// Folds `table` for one step size and parameter set: `BASES` sums, then `SLOTS` multiples. S_k is
/// multiplied by `factor(k)`.
///
/// # Errors
/// [`StepError::InvalidStep`], [`StepError::InvalidParameter`].
pub fn fold<T: Scalar, const SYMBOLS: usize, const BASES: usize, const SLOTS: usize>(
    table: &Table<SYMBOLS>,
    names: &[&'static str; SYMBOLS],
    step: T,
    symbols: &[T; SYMBOLS],
    factor: &dyn Fn(usize) -> T,
) -> Result<[T; SLOTS], StepError> {
    use nalgebra::SimdBool;

    if !step.all_finite() || step.simd_eq(T::of(0.0)).any() {
        return Err(StepError::InvalidStep { step: step.largest_lane() });
    }
    for (symbol, name) in symbols.iter().zip(names) {
        if !symbol.all_finite() {
            return Err(StepError::InvalidParameter { name, value: symbol.largest_lane() });
        }
    }
    let mut bases = [T::of(0.0); BASES];
    let mut start = 0;
    for (number, (base, &end)) in bases.iter_mut().zip(table.ends).enumerate() {
        for (number_in_front, power, powers) in table.terms.get(start..end as usize).unwrap_or(&[])
        {
            let mut product = T::of(*number_in_front);
            for _ in 0..*power {
                product *= step;
            }
            for (&symbol, &power) in symbols.iter().zip(powers) {
                for _ in 0..power {
                    product *= symbol;
                }
            }
            if number < table.series {
                product *= factor(usize::from(*power));
            }
            *base += product;
        }
        if !base.all_finite() {
            let name = "of the generating function";
            return Err(StepError::InvalidParameter { name, value: base.largest_lane() });
        }
        start = end as usize;
    }
    let mut slots = [T::of(0.0); SLOTS];
    for (slot, &(base, scale)) in slots.iter_mut().zip(table.slots) {
        *slot = bases.get(base as usize).copied().unwrap_or(T::of(0.0)) * T::of(f64::from(scale));
    }
    Ok(slots)
}

/// Σ weight·|slot|, sorted by degree: the coefficients of a bound as a polynomial in the size of
/// the momentum. Entries are (slot, weight, degree).
pub fn bound<T: Scalar, const DEGREES: usize>(
    slots: &[T],
    terms: &[(u32, f64, u32)],
) -> [T; DEGREES] {
    let mut bound = [T::of(0.0); DEGREES];
    for &(slot, weight, degree) in terms {
        let value = slots.get(slot as usize).copied().unwrap_or(T::of(0.0));
        if let Some(sum) = bound.get_mut(degree as usize) {
            *sum += value.simd_abs() * T::of(weight);
        }
    }
    bound
}

/// Σ coefficients\[k\] sizeᵏ.
#[inline(always)]
pub fn polynomial<T: Scalar, const DEGREES: usize>(coefficients: &[T; DEGREES], size: T) -> T {
    let mut sum = T::of(0.0);
    for &coefficient in coefficients.iter().rev() {
        sum = sum.times_plus(size, coefficient);
    }
    sum
}
