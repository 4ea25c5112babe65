//! Chooses a truncation and a step size for a tolerance.
//!
//! The error of the method of truncation K is, to leading order, what the missing terms S_{K+2},
//! S_{K+4}, … of the exact series do. They are derived, so their size is known exactly where
//! momenta stay, and with the state at the start known also how it accumulates. [`Prospects`] takes
//! the K and h that need fewest operations per unit time.

mod along;
mod region;

use std::fmt;

use crate::hamilton_jacobi::{self, DeriveError, GeneratingSeries, TermLimit};
use crate::integrator::{Guesses, Plan};
use crate::problem::Problem;
use crate::tolerance::along::{Along, Brackets, Flow, Gradient, rate};

pub use region::Region;

/// Truncations tried.
const TRUNCATIONS: std::ops::RangeInclusive<usize> = 3..=17;
/// The share of the tolerance that the estimate may use up.
const SAFETY: f64 = 0.5;
/// The most that S_{j+2} h² may be of S_j: beyond, the series converges too slowly to go by.
const RATIO: f64 = 0.4;
/// The most that the group may turn in one step, in radians; the exponential's canonical momentum
/// folds at about 2.
const TURN: f64 = 1.5;

/// The most steps of a run that is picked: more than a day of computing.
const MOST_STEPS: f64 = 1e10;
/// The smallest step that is picked, as part of the time in which the group turns by [`TURN`]. With
/// K = 3 a tolerance of 1e-14 needs about 1e-4 of it.
const SMALLEST: f64 = 1e-6;

/// The accuracy wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The error at the end of a run: of the momentum relative to its largest coordinate, of the
    /// group element in coordinates of the algebra (radians for rotations).
    pub tolerance: f64,
    /// The duration of the run.
    pub duration: f64,
    /// The momentum at the start.
    pub start: Option<Vec<f64>>,
    /// The region in which the momentum stays; if there is none, that of the run from `start`.
    pub region: Option<Region>,
    /// The truncation, if it is fixed.
    pub truncation: Option<usize>,
}

/// The choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The tolerance asked for.
    pub tolerance: f64,
    /// K.
    pub truncation: usize,
    /// True for the series of the comoving frame.
    pub comoving: bool,
    /// h; it divides the duration.
    pub step: f64,
    /// h^{K+1} max |∂S_{K+2}|: the error the first missing term makes per unit time; none with collocation, which has no
    /// series.
    pub next_term: Option<f64>,
    /// The error expected at the end, of all missing terms.
    pub error: f64,
    /// The region over which the maximum is taken.
    pub region: Region,
    /// True if the maximum is taken along one run, which stays in the region.
    pub along_run: bool,
    /// Operations per unit time, by which this was the least.
    pub operations: f64,
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let run = if self.along_run { "along the run, " } else { "over " };
        let Self { tolerance, truncation, step, region, error, .. } = self;
        let comoving = if self.comoving { ", comoving" } else { "" };
        write!(f, "tolerance {tolerance:e}: K = {truncation}{comoving}, h = {step} (")?;
        match self.next_term {
            Some(term) => write!(f, "next term {term:.1e} per unit time ")?,
            None => write!(f, "collocation, {} nodes, ", truncation.div_ceil(2))?,
        }
        write!(f, "{run}{region}; {error:.1e} at the end)")
    }
}

/// The limit of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bound {
    /// The duration of the run.
    Duration,
    /// The ratio of neighbouring terms of the series.
    Ratio,
    /// The angle by which the group turns in a step.
    Turn,
    /// The error at the end.
    Error,
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Duration => f.write_str("the duration of the run"),
            Self::Ratio => {
                write!(f, "that a term of the series be at most {RATIO} of the one before it")
            }
            Self::Turn => write!(f, "that the group turn by at most {TURN} rad in a step"),
            Self::Error => f.write_str("the error that the missing terms make by the end"),
        }
    }
}

