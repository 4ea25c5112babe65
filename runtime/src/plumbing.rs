//! The functions that generated code calls. Not part of the public interface; they may change at any time.

use crate::error::StepError;
use crate::generating::ScalarOf;
use crate::group::phase::Phase;
use crate::number::scalar::Scalar;
use crate::solve::Integrator;

pub use crate::number::lift::Lift;
pub use crate::solve::{Driven, DrivenOf, estimated_ratio};
pub use crate::step::drive::{Number, Programs, drive};
pub use crate::step::numbers::ElementNumbers;

/// A monomial, as pairs of a coordinate and its exponent.
pub type Monomial = &'static [(u32, u32)];

/// All coefficients of a generated step as data. A *base* is a sum of *parts*, a part a power of h
/// times a sum of *terms* factor · Π symbolᵢ^powerᵢ, and a *slot* a base times an integer.
#[derive(Debug)]
pub struct Table {
    /// The products Π symbolᵢ^powerᵢ, each an earlier one times a symbol; before the first stands 1.
    pub products: &'static [(u32, u32)],
    /// Factor and product, which is counted from one; zero is 1.
    pub terms: &'static [(f64, u32)],
    /// For each part the power of h, and where its terms end.
    pub parts: &'static [(u8, u32)],
    /// Where the parts of base number i end.
    pub bases: &'static [u32],
    /// For each slot the base, and the integer that multiplies it.
    pub slots: &'static [(u32, u32)],
    /// The monomials of the series S₁ + … + S_K, S_k having the power k of h; its bases are the first.
    pub monomials: &'static [Monomial],
    /// The direct factor of the group that each coordinate belongs to, ascending from 0.
    pub factors: &'static [u32],
}

/// The parts for one step size and parameter set. No power of h reaches `POWERS`, no
/// number of a product `PRODUCTS`.
///
/// # Errors
/// [`StepError::InvalidStep`], [`StepError::InvalidParameter`].
pub fn parts<T: Scalar, const POWERS: usize, const PRODUCTS: usize, const PARTS: usize>(
    table: &Table,
    names: &[&'static str],
    step: T,
    symbols: &[T],
) -> Result<[T; PARTS], StepError> {
    use nalgebra::SimdBool;

    if !step.all_finite() || step.simd_eq(T::of(0.0)).any() {
        return Err(StepError::InvalidStep { step: step.largest_lane() });
    }
    for (symbol, name) in symbols.iter().zip(names) {
        if !symbol.all_finite() {
            return Err(StepError::InvalidParameter { name, value: symbol.largest_lane() });
        }
    }
    let step = powers::<T, POWERS>(step);
    let mut products = [T::of(1.0); PRODUCTS];
    for (n, &(of, symbol)) in table.products.iter().enumerate() {
        // Tells the compiler that no index reaches its array's end.
        let product = products[(of as usize).min(PRODUCTS - 1)] * symbols[symbol as usize];
        products[(n + 1).min(PRODUCTS - 1)] = product;
    }
    let mut parts = [T::of(0.0); PARTS];
    let mut start = 0;
    for (part, &(step_power, end)) in parts.iter_mut().zip(table.parts) {
        for &(factor, product) in table.terms.get(start..end as usize).unwrap_or(&[]) {
            *part += T::of(factor) * products[(product as usize).min(PRODUCTS - 1)];
        }
        *part *= step[usize::from(step_power).min(POWERS - 1)];
        if !part.all_finite() {
            let name = "of the generating function";
            return Err(StepError::InvalidParameter { name, value: part.largest_lane() });
        }
        start = end as usize;
    }
    Ok(parts)
}

/// 1, x, x², …
fn powers<T: Scalar, const POWERS: usize>(x: T) -> [T; POWERS] {
    let mut next = T::of(1.0);
    core::array::from_fn(|_| {
        let power = next;
        next *= x;
        power
    })
}

/// The slots, of which there may be fewer than places in `slots`.
pub fn slots<T: Scalar, const PARTS: usize, const BASES: usize>(
    table: &Table,
    parts: &[T; PARTS],
    slots: &mut [T],
) {
    let mut bases = [T::of(0.0); BASES];
    let mut start = 0;
    for (base, &end) in bases.iter_mut().zip(table.bases) {
        for &part in parts.get(start..end as usize).unwrap_or(&[]) {
            *base += part;
        }
        start = end as usize;
    }
    for (slot, &(base, scale)) in slots.iter_mut().zip(table.slots) {
        // Tells the compiler that no index reaches its array's end.
        *slot = bases[(base as usize).min(BASES.saturating_sub(1))] * T::of(f64::from(scale));
    }
}

/// Adds weight·|slot| to the place of its degree from `start`: the coefficients of a bound as a polynomial in the size of
/// the momentum. Entries are (slot, weight, degree).
pub fn bound<T: Scalar>(slots: &mut [T], start: usize, terms: &[(u32, f64, u32)]) {
    for &(slot, weight, degree) in terms {
        let value = slots.get(slot as usize).copied().unwrap_or(T::of(0.0));
        if let Some(sum) = slots.get_mut(start + degree as usize) {
            *sum += value.simd_abs() * T::of(weight);
        }
    }
}

/// The coefficients of S_K and S_{K−2}, one for each of their terms.
pub fn last_terms<T: Scalar, const PARTS: usize, const LAST: usize>(
    table: &Table,
    parts: &[T; PARTS],
    truncation: usize,
) -> [T; LAST] {
    let mut last = [T::of(0.0); LAST];
    let mut next = last.iter_mut();
    for (number, order) in last_orders(table, truncation) {
        if let (Some(place), Some(&part)) = (next.next(), parts.get(number)) {
            debug_assert!(order <= truncation);
            *place = part;
        }
    }
    last
}

/// The numbers of the parts of S_K and S_{K−2}, and the order of each.
#[inline(always)]
fn last_orders(table: &Table, truncation: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    let end = table.monomials.len().checked_sub(1).and_then(|last| table.bases.get(last));
    let parts = table.parts.get(..end.map_or(0, |&end| end as usize)).unwrap_or(&[]);
    let orders = parts.iter().map(|&(power, _)| usize::from(power)).enumerate();
    orders.filter(move |&(_, order)| truncation > 1 && order + 2 >= truncation)
}

/// The terms whose coefficients are `last`, as (coefficient, order, monomial).
#[inline(always)]
fn of_last<'a, T: Scalar>(
    table: &'a Table,
    last: &'a [T],
    truncation: usize,
) -> impl Iterator<Item = (T, usize, Monomial)> + Clone + 'a {
    let numbers = last_orders(table, truncation).zip(last);
    let mut base = 0;
    numbers.filter_map(move |((number, order), &value)| {
        while table.bases.get(base).is_some_and(|&end| end as usize <= number) {
            base += 1;
        }
        table.monomials.get(base).map(|&monomial| (value, order, monomial))
    })
}

