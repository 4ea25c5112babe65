//! Fitting the coefficients of S to motions.
//!
//! Any function of p generates an equivariant symplectic map, so the coefficients of a truncated
//! series may be chosen for accuracy alone. Taylor's choice is the best for short steps; for a given
//! step along a given motion there are far better ones, as Chebyshev's polynomials are to Taylor's
//! on an interval: the motion fills a torus in 𝔤\* (the free body: a curve), and only there the
//! gradient of S has to be right. On the free body K = 5 with fitted coefficients does what K = 13
//! does without, and K = 7 reaches rounding at h|Ω| = 1.
//!
//! The data are the integrator's own: at a step shorter by so much that its error does not count,
//! increments of the group along the motion are multiplied to increments over the whole step. They
//! give pairs (x, p), and x = ∂S/∂p(p) is linear in the coefficients.

mod coefficients;
mod least_squares;
mod motion;

use alloc::vec::Vec;

use nalgebra::ComplexField;

use self::coefficients::{free_terms, missed, residual};
use self::motion::{Point, follow};
use super::trial::{self, Moved, Sample, is_better};
use crate::error::StepError;
use crate::generating::Adjustable;
use crate::generating::VectorOf;
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::solve::{Integrator, Predict};

/// Coefficients that a fit is made for at most: elimination takes their third power.
pub const MAX_FITTED_TERMS: usize = 1024;

/// Shortened steps in a step at most.
const MAX_SUBSTEPS: f64 = 64.0;
/// Equations for each coefficient.
const EQUATIONS: usize = 2;
/// Samples of a motion at least, for each dimension: motions in more dimensions fill larger tori.
const MIN_SAMPLES: usize = 5;
/// One in so many samples is left out of the fit, to judge it.
const UNSEEN: usize = 5;
/// What may be left of the errors for a fit to be taken.
const SHARE: f64 = 0.1;
/// Steps over which a motion is followed at most: some seconds of work.
const MAX_STEPS: f64 = 1e6;

/// A fitted generating function and how good it is.
#[derive(Clone, Copy, Debug)]
pub struct Fit<S> {
    /// The integrator.
    pub integrator: S,
    /// The largest error of a coordinate of x = ∂S/∂p in one step before the fit.
    pub before: f64,
    /// The same after the fit, where it was fitted.
    pub fitted: f64,
    /// The same after the fit at other points of the motions, which were left out to judge it.
    pub unseen: f64,
}

/// Why there is no fit.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// A step failed, or could not be made.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The duration is not a positive number.
    #[error(
        "duration {duration} is not usable: give the time, finite and positive, over which the \
         motions are followed"
    )]
    InvalidDuration {
        /// The duration given.
        duration: f64,
    },
    /// The duration is so many steps that following them would take long.
    #[error(
        "duration {duration} is {steps:.0} steps, and motions are followed for at most {MAX_STEPS}: give \
         the time in which the motion comes near to all it does later"
    )]
    TooLong {
        /// The duration given.
        duration: f64,
        /// In steps.
        steps: f64,
    },
    /// No momentum was given.
    #[error("there is no motion to fit to: give at least one momentum")]
    NoMotion,
    /// The increment of a step lies beyond the chart.
    #[error("a step of {step} leaves the chart: fit a shorter one")]
    OutsideChart {
        /// The step size given.
        step: f64,
    },
    /// S has too many terms.
    #[error(
        "{terms} terms of S would be fitted, and at most {MAX_FITTED_TERMS} can be: take a lower truncation, or \
         `tuned`"
    )]
    TooManyTerms {
        /// The terms to be fitted.
        terms: usize,
    },
}

impl From<crate::Stopped> for FitError {
    fn from(stopped: crate::Stopped) -> Self {
        Self::Step(stopped.error)
    }
}

