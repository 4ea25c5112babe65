//! Newton's method, for groups of few dimensions: the way from a first guess, whose end is estimated, and the careful way
//! of a continuation, whose end is measured.

use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};

use super::candidate::{Candidate, CandidateOf, NEAR, inverse_scale};
use super::settings::Settings;
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Newton iterations allowed before the solver gives up.
pub const MAX_ITERATIONS: u32 = 20;

/// Up to this size of a correction, relative to μ, the estimate of what Newton's method leaves is a bound
/// (tried by the program `stress`); beyond it, what is left is measured by another correction.
const TRUSTED: f64 = 1e-3;

/// The solution from this guess. A correction leaves about |μ| |δx|²/3 from the chart and |μ| |S‴ δp δp|/2 from S: what is
/// left is estimated so where the correction is short, and counts as the correction itself where it is not.
pub(super) fn newton<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let group = generating.group();
    let chart = S::Chart::default();
    let dim = group.dim();
    let of = |value| ScalarOf::<S>::of(value);
    let (inverse_scale, tolerance) = (inverse_scale(mu), settings.tolerance());
    let mut p = guess;
    let mut way = of(0.0);
    let mut iterations = 0;
    loop {
        iterations += 1;
        let (x, hessian) = generating.gradient_and_hessian(&p);
        // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
        let (pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
        let residual = p.clone().minus(&pulled);
        let correction = VectorOf::<S>::solve(&VectorOf::<S>::factor(dim, jacobian), residual);
        let shift = correction.left_multiply(&hessian);
        p = p.minus(&correction);
        // x moves linearly with p; what that leaves out is of the order of what Newton leaves.
        let x = x.minus(&shift);
        let relative = correction.largest_entry() * inverse_scale;
        let stretch = shift.largest_entry();
        let estimate = stretch * (of(0.5) * stretch + relative);
        let left = estimate.select(relative.simd_le(of(TRUSTED)), relative);
        let left = left.simd_min(relative).select(relative.simd_le(tolerance), left);
        way += relative;
        // A point far from its guess will not be accepted, nor will NaN.
        let open = left.simd_gt(tolerance) & way.simd_le(of(NEAR));
        if open.none() || iterations == MAX_ITERATIONS {
            return Candidate { x, moved: way, residual: left, iterations };
        }
    }
}

/// Corrections of the careful way at most.
const CAREFUL: u32 = 12;

/// The solution for `scale`·S from this guess, each correction with a Hessian of its own and no larger than a quarter of
/// the one before it; what is left is measured.
pub(super) fn careful<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: ScalarOf<S>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let group = generating.group();
    let chart = S::Chart::default();
    let dim = group.dim();
    let (quarter, tolerance) = (ScalarOf::<S>::of(0.25), settings.tolerance());
    let inverse_scale = inverse_scale(mu);
    // Rounding of many coordinates may stay above the tolerance: then corrections no longer shrink.
    let rounding = ScalarOf::<S>::of(2.0 * dim as f64) * ScalarOf::<S>::epsilon();
    let rounding = rounding.simd_max(tolerance);

    let mut p = guess;
    let mut way = ScalarOf::<S>::of(0.0);
    let mut previous = ScalarOf::<S>::of(f64::MAX);
    let mut iterations = 0;
    loop {
        iterations += 1;
        let (x, hessian) = generating.gradient_and_hessian(&p);
        let x = VectorOf::<S>::from_entries(dim, |i| scale * x[i]);
        let hessian = VectorOf::<S>::matrix_from_entries(dim, |i, j| scale * hessian[(i, j)]);
        // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
        let (pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        let residual = p.clone().minus(&pulled);
        let size = residual.largest_entry() * inverse_scale;
        let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
        let correction = VectorOf::<S>::solve(&VectorOf::<S>::factor(dim, jacobian), residual);
        let relative = correction.largest_entry() * inverse_scale;
        let done = size.simd_le(tolerance) & relative.simd_le(rounding)
            | size.simd_le(rounding)
                & relative.simd_le(rounding)
                & relative.simd_ge(quarter * previous);
        if done.all() {
            return Candidate { x, moved: way, residual: size.simd_min(tolerance), iterations };
        }
        let shrinks = relative.simd_le((quarter * previous).simd_max(rounding)).all();
        if !shrinks || iterations == CAREFUL {
            let residual = size.simd_max(rounding + rounding);
            return Candidate { x, moved: way + relative, residual, iterations };
        }
        way += relative;
        p = p.minus(&correction);
        previous = relative;
    }
}
