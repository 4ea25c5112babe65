//! Solving the equation of a step, x = ∂S/∂p((d^R τ_x)ᵀ μ).
//!
//! A *method of solution* ([`Method`]) proposes a [`Candidate`] for each step; `accept` alone judges candidates, and
//! what it refuses goes to `rescue`, which follows the solution from the identity or says why there is
//! none. Each method is a type in a file of its own and asks for its own small trait, so that a
//! function can only be given to a method that it serves:
//!
//! | method | asks for | for |
//! |---|---|---|
//! | [`Newton`] | [`Predict`], [`NewtonModel`] | groups of few dimensions |
//! | [`LaggedNewton`] | [`LaggedModel`] | four to 24 dimensions, K ≥ 7: no matrices, few gradients |
//! | [`BlockNewton`] | [`BlockModel`] | the same, several steps at once, where registers are wide |
//! | [`FixedPoint`] | [`Predict`] | many dimensions |
//! | [`ByDimension`] | [`Predict`], [`NewtonModel`] | any function at all |

mod accept;
mod block;
mod by_dimension;
mod confirm;
mod continuation;
mod effort;
mod fixed_point;
mod lagged;
mod matrix_free;
mod newton;
mod plain;
mod settings;
pub(crate) mod wide;

pub use block::{BLOCK, BlockModel, BlockNewton, Linearised, LinearisedOf};
pub use by_dimension::ByDimension;
pub use fixed_point::{FixedPoint, MAX_EVALUATIONS};
pub use lagged::{LaggedModel, LaggedNewton};
pub use matrix_free::MatrixFree;
pub use newton::{MAX_ITERATIONS, Newton, NewtonModel, Predict};
pub use settings::Settings;

pub(crate) use accept::{is_right, judge, rescue};

use crate::chart::Chart;
use crate::error::StepError;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// A generating function together with the method by which its steps are solved: all that
/// [`advance`](crate::advance) needs. The attribute implements it; for a function of your own
/// `impl Integrator for Mine { type Method = ByDimension<Self>; }` does, with empty implementations of [`Predict`] and
/// [`NewtonModel`].
pub trait Integrator: GeneratingFunction {
    /// How steps are solved.
    type Method: Method<Self>;

    /// Runs what is seldom needed, given this function. Emitted functions, which are a row of numbers, give away a copy:
    /// the compiler then knows that nobody writes to the original, and keeps its numbers in registers from step to step.
    #[doc(hidden)]
    #[inline(always)]
    fn apart<R>(&self, seldom: impl FnOnce(&Self) -> R) -> R {
        seldom(self)
    }
}

/// A method of solution: it proposes the x of the next step and keeps from step to step what it needs.
pub trait Method<S: GeneratingFunction + ?Sized>: Sized {
    /// Nothing known yet.
    fn begin(generating: &S) -> Self;

    /// The next step, from `mu`, with `left` steps to go, this one included.
    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S>;

    /// Forgets the steps so far: what comes next does not follow from them.
    fn forget(&mut self);

