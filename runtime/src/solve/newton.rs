//! Newton's method, for groups of few dimensions.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::{MAX_ITERATIONS, Solution, Solver, Yardstick, failure};
use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::scalar::Scalar;

/// Steps with the same factors, before the Hessian is taken anew.
const CHORDS: u32 = 4;

/// [`solve`](super::solve) by [`Solver::Newton`].
///
/// The first step takes a Hessian; the next ones are chord steps, which keep its factors and need
/// only the gradient. Near the solution a chord step gains as many digits as the step before it.
#[inline(always)]
pub fn newton<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let group = generating.group();
    let chart = generating.chart();
    let dim = group.dim();
    let one = ScalarOf::<S>::of(1.0);

    let yardstick = Yardstick::of(mu);
    let Yardstick { smallest, scale, inverse_scale, tolerance } = yardstick;

    let half = ScalarOf::<S>::of(0.5);
    let half_defect = half * scale * generating.hessian_defect(mu.pairing(mu).simd_sqrt());

    let mut p = guess;
    let mut solved = (p.clone(), mu.clone());
    let mut remaining = one;
    let mut iterations = 0;
    while iterations < MAX_ITERATIONS {
        let (mut x, hessian) = generating.newton_model(&p);
        let (mut pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
        let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
        let factors = VectorOf::<S>::factor(dim, jacobian);
        // How far the model of this Newton step is off, where p and x move by the steps below.
        let mut stretched = ScalarOf::<S>::of(0.0);
        let mut bent = ScalarOf::<S>::of(0.0);
        let mut previous = one;
        for chord in 0..CHORDS {
            iterations += 1;
            let residual = p.clone().minus(&pulled);
            let correction = VectorOf::<S>::solve(&factors, residual);
            let shift = correction.left_multiply(&hessian);
            let next = p.minus(&correction);
            // x moves linearly with p; what that leaves out is of the order of what Newton leaves.
            let moved = x.clone().minus(&shift);

            let relative = correction.largest_entry() * inverse_scale;
            let stretch = shift.largest_entry();
            let bend = generating.bend(x.largest_entry()) * relative;
            // A step leaves F″(step before + ½ this step, this step): about |μ| |δx|²/3 from the
            // chart, |D| |S‴ δp δp| from S with |D| ≈ |μ|/2, and, where the Hessian is not the
            // whole one, D·(Hess S − H)·δp.
            let curved = stretched + half * stretch + bent + bend;
            let bound = stretch * curved + half_defect * relative;
            let left = yardstick.left(bound, relative, (chord > 0).then_some(previous));
            previous = relative + smallest;
            let was_open = remaining.simd_gt(tolerance);
            solved = (next.clone().select(was_open, &solved.0), moved.select(was_open, &solved.1));
            remaining = left.select(was_open, remaining);
            if remaining.simd_le(tolerance).all() {
                let (p, x) = solved;
                return Ok(Solution { p, x, iterations, residual: remaining });
            }
            p = next;
            if chord + 1 < CHORDS {
                stretched += stretch;
                bent += bend + bend;
                x = generating.gradient(&p);
                pulled = chart.pull_back(group, &x, mu);
            }
        }
    }
    Err(failure(Solver::Newton, mu, iterations, remaining))
}