/// Reasons for which nothing was chosen.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ToleranceError {
    /// A tolerance that rounding alone exceeds, or that is none.
    #[error("the tolerance {0:e} must lie between 1e-14 and 1e-1; write for example 1e-9")]
    Tolerance(f64),
    /// A duration that is none.
    #[error("the duration {0} must be finite and positive")]
    Duration(f64),
    /// The region is empty or not bounded.
    #[error("the region must be a positive radius, or bounds [low, high] with low ≤ high")]
    Region,
    /// Bounds for another number of coordinates.
    #[error(
        "the region has {found} bounds, the momentum {dim} coordinates; give one [low, high] for each, or a radius"
    )]
    Bounds {
        /// Bounds given.
        found: usize,
        /// The dimension.
        dim: usize,
    },
    /// Neither a start nor a region.
    #[error(
        "a tolerance needs the momentum at the start, or a region: write for example region = 2.5"
    )]
    Nowhere,
    /// The momentum at the start does not fit.
    #[error("the momentum at the start must be {dim} finite numbers")]
    Start {
        /// The dimension.
        dim: usize,
    },
    /// A parameter without a value.
    #[error("a tolerance needs the value of every parameter, and the coefficient {0} has none")]
    Symbol(String),
    /// The series cannot be derived.
    #[error(transparent)]
    Derive(#[from] DeriveError),
    /// The step that meets the tolerance is far below the motion's own time scale, or far too many
    /// are needed.
    #[error(
        "the tolerance {tolerance:e} needs h = {step:.1e} even at K = {truncation}, {steps:.1e} steps ({scale}; at most {most:e} steps are picked): the bound behind it is {bound}. {advice}",
        scale = scale_text(*.scale), most = MOST_STEPS, advice = advice(*.bound, *.along_run)
    )]
    StepTooSmall {
        /// The tolerance asked for.
        tolerance: f64,
        /// The truncation that needs fewest operations.
        truncation: usize,
        /// The step it needs; 0 or not a number where none meets the tolerance.
        step: f64,
        /// The steps of the run.
        steps: f64,
        /// The time in which the group turns by 1.5 rad; infinite if it does not.
        scale: f64,
        /// The limit of the step.
        bound: Bound,
        /// True if it was found along a run, not over a region.
        along_run: bool,
    },
    /// Even the smallest truncation is too large.
    #[error(
        "S_{order} is too large to derive, so nothing is known of the error of any truncation: give truncation and step instead"
    )]
    TooLarge {
        /// The order.
        order: usize,
    },
}

fn scale_text(scale: f64) -> String {
    if scale.is_finite() {
        format!("the group turns by {TURN} rad in {scale:.1e}")
    } else {
        "nothing turns".to_owned()
    }
}

fn advice(bound: Bound, along_run: bool) -> &'static str {
    match (bound, along_run) {
        (Bound::Error | Bound::Duration, _) => {
            "Ask for a larger tolerance or a shorter run, or give truncation and step instead"
        }
        (_, false) => {
            "Give a smaller region, or bounds for each coordinate that leave out where the motion is \
             fast, or truncation and step instead"
        }
        (_, true) => "Give truncation and step instead, and see with `check` what they are worth",
    }
}

impl ToleranceError {
    /// True where the series is too large, and not the target at fault.
    pub fn is_of_size(&self) -> bool {
        match self {
            Self::TooLarge { .. } => true,
            Self::Derive(error) => error.is_of_size(),
            _ => false,
        }
    }
}

/// The truncations of a problem, with the errors that their steps make along a run or over a region: K and h follow from
/// them for any tolerance.
#[derive(Clone, Debug)]
pub struct Prospects {
    duration: f64,
    comoving: bool,
    along_run: bool,
    /// The orders of the terms, all odd: the others vanish.
    orders: Vec<usize>,
    sizes: Sizes,
    /// Truncations, with the operations of a step.
    truncations: Vec<(usize, usize)>,
}