    /// A step from `mu` alone, begun at this guess of p.
    fn propose_from(
        generating: &S,
        mu: &VectorOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S>;

    /// The solution for s·S in place of S, begun at this guess of p: what continuation in s asks for. Slow and careful.
    fn propose_scaled(
        generating: &S,
        mu: &VectorOf<S>,
        scale: ScalarOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S>;
}

/// A step as a method of solution proposes it.
#[derive(Clone, Debug)]
pub struct Candidate<V, T> {
    /// The chart coordinate of the group increment.
    pub x: V,
    /// How far the solution lies from the first guess of p, relative to the largest coordinate of μ.
    pub moved: T,
    /// A bound on what is left of p − (d^R τ_x)ᵀ μ, relative to the largest coordinate of μ; measured where the first
    /// guess was not close.
    pub residual: T,
    /// Newton iterations, or evaluations of the fixed point (in lanes: until the last lane was done).
    pub iterations: u32,
}

/// A candidate for a step of `S`.
pub type CandidateOf<S> = Candidate<VectorOf<S>, ScalarOf<S>>;

/// A point (x, p) of the Lagrangian submanifold over a given momentum.
#[derive(Clone, Debug)]
pub struct Solution<V, T> {
    /// The canonical momentum, (d^R τ_x)ᵀ μ.
    pub p: V,
    /// x = ∂S/∂p(p), the chart coordinate of the group increment.
    pub x: V,
    /// See [`Candidate::iterations`].
    pub iterations: u32,
    /// See [`Candidate::residual`].
    pub residual: T,
}

/// Solves p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), which is J_L(x, p) = μ without an inverse, and accepts the solution
/// by the same test as [`advance`](crate::advance).
///
/// # Errors
/// Any [`StepError`]: what `advance` would refuse.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn solve<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let settings = Settings::default();
    let candidate = S::Method::begin(generating).propose(generating, mu, 1, settings);
    accepted(generating, mu, candidate, settings)
}

/// As [`solve`], from another first guess of p.
///
/// # Errors
/// As [`solve`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn solve_from<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let settings = Settings::default();
    let candidate = S::Method::propose_from(generating, mu, guess, settings);
    accepted(generating, mu, candidate, settings)
}

/// The candidate as a point over μ, if it is accepted.
#[inline(always)]
fn accepted<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let Candidate { x, iterations, residual, .. } = judge(generating, mu, candidate, settings)?;
    let p = S::Chart::default().pull_back(generating.group(), &x, mu);
    Ok(Solution { p, x, iterations, residual })
}

/// Up to this size of the first correction, relative to μ, the estimate of what Newton's method leaves is a bound
/// (tried by the program `stress`); beyond it, what is left is measured by another correction.
const TRUSTED: f64 = 1e-3;

/// What is left is told by shrinking steps down to this share of the estimate (tried by the program `stress`).
const BELOW_ESTIMATE: f64 = 1.0 / 64.0;

/// A solution this near to its first guess, relative to μ, is the one continued from the identity, since the guess is
/// (tried by the program `stress`, not proven).
const NEAR: f64 = 0.05;

/// What sizes are measured by.
#[derive(Clone, Copy, Debug)]
struct Yardstick<T> {
    /// Keeps μ = 0 (whose solution is p = 0) from dividing 0 by 0.
    smallest: T,
    /// The largest coordinate of μ.
    scale: T,
    inverse_scale: T,
    /// What may be left, relative to the scale, of a system that is solved.
    tolerance: T,
}

impl<T: Scalar> Yardstick<T> {
    #[inline(always)]
    fn of<V: Coordinates<T>>(mu: &V, settings: Settings<T>) -> Self {
        let smallest = T::of(f64::from(f32::MIN_POSITIVE));
        let scale = mu.largest_entry() + smallest;
        Self { smallest, scale, inverse_scale: T::of(1.0) / scale, tolerance: settings.tolerance() }
    }

    /// What a step of Newton's method leaves, relative to the scale, given an estimate of it, the step's size, and
    /// the size of the step before it, if it has one with which to compare.
    ///
    /// The estimate knows no more of S than the size of its coefficients, and counts for small steps only. From the
    /// second step on the steps themselves tell by what they shrink, and one of rounding's size is the last. Where the
    /// first step goes another way than what is left, along an axis of the body say, they tell too little: what is left
    /// counts as a sixty-fourth of the estimate at least.
    #[inline(always)]
    fn left(&self, estimate: T, relative: T, previous: Option<T>) -> T {
        let left = match previous {
            Some(previous) => {
                let shrunk = T::of(2.0) * relative * relative / previous;
                estimate.simd_min(shrunk.simd_max(T::of(BELOW_ESTIMATE) * estimate))
            }
            None => estimate.select(relative.simd_le(T::of(TRUSTED)), relative),
        };
        left.simd_min(relative).select(relative.simd_le(self.tolerance), left)
    }
}
