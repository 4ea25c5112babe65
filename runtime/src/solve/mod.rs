//! Solving the equation of a step, x = ∂S/∂p((d^R τ_x)ᵀ μ), for any function S.
//!
//! Functions that are programs solve it by their own ([`Integrator::drive`]). For all others, and for the steps that
//! programs refuse, this is the way: a `Candidate` by Newton's method or by the fixed point ([`Solver`]), which `accept`
//! judges. Where it is not certain to be the right one, the solution is followed from the identity.

mod accept;
mod candidate;
mod continuation;
mod fixed_point;
mod newton;

use crate::chart::Chart;
use crate::error::StepError;
use crate::generating::{GeneratingFunction, Reversed, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::number::Scalar;

pub(crate) use accept::accept;
#[doc(hidden)]
pub use accept::estimated_ratio;
pub(crate) use candidate::{Candidate, CandidateOf};

/// Up to this dimension Newton's method is faster than the fixed point.
const LARGEST_DENSE: usize = 24;

/// The solver of a generating function's steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Newton's method with dense matrices: few iterations, each with the Hessian of S and a linear system.
    Newton,
    /// The fixed point p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p): more iterations, each with the gradient of S alone. It contracts
    /// for about h|Ω| < 1.
    FixedPoint,
}

/// A generating function whose steps [`advance`](crate::steps::advance) can make. The attribute implements it; for a function of
/// your own `impl Integrator for Mine {}` does.
pub trait Integrator: GeneratingFunction {
    /// The solver: Newton's method up to 24 dimensions, the fixed point beyond.
    #[inline]
    fn solver(&self) -> Solver {
        match self.group().dim() {
            0..=LARGEST_DENSE => Solver::Newton,
            _ => Solver::FixedPoint,
        }
    }

    /// A first guess of the p of the step from μ; if not given, (d^R τ_x)ᵀ μ with x = ∂S/∂p(μ).
    #[inline]
    fn predict(&self, mu: &VectorOf<Self>) -> VectorOf<Self> {
        Self::Chart::default().pull_back(self.group(), &self.gradient(mu), mu)
    }

    /// Makes steps by straight-line programs, where the function has them: what the attribute emits.
    #[doc(hidden)]
    #[inline(always)]
    fn drive(&self, phase: &mut Phase<Self::Group>, steps: u64) -> DrivenOf<Self> {
        let _ = (phase, steps);
        Driven::none(Scalar::of(0.0))
    }
}

/// The outcome of driving programs.
#[derive(Clone, Debug)]
pub struct Driven<V, T> {
    /// Steps made.
    pub steps: u64,
    /// The largest number of corrections of a step.
    pub iterations: u32,
    /// The largest residual of a step, relative to the largest coordinate of μ.
    pub residual: T,
    /// The next step, where it was solved for and refused: its x, and how far p lies from its first guess.
    pub refused: Option<(V, T)>,
}

/// The outcome of driving the programs of `S`.
pub type DrivenOf<S> = DrivenIn<<S as GeneratingFunction>::Group>;

/// The outcome of driving programs on a group.
pub type DrivenIn<G> = Driven<<G as LieGroup>::Vector, <G as LieGroup>::Scalar>;

impl<V, T> Driven<V, T> {
    /// No step, and so no residual.
    #[inline(always)]
    pub fn none(zero: T) -> Self {
        Self { steps: 0, iterations: 0, residual: zero, refused: None }
    }
}

/// A point (x, p) of the Lagrangian submanifold over a given momentum.
#[derive(Clone, Debug)]
pub struct Solution<V, T> {
    /// The canonical momentum, (d^R τ_x)ᵀ μ.
    pub p: V,
    /// x = ∂S/∂p(p), the chart coordinate of the group increment.
    pub x: V,
    /// Newton iterations, or evaluations of the fixed point.
    pub iterations: u32,
    /// The residual p − (d^R τ_x)ᵀ μ, relative to the largest coordinate of μ.
    pub residual: T,
}

/// Solves p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), which is J_L(x, p) = μ without an inverse, and accepts the solution
/// by the same test as [`advance`](crate::steps::advance).
///
/// # Errors
/// Any [`StepError`]: what `advance` would refuse.
pub fn solve<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    solve_from(generating, mu, generating.predict(mu))
}

/// As [`solve`], from another first guess of p.
///
/// # Errors
/// As [`solve`].
pub fn solve_from<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let candidate = propose(generating, mu, guess);
    let Candidate { x, iterations, residual, .. } = accept(generating, mu, candidate)?;
    let p = S::Chart::default().pull_back(generating.group(), &x, mu);
    Ok(Solution { p, x, iterations, residual })
}

/// The step that the method of solution proposes from this guess of p.
pub(crate) fn propose<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> CandidateOf<S> {
    propose_scaled(generating, mu, Scalar::of(1.0), guess)
}

/// Proposes a solution for `scale`·S, as a continuation needs it.
fn propose_scaled<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: ScalarOf<S>,
    guess: VectorOf<S>,
) -> CandidateOf<S> {
    match generating.solver() {
        Solver::Newton => newton::newton(generating, mu, scale, guess),
        Solver::FixedPoint => fixed_point::fixed_point(generating, mu, scale, guess),
    }
}

impl<S: Integrator + ?Sized> Integrator for Reversed<'_, S> {
    fn solver(&self) -> Solver {
        self.0.solver()
    }
}

#[cfg(feature = "alloc")]
impl<G: LieGroup, C: Chart<G>> Integrator for crate::generating::PolynomialFunction<G, C> {}
