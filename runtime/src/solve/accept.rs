//! Accepting a step: the one place that says what is right.
//!
//! The mask of [`accept`] is what compiled steps test. Whatever it refuses goes, out of the way of what is fast, to
//! [`rescue`]: a solution that is merely not near its first guess is followed from the identity; one of a momentum beyond
//! the radius of the series, or a long way into the chart, is confirmed; all others get the reason of their refusal.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::candidate::{Candidate, CandidateOf, NEAR};
use super::confirm::confirm;
use super::continuation::follow;
use super::rate::estimated_ratio;
use super::{Integrator, Settings};
use crate::chart::Chart;
use crate::error::{Circumstances, StepError};
use crate::generating::series::LARGEST_RATIO;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Up to which share of a half turn steps are accepted at once where S is no series with a radius; else it is the group's
/// [`LieGroup::ESTIMATED`]. Estimates of what is left were found ten times too small beyond.
const OF_OTHERS: f64 = 1.0 / 3.0;

/// A verdict on a step of `S`.
type Verdict<S> = <ScalarOf<S> as SimdValue>::SimdBool;

/// In which lanes a candidate is solved, near its guess, a short way into the chart, and of a series that converges.
/// Comparisons with what is not a number do not hold.
fn accept<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: &CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Verdict<S> {
    let one = ScalarOf::<S>::of(1.0);
    let extent = S::Chart::default().extent(generating.group(), &candidate.x);
    let radius = generating.radius();
    let within = mu.pairing(mu).simd_le(radius * radius);
    let of = |share| ScalarOf::<S>::of(share);
    let is_series = radius.simd_lt(of(f64::MAX));
    let [inverse, other] = [<S::Group as LieGroup>::ESTIMATED, OF_OTHERS].map(|share| 1.0 / share);
    let share = of(inverse * inverse).select(is_series, of(other * other));
    let follows = estimated_ratio(generating, mu, &candidate.x).simd_le(of(LARGEST_RATIO));
    solved(candidate, settings) & (extent * share).simd_le(one) & within & follows
}

/// In which lanes a candidate is solved, and near its guess.
fn solved<V, T: Scalar>(candidate: &Candidate<V, T>, settings: Settings<T>) -> T::SimdBool {
    candidate.residual.simd_le(settings.tolerance()) & candidate.moved.simd_le(T::of(NEAR))
}

/// The candidate if it is right, or what `rescue` makes of it.
///
/// # Errors
/// Why there is no right step.
pub(crate) fn judge<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<CandidateOf<S>, StepError> {
    if accept(generating, mu, &candidate, settings).all() {
        return Ok(candidate);
    }
    rescue(generating, mu, candidate, settings)
}

/// The right step where there is one that [`accept`] could not tell; the reason where there is none. Over lanes only
/// the reason: lanes have to be tried again one by one.
#[cold]
#[inline(never)]
pub(crate) fn rescue<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<CandidateOf<S>, StepError> {
    if (0..mu.dim()).any(|i| !mu[i].all_finite()) {
        return Err(StepError::NonFiniteState);
    }
    let known = solved(&candidate, settings).all();
    let candidate = match known || <ScalarOf<S> as SimdValue>::LANES > 1 {
        true => candidate,
        false => follow(generating, mu, settings).map_err(|reached| {
            refuse(generating, mu, &candidate, |at| StepError::NotFollowed { reached, at })
        })?,
    };
    let (group, chart) = (generating.group(), S::Chart::default());
    if !solved(&candidate, settings).all() {
        let (iterations, residual) = (candidate.iterations, candidate.residual.largest_lane());
        let not_solved = |at| StepError::NotConverged { iterations, residual, at };
        return Err(refuse(generating, mu, &candidate, not_solved));
    }
    let extent = chart.extent(group, &candidate.x);
    if !extent.simd_le(ScalarOf::<S>::of(1.0)).all() {
        let extent = extent.simd_sqrt().largest_lane();
        let outside = |at| StepError::OutsideChart { extent, at };
        return Err(refuse(generating, mu, &candidate, outside));
    }
    let ratio = ratio(generating, mu, &candidate.x);
    if !settings.takes_any_ratio() && !ratio.simd_le(ScalarOf::<S>::of(LARGEST_RATIO)).all() {
        return Err(refuse(generating, mu, &candidate, |at| StepError::SeriesDiverges { at }));
    }
    if !known {
        return Ok(candidate);
    }
    confirm(generating, mu, candidate.clone(), settings).map_err(|reached| {
        refuse(generating, mu, &candidate, |at| StepError::NotFollowed { reached, at })
    })
}

/// The ratio of terms by which the step of this increment is judged: of the last two of the series, or what the rate at
/// which motions part stands for.
fn ratio<S: Integrator + ?Sized>(generating: &S, mu: &VectorOf<S>, x: &VectorOf<S>) -> ScalarOf<S> {
    let of_terms = generating.series_ratio(&largest_p(generating, mu, x));
    of_terms.worse(estimated_ratio(generating, mu, x))
}

/// |p| of an increment, coordinate by coordinate, and what rounding may have done to it: where the terms of p cancel, as
/// for long translations, the terms of the series at p itself mean nothing.
fn largest_p<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
) -> VectorOf<S> {
    let dim = mu.dim();
    let chart = S::Chart::default();
    let (p, derivative) = chart.pull_back_with_derivative(generating.group(), x, mu);
    let rounding = ScalarOf::<S>::of(dim as f64) * ScalarOf::<S>::epsilon();
    VectorOf::<S>::from_entries(dim, |i| {
        let terms =
            (0..dim).fold(mu[i].simd_abs(), |sum, j| sum + (derivative[(i, j)] * x[j]).simd_abs());
        p[i].simd_abs() + rounding * terms
    })
}

/// A refusal with its circumstances.
fn refuse<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: &CandidateOf<S>,
    error: impl FnOnce(Circumstances) -> StepError,
) -> StepError {
    let estimated = estimated_ratio(generating, mu, &candidate.x);
    let ratio = generating.series_ratio(mu).worse(estimated).largest_lane();
    error(Circumstances { x: candidate.x.largest_entry().largest_lane(), ratio, usable_step: None })
}
