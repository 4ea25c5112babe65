//! The functions that generated code calls. Not part of the public interface; they may change at any time.

use coadjoint_program::fold::FoldError;

use crate::collocation::Undefined;
use crate::error::StepError;
use crate::group::phase::Phase;
use crate::number::Scalar;
use crate::step::NumberOf;

pub use crate::collocation::collocated;
pub use crate::number::{Coefficients, Number, Registers};
pub use crate::solve::{Driven, DrivenIn, DrivenOf, estimated_ratio};
pub use crate::step::numbers::ElementNumbers;
pub use crate::step::printed::{
    BLOCK, called, choose, choose_all, is_one, load, load_lanes, store, store_lanes, timed,
};
pub use crate::step::rows::{Row, RowOf, exponent, row, scale, select};
pub use crate::step::{Steps, advance_at, advance_from};

/// All coefficients of a generated step or potential, in each lane for its step size and symbols, folded in this room of
/// [`Fold::room`] numbers.
///
/// # Errors
/// [`StepError::InvalidStep`], [`StepError::InvalidParameter`].
pub fn fold<T: Scalar, const SYMBOLS: usize, const ROOM: usize, const LEN: usize>(
    fold: &Fold<'_>,
    names: [&'static str; SYMBOLS],
    (step, symbols): (T, &[T; SYMBOLS]),
    mut room: [f64; ROOM],
) -> Result<[T; LEN], StepError> {
    const OF_SERIES: &str = "of the generating function";
    let mut coefficients = [T::of(0.0); LEN];
    for lane in 0..T::LANES {
        let number = |value: T| nalgebra::try_convert(value.extract(lane)).unwrap_or(f64::NAN);
        let (step, symbols) = (number(step), symbols.map(number));
        let mut row = [0.0; LEN];
        fold.fold(step, &symbols, &mut room, &mut row).map_err(|error| match error {
            FoldError::Step => StepError::InvalidStep { step },
            FoldError::Symbol(i) => {
                StepError::InvalidParameter { name: names[i], value: symbols[i] }
            }
            FoldError::Coefficient(value) => StepError::InvalidParameter { name: OF_SERIES, value },
        })?;
        for (coefficient, value) in coefficients.iter_mut().zip(row) {
            coefficient.replace(lane, nalgebra::convert(value));
        }
    }
    // Finite in 64 bits, but not in T; the square of the radius may be.
    let bounded = coefficients.iter().enumerate().filter(|&(i, _)| Some(i as u32) != fold.radius);
    match bounded.map(|(_, value)| value).find(|value| !value.all_finite()) {
        Some(value) => {
            Err(StepError::InvalidParameter { name: OF_SERIES, value: value.largest_lane() })
        }
        None => Ok(coefficients),
    }
}

/// The first expression of a Hamiltonian that is not defined, or has no derivative: `watched` are for each its argument
/// and a number that is then not finite.
#[cold]
pub fn undefined(expressions: &[&'static str], watched: &[f64]) -> Option<Undefined> {
    let (pairs, _) = watched.as_chunks::<2>();
    let mut pairs = pairs.iter().zip(expressions);
    let found = pairs.find(|([argument, test], _)| argument.is_finite() && !test.is_finite());
    found.map(|(&[argument, _], &expression)| Undefined { expression, argument })
}

/// 1, 0 or −1 in each lane.
pub fn sign<T: Scalar>(value: T) -> T {
    let zero = T::of(0.0);
    let one_or_minus = T::of(1.0).simd_copysign(value);
    zero.select(value.simd_eq(zero), one_or_minus)
}

/// The monomials of S_K and S_{K−2}, those of S_K marked, and the direct factor of the group that each coordinate belongs to.
#[derive(Debug)]
pub struct LastTerms {
    /// For each monomial true if it is one of S_K, and its pairs of a coordinate and an exponent.
    pub monomials: &'static [(bool, &'static [(u32, u32)])],
    /// For each coordinate its factor, ascending from 0.
    pub factors: &'static [u32],
}

/// [`GeneratingFunction::series_ratio`](crate::GeneratingFunction::series_ratio) of a series whose last terms have these
/// coefficients.
// Inlined: an iterator in memory would hold on to the coefficients for all that the compiler knows, and then steps in a
// loop read them anew each time.
#[inline(always)]
pub fn series_ratio<T: Scalar, const N: usize>(last: &LastTerms, values: &[T], p: &[T; N]) -> T {
    let terms = values.iter().zip(last.monomials);
    let terms = terms.map(|(&value, &(highest, monomial))| (value, highest, monomial));
    ratio_of(last.factors, terms, &mut [[T::of(0.0); 2]; N], |i| {
        p.get(i).copied().unwrap_or(T::of(0.0))
    })
}

pub use crate::generating::series::ratio as ratio_of;
pub use coadjoint_program::fold::Fold;

/// The error of a step, with a step size that works where there is one among halves, quarters, … of `step`.
#[cold]
#[inline(never)]
pub fn advise<S: Steps>(
    error: StepError,
    phase: &Phase<S::Group>,
    [time, step]: [NumberOf<S>; 2],
    shorter: impl Fn(NumberOf<S>) -> Result<S, StepError>,
) -> StepError {
    if !error.asks_for_smaller_step() {
        return error;
    }
    let mut smaller = step;
    for _ in 0..MOST_HALVINGS {
        smaller *= Scalar::of(0.5);
        let works = |step: S| advance_at(&step, &mut phase.clone(), time).is_ok();
        if shorter(smaller).is_ok_and(works) {
            return error.with_usable_step(smaller.largest_lane());
        }
    }
    error
}

/// Shorter steps that are tried to advise one.
const MOST_HALVINGS: u32 = 24;
