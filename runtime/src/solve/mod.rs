//! Solving J_L(∂S/∂p(p), p) = μ for p.

mod ahead;
mod at_once;
mod effort;
mod fixed_point;
mod in_parts;
mod matrix_free;
mod newton;

pub use matrix_free::MatrixFree;

pub(crate) use ahead::Ahead;
pub(crate) use at_once::{AtOnce, Increment};
use in_parts::{Start, in_parts};

use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::scalar::Scalar;

/// Newton iterations allowed before the solver gives up.
pub const MAX_ITERATIONS: u32 = 20;

/// Evaluations of the fixed point allowed before the solver gives up.
pub const MAX_EVALUATIONS: u32 = 60;

/// How the equation is solved. Both go to rounding, so the map is the same; the cost is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Newton's method: one to three iterations, each with the Hessian of S and a dense linear
    /// system, or without matrices ([`GeneratingFunction::in_parts`]). For groups of few dimensions.
    #[default]
    Newton,
    /// The fixed point p ↦ (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), with Anderson acceleration: more iterations,
    /// each with the gradient of S alone and work linear in the dimension. For spin chains and
    /// other large groups. Contracts for about h|Ω| < 1.
    FixedPoint,
}

/// A point (x, p) of the Lagrangian submanifold over a given momentum.
#[derive(Clone, Debug)]
pub struct Solution<V, T> {
    /// The canonical momentum.
    pub p: V,
    /// x = ∂S/∂p(p), the chart coordinate of the group increment.
    pub x: V,
    /// Newton iterations, or evaluations of the fixed point (in lanes: until the last lane was
    /// done).
    pub iterations: u32,
    /// The residual left, relative to the largest coordinate of μ: an estimate for Newton's method,
    /// which spares the evaluation.
    pub residual: T,
}

/// Solves p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), which is J_L(x, p) = μ without an inverse, from
/// [`GeneratingFunction::predict`], as [`GeneratingFunction::SOLVER`] says.
///
/// # Errors
/// [`StepError::NonFiniteState`] for a μ with NaN or infinity; [`StepError::NotConverged`] or
/// [`StepError::FixedPointNotConverged`] when rounding is not reached within [`MAX_ITERATIONS`] or
/// [`MAX_EVALUATIONS`].
#[inline(always)]
pub fn solve<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    if S::IN_PARTS && goes_in_parts(generating) {
        return in_parts(generating, mu, Start::predicted(generating, mu));
    }
    solve_from(generating, mu, generating.predict(mu))
}

/// As [`solve`], where `last` is the p of the step that has led to μ, if there was one.
#[inline(always)]
pub(crate) fn solve_after<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    last: Option<&VectorOf<S>>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let guess = match last {
        Some(last) => generating.predict_after(last, mu),
        None => generating.predict(mu),
    };
    solve_from(generating, mu, guess)
}

/// As [`solve`], from another first guess of p.
///
/// # Errors
/// As [`solve`].
#[inline(always)]
pub fn solve_from<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    // Constants: solvers that are not asked for, Newton's method with its matrices above all, are not even built.
    if S::IN_PARTS && goes_in_parts(generating) {
        return in_parts(generating, mu, Start::new(generating, None, guess));
    }
    match S::SOLVER {
        Solver::Newton => newton::newton(generating, mu, guess),
        Solver::FixedPoint => fixed_point::fixed_point(generating, mu, guess),
    }
}

/// Whether [`Solver::Newton`] is meant, and its steps go by parts of the gradient.
#[inline(always)]
fn goes_in_parts<S: GeneratingFunction + ?Sized>(generating: &S) -> bool {
    matches!(S::SOLVER, Solver::Newton) && generating.in_parts()
}

/// What sizes are measured by.
#[derive(Clone, Copy)]
struct Yardstick<T> {
    /// Keeps μ = 0 (whose solution is p = 0) from dividing 0 by 0.
    smallest: T,
    /// The largest coordinate of μ.
    scale: T,
    inverse_scale: T,
    /// What is left, relative to the scale, of a system that is solved.
    tolerance: T,
}

impl<T: Scalar> Yardstick<T> {
    #[inline(always)]
    fn of<V: Coordinates<T>>(mu: &V) -> Self {
        let smallest = T::of(f64::from(f32::MIN_POSITIVE));
        let scale = mu.largest_entry() + smallest;
        let tolerance = T::of(4.0) * T::epsilon();
        Self { smallest, scale, inverse_scale: T::of(1.0) / scale, tolerance }
    }

    /// An estimate of what a step of Newton's method leaves, relative to the scale, given a bound on
    /// it, the step's size, and the size of the step before it, if it has one with which to compare.
    ///
    /// The bound knows no more of S than the size of its coefficients. From the second step on the
    /// steps themselves tell by what they shrink, and one of rounding's size is the last.
    #[inline(always)]
    fn left(&self, bound: T, relative: T, previous: Option<T>) -> T {
        let left = match previous {
            Some(previous) => bound.simd_min(T::of(2.0) * relative * relative / previous),
            None => bound,
        };
        left.simd_min(relative).select(relative.simd_le(self.tolerance), left)
    }
}

/// Names the reason of a failure; off the hot path.
#[cold]
fn failure<T: Scalar, V: Coordinates<T>>(
    solver: Solver,
    mu: &V,
    iterations: u32,
    remaining: T,
) -> StepError {
    if (0..mu.dim()).any(|i| !mu[i].all_finite()) {
        return StepError::NonFiniteState;
    }
    let residual = remaining.largest_lane();
    match solver {
        Solver::Newton => StepError::NotConverged { iterations, residual },
        Solver::FixedPoint => StepError::FixedPointNotConverged { iterations, residual },
    }
}