/// [`GeneratingFunction::radius`](crate::GeneratingFunction::radius) of a table's series.
pub fn radius<T: Scalar>(table: &Table, last: &[T], truncation: usize) -> T {
    crate::generating::series::radius(truncation, table.factors, of_last(table, last, truncation))
}

/// [`GeneratingFunction::series_ratio`](crate::GeneratingFunction::series_ratio) of a table's series.
// Inlined: an iterator in memory would hold on to the coefficients for all that the compiler knows, and then steps in a
// loop read them anew each time.
#[inline(always)]
pub fn series_ratio<T: Scalar, const N: usize>(
    table: &Table,
    last: &[T],
    truncation: usize,
    p: &[T; N],
) -> T {
    let (terms, mut sums) = (of_last(table, last, truncation), [[T::of(0.0); 2]; N]);
    crate::generating::series::ratio(truncation, table.factors, terms, &mut sums, |i| {
        p.get(i).copied().unwrap_or(T::of(0.0))
    })
}

pub use crate::generating::series::{radius as radius_of, ratio as ratio_of};

/// The error of a step, with a step size that works where there is one among halves, quarters, … of `step`.
#[cold]
#[inline(never)]
pub fn advise<S: Integrator>(
    error: StepError,
    phase: &Phase<S::Group>,
    step: ScalarOf<S>,
    shorter: impl Fn(ScalarOf<S>) -> Result<S, StepError>,
) -> StepError {
    if !error.asks_for_smaller_step() {
        return error;
    }
    let mut smaller = step;
    for _ in 0..MOST_HALVINGS {
        smaller *= Scalar::of(0.5);
        let works = |step: S| crate::advance(&step, &mut phase.clone()).is_ok();
        if shorter(smaller).is_ok_and(works) {
            return error.with_usable_step(smaller.largest_lane());
        }
    }
    error
}

/// Shorter steps that are tried to advise one.
const MOST_HALVINGS: u32 = 24;

/// `c` in the lanes where a ≤ b, else `d`.
#[inline(always)]
#[must_use]
pub fn select<T: Scalar>(a: T, b: T, c: T, d: T) -> T {
    c.select(a.simd_le(b), d)
}