impl Prospects {
    /// Derives the terms and follows their errors, for any tolerance of the target.
    ///
    /// Symbols of the problem must not need parameters (a system file's are substituted).
    ///
    /// # Errors
    /// [`ToleranceError`] for a target that makes no sense, or where not even S₅ can be derived.
    pub fn new(
        problem: &Problem,
        target: &Target,
        limit: TermLimit,
    ) -> Result<Self, ToleranceError> {
        let dim = problem.algebra.dim();
        target.check(dim)?;
        let mut symbols = Vec::new();
        for symbol in &problem.symbols {
            let value = symbol.expr.evaluate(&[]);
            if !value.is_finite() {
                return Err(ToleranceError::Symbol(symbol.text.clone()));
            }
            symbols.push(value);
        }
        let series = derive(problem, target.truncation, limit)?;
        let orders: Vec<usize> = (1..=series.truncation()).step_by(2).collect();
        let terms: Vec<Gradient> =
            orders.iter().map(|&j| Gradient::new(series.order(j), dim, &symbols)).collect();
        let brackets = Brackets::new(&problem.algebra);
        let energy = Gradient::new(problem.generated(), dim, &symbols);
        let slope = |i| Gradient::new(&problem.generated().derivative(i), dim, &symbols);
        let curvature: Vec<Gradient> = (0..dim).map(slope).collect();
        let flow =
            Flow { brackets: &brackets, energy: &energy, curvature: &curvature, terms: &terms };
        let sizes = Sizes::of(&flow, dim, target);
        let first = target.truncation.unwrap_or(*TRUNCATIONS.start());
        let last = target.truncation.unwrap_or(*TRUNCATIONS.end()).min(series.truncation() - 2);
        let mut guesses = Guesses::new(problem, limit)?;
        let mut truncations = Vec::new();
        for truncation in (first..=last).step_by(2) {
            let candidate = Problem { truncation, ..problem.clone() };
            truncations.push((truncation, Plan::operations(&candidate, &series, &mut guesses)?));
        }
        Ok(Self {
            duration: target.duration,
            comoving: problem.comoving.is_some(),
            along_run: target.region.is_none(),
            orders,
            sizes,
            truncations,
        })
    }

    /// Picks the K and h that need fewest operations per unit time.
    ///
    /// # Errors
    /// [`ToleranceError::StepTooSmall`] where there are none.
    pub fn choose(&self, tolerance: f64) -> Result<Choice, ToleranceError> {
        let Self { duration, comoving, along_run, ref orders, ref sizes, .. } = *self;
        let choices = self.truncations.iter().map(|&(truncation, operations)| {
            let (step, bound) = sizes.step(orders, truncation, (duration, tolerance));
            let choice = Choice {
                tolerance,
                truncation,
                comoving,
                step,
                next_term: Some(
                    sizes.rates[truncation.div_ceil(2)] * step.powi(truncation as i32 + 1),
                ),
                error: sizes.error(orders, truncation, step),
                region: sizes.region.clone(),
                along_run,
                operations: operations as f64 / step,
            };
            (choice, bound)
        });
        let cheaper =
            |a: &(Choice, Bound), b: &(Choice, Bound)| a.0.operations.total_cmp(&b.0.operations);
        let Some((choice, bound)) = choices.min_by(cheaper) else {
            return Err(ToleranceError::TooLarge { order: *TRUNCATIONS.start() + 2 });
        };
        let scale = if sizes.turning > 0.0 { TURN / sizes.turning } else { f64::INFINITY };
        let steps = duration / choice.step;
        let possible = choice.step > 0.0 && choice.error.is_finite() && steps <= MOST_STEPS;
        if !possible || choice.step < SMALLEST * scale.min(duration) {
            return Err(ToleranceError::StepTooSmall {
                tolerance,
                truncation: choice.truncation,
                step: choice.step,
                steps,
                scale,
                bound,
                along_run,
            });
        }
        Ok(choice)
    }
}

impl Target {
    /// Checks the target for momenta of this dimension.
    ///
    /// # Errors
    /// Refuses a target that makes no sense, with the reason.
    pub fn check(&self, dim: usize) -> Result<(), ToleranceError> {
        if !(1e-14..=1e-1).contains(&self.tolerance) {
            return Err(ToleranceError::Tolerance(self.tolerance));
        }
        if self.duration <= 0.0 || !self.duration.is_finite() {
            return Err(ToleranceError::Duration(self.duration));
        }
        match &self.start {
            Some(start) if start.len() != dim || start.iter().any(|x| !x.is_finite()) => {
                return Err(ToleranceError::Start { dim });
            }
            None if self.region.is_none() => return Err(ToleranceError::Nowhere),
            _ => {}
        }
        self.region.as_ref().map_or(Ok(()), |region| region.check(dim))
    }
}

