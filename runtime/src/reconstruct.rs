//! From a generating function to maps: Poisson on 𝔤\*, symplectic on T\*G.

use nalgebra::SimdPartialOrd;

use crate::chart::Chart;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::phase::Phase;
use crate::scalar::Scalar;
use crate::solve::{solve, solve_after};

/// How the solve of one step went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport<T> {
    /// Newton iterations, or evaluations of the fixed point.
    pub iterations: u32,
    /// An estimate of the residual left in J_L(x, p) = μ, relative to the largest coordinate of μ.
    pub residual: T,
}

/// The Poisson map μ′ → μ″ = Ad\*_{τ(x)⁻¹} μ′ of 𝔤\* that `generating` induces.
///
/// The momentum moves by the group action, so Casimirs are kept whatever residual the solve
/// leaves.
///
/// # Errors
/// As [`solve`].
#[inline(always)]
pub fn poisson_map<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<VectorOf<S>, StepError> {
    let solution = solve(generating, mu)?;
    Ok(generating.chart().transport(generating.group(), &solution.x, mu).1)
}

/// Advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′): Algorithm 1 of the paper. Symplectic,
/// G-equivariant, and J_L-preserving.
///
/// # Errors
/// As [`solve`]; `phase` is then left as it was.
#[inline(always)]
pub fn advance<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    advance_after(generating, phase, &mut None)
}

/// [`advance`], where `last` is the p of the step before, if there was one, and becomes that of this
/// step.
#[inline(always)]
pub(crate) fn advance_after<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    last: &mut Option<VectorOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let mu = &phase.momentum;
    let solution = solve_after(generating, mu, last.as_ref())?;
    reconstruct(generating, phase, &solution.x);
    *last = Some(solution.p);
    Ok(StepReport { iterations: solution.iterations, residual: solution.residual })
}

/// Many steps of [`advance`], and faster than one by one: each step takes its first guess from the
/// one before ([`GeneratingFunction::predict_after`]), and what steps read of `generating` is
/// prepared once. The report holds the largest number of iterations and the largest residual of a
/// step; no step, none.
///
/// # Errors
/// As [`solve`]; `phase` is then left before the step that failed.
// Not inlined: beside code that might write to `generating`, nothing can be prepared.
#[inline(never)]
pub fn advance_by<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    let mut last = None;
    for _ in 0..steps {
        let StepReport { iterations, residual } = advance_after(generating, phase, &mut last)?;
        worst.iterations = worst.iterations.max(iterations);
        worst.residual = worst.residual.simd_max(residual);
    }
    Ok(worst)
}

/// The second half of [`advance`]: advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′) with the x that
/// [`solve`] has found for μ′.
#[inline(always)]
pub fn reconstruct<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    x: &VectorOf<S>,
) {
    let group = generating.group();
    let (increment, momentum) = generating.chart().transport(group, x, &phase.momentum);
    phase.group_element = group.compose(&phase.group_element, &increment);
    phase.momentum = momentum;
}