/// The integrator that `series` makes, its coefficients fitted to the motions that start with
/// `momenta`, followed for the time `duration`: to be chosen so long that the motions come near to
/// all they do later, for a periodic one its period. `series` makes the integrator for any step
/// size.
///
/// As geometric as the series itself, and as fast; along the motions it is as accurate as a
/// truncation higher by some six. Near them it is about as accurate as near; far from them it may be
/// less accurate than the series. Where the fit does not hold at samples that were left out of it, or does not leave
/// a tenth of the error of 256 steps in a row from the given momenta (of up to eight of them) and of single steps as far
/// again, the integrator is the series as it was ([`Fit::unseen`] then equals [`Fit::before`]).
///
/// ```
/// use coadjoint::{Phase, SO3, tune::fit, lie_poisson};
///
/// #[lie_poisson(group = SO3, truncation = 5)]
/// fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
///     0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
/// }
///
/// # fn main() -> Result<(), coadjoint::tune::FitError> {
/// let (inertia, start) = ([1.5, 2.0, 2.5], [2.0, 0.5, 1.0]);
/// let fitted = fit(0.8, |h| Body::new(h, inertia), [start], 12.0)?;
/// assert!(fitted.before > 1e-6 && fitted.unseen < 1e-10);
/// let mut state = Phase::<SO3>::at_identity(start);
/// fitted.integrator.advance_by(&mut state, 1000)?;
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`FitError`].
pub fn fit<S, V>(
    step: f64,
    series: impl Fn(f64) -> Result<S, StepError>,
    momenta: impl IntoIterator<Item = impl Into<V>>,
    duration: f64,
) -> Result<Fit<S>, FitError>
where
    S: Adjustable + Integrator + Predict,
    S::Group: LieGroup<Scalar = f64, Vector = V>,
    V: Coordinates<f64>,
{
    if !(duration > 0.0 && duration.is_finite()) {
        return Err(FitError::InvalidDuration { duration });
    }
    let whole = series(step)?;
    let steps = duration / step.abs();
    if steps > MAX_STEPS {
        return Err(FitError::TooLong { duration, steps });
    }
    let free = free_terms(&whole);
    let terms = free.len();
    if terms > MAX_FITTED_TERMS {
        return Err(FitError::TooManyTerms { terms });
    }
    let momenta: Vec<V> = momenta.into_iter().map(Into::into).collect();
    if momenta.is_empty() {
        return Err(FitError::NoMotion);
    }
    let half = series(0.5 * step)?;
    let mut motions = Sample::new();
    momenta.iter().for_each(|momentum| motions.pass(momentum));
    let Points { seen, unseen } = sample(&whole, terms, series, step, momenta, steps)?;

    let of_series = coefficients::of_series(&whole, &free, &seen);
    let of_guess = coefficients::of_guess(&whole, &seen);
    let both: Vec<f64> = of_series.iter().zip(&of_guess).map(|(a, b)| a + b).collect();
    let integrator = whole.adjusted(&both);
    let before = error(&whole, &unseen);
    let (fitted, at_unseen) = (error(&integrator, &seen), error(&integrator, &unseen));
    let exact = |mu: &V| by_halves(&half, mu);
    let holds = at_unseen < before && is_better(&whole, &integrator, exact, &motions, SHARE);
    let guesses = guess_error(&integrator, &unseen) <= guess_error(&whole, &unseen);
    let integrator = match (holds, guesses) {
        (true, true) => integrator,
        (true, false) => whole.adjusted(&of_series),
        (false, _) => whole,
    };
    let (fitted, unseen) = if holds { (fitted, at_unseen) } else { (before, before) };
    Ok(Fit { integrator, before, fitted, unseen })
}

/// A step of the flow by two of half its length: what they leave out is 2^{K+1} times less.
fn by_halves<S: Integrator + Predict>(half: &S, mu: &VectorOf<S>) -> Result<Moved<S>, StepError> {
    let (first, middle) = trial::step(half, mu)?;
    let (second, end) = trial::step(half, &middle)?;
    Ok((half.group().compose(&first, &second), end))
}

/// Points to fit to and points to judge by.
struct Points<V> {
    seen: Vec<Point<V>>,
    unseen: Vec<Point<V>>,
}

/// Points of the motions over so many steps, as many as a fit of so many terms wants.
fn sample<S, V>(
    whole: &S,
    terms: usize,
    series: impl Fn(f64) -> Result<S, StepError>,
    step: f64,
    momenta: Vec<V>,
    steps: f64,
) -> Result<Points<V>, FitError>
where
    S: Adjustable + Integrator + Predict,
    S::Group: LieGroup<Scalar = f64, Vector = V>,
    V: Coordinates<f64>,
{
    let dim = whole.group().dim();
    let substeps = substeps(whole.truncation(), dim);
    let fine = series(step / substeps as f64)?;
    let wanted = (EQUATIONS * terms / (dim * momenta.len())).max(MIN_SAMPLES * dim);
    let count = wanted.div_ceil(2) * UNSEEN / (UNSEEN - 1);
    let spacing = steps * substeps as f64 / count as f64;
    let places: Vec<u64> = (0..count).map(|n| (n as f64 * spacing) as u64).collect();
    let mut points = Vec::with_capacity(count * momenta.len());
    for momentum in momenta {
        follow(whole, &fine, momentum, &places, substeps, &mut points)
            .map_err(|error| error.unwrap_or(FitError::OutsideChart { step }))?;
    }
    let (unseen, seen): (Vec<_>, Vec<_>) =
        points.into_iter().enumerate().partition(|(n, _)| n % UNSEEN == UNSEEN / 2);
    let points = |numbered: Vec<(usize, _)>| numbered.into_iter().map(|(_, point)| point).collect();
    Ok(Points { seen: points(seen), unseen: points(unseen) })
}

/// The largest coordinate of x − ∂S/∂p(p) at the points.
fn error<S>(generating: &S, points: &[Point<VectorOf<S>>]) -> f64
where
    S: Predict,
    S::Group: LieGroup<Scalar = f64>,
{
    let errors = points.iter().map(|point| residual(generating, &point.after).largest_entry());
    largest(errors)
}

/// The largest coordinate of the error of the first guess at the points.
fn guess_error<S>(generating: &S, points: &[Point<VectorOf<S>>]) -> f64
where
    S: Predict,
    S::Group: LieGroup<Scalar = f64>,
{
    largest(points.iter().map(|point| missed(generating, point).largest_entry()))
}

/// The largest of the numbers; NaN if one of them is.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if b <= a || a.is_nan() { a } else { b };
    numbers.fold(0.0, larger)
}

/// Into how many parts a step is divided, so that the remainder left in the data does not count. A
/// fit of the free body, whose motions are curves, makes that of K = 5 smaller by some seven digits,
/// and by one more for each term; on larger tori a fit gains six at most.
fn substeps(truncation: usize, dim: usize) -> u64 {
    let digits = if dim > 3 { 6.0 } else { (truncation as f64 + 9.0) / 2.0 };
    let order = truncation as f64 + 1.0;
    // Not f64's own methods, which need `std`.
    ComplexField::ceil(ComplexField::powf(10.0_f64, digits / order)).min(MAX_SUBSTEPS) as u64
}