/// S₁, S₃, … as far as they are affordable, at least as far as the smallest truncation needs.
fn derive(
    problem: &Problem,
    only: Option<usize>,
    limit: TermLimit,
) -> Result<GeneratingSeries, ToleranceError> {
    let range = [*TRUNCATIONS.start(), *TRUNCATIONS.end()];
    let orders = only.map_or(range, |only| [only; 2]).map(|truncation| truncation + 2);
    let Problem { algebra, chart, .. } = problem;
    let derived = hamilton_jacobi::estimate(algebra, *chart, problem.generated(), orders, limit);
    derived.map_err(|error| match error {
        DeriveError::TooLarge { .. } | DeriveError::TooMuchWork { .. } => {
            ToleranceError::TooLarge { order: orders[0] }
        }
        error => error.into(),
    })
}

/// The size of the terms, and their effect.
#[derive(Clone, Debug)]
struct Sizes {
    /// max |∂S_j| over the region, for each odd j.
    rates: Vec<f64>,
    /// The error that S_j, left out, makes by the end for h = 1.
    errors: Vec<f64>,
    region: Region,
    /// The largest angular velocity.
    turning: f64,
    /// The largest ratio of neighbouring terms, for h = 1.
    ratio: f64,
}

impl Sizes {
    fn of(flow: &Flow<'_>, dim: usize, target: &Target) -> Self {
        let along = target.start.as_ref().map(|start| flow.follow(start, target.duration));
        let (rates, errors, region, turning) = match (&target.region, along) {
            (None, Some(Along { rates, errors, radius, turning })) => {
                (rates, errors, Region::Ball(radius), turning)
            }
            (region, along) => {
                // `check` has seen to it that there is a region where there is no run.
                let region = region.clone().unwrap_or(Region::Ball(1.0));
                let count = flow.terms.len();
                let mut found = region.largest(dim, count + 1, |mu| {
                    let terms = flow.terms.iter().map(|term| rate(flow.brackets, &term.at(mu), mu));
                    let turning = flow.brackets.turning_rate(&flow.energy.at(mu));
                    terms.chain([turning]).collect()
                });
                let turning = found.pop().unwrap_or(0.0);
                let errors = found
                    .iter()
                    .enumerate()
                    .map(|(i, &most)| match &along {
                        // As on the run, scaled up to the largest in the region.
                        Some(run) if run.rates[i] > 0.0 => {
                            run.errors[i] * f64::max(most / run.rates[i], 1.0)
                        }
                        // In proportion to time, as on regular orbits.
                        _ => most * target.duration,
                    })
                    .collect();
                (found, errors, region, turning)
            }
        };
        // The first ratios say little of those that follow.
        let ratios = rates.windows(2).skip(1).filter(|w| w[0] > 0.0).map(|w| w[1] / w[0]);
        let ratio = ratios.fold(0.0, f64::max);
        Self { rates, errors, region, turning, ratio }
    }

    /// The error at the end for truncation K and step h: of every term known beyond K, and of the
    /// rest as a geometric series.
    fn error(&self, orders: &[usize], truncation: usize, step: f64) -> f64 {
        let missing = orders.iter().zip(&self.errors).filter(|(j, _)| **j > truncation);
        let mut last = 0.0;
        let mut sum = 0.0;
        for (&order, error) in missing {
            last = error * step.powi(order as i32 - 1);
            sum += last;
        }
        let ratio = self.ratio * step * step;
        sum + last * ratio / (1.0 - ratio).max(0.1)
    }

    /// The largest step that meets the target, so that the duration is a whole number of steps, and
    /// what it is limited by.
    fn step(
        &self,
        orders: &[usize],
        truncation: usize,
        (duration, tolerance): (f64, f64),
    ) -> (f64, Bound) {
        let (mut most, mut bound) = (duration, Bound::Duration);
        let ratio = (RATIO / self.ratio).sqrt();
        if self.ratio > 0.0 && ratio < most {
            (most, bound) = (ratio, Bound::Ratio);
        }
        let turn = TURN / self.turning;
        if self.turning > 0.0 && turn < most {
            (most, bound) = (turn, Bound::Turn);
        }
        let goal = SAFETY * tolerance;
        let (mut low, mut high) = (0.0, most);
        if self.error(orders, truncation, most) > goal {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if self.error(orders, truncation, middle) > goal {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            (most, bound) = (low, Bound::Error);
        }
        (duration / (duration / most).ceil(), bound)
    }
}
