//! Newton's method, for groups of few dimensions.

use nalgebra::{SimdBool, SimdPartialOrd};

use super::{Candidate, CandidateOf, Settings, inverse_scale};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Newton iterations allowed before the solver gives up.
pub const MAX_ITERATIONS: u32 = 12;

/// The solution for `scale`·S from this guess, each correction with a Hessian of its own and no larger than a quarter of
/// the one before it; what is left is measured.
pub(super) fn newton<S: GeneratingFunction + ?Sized>(
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
        if !shrinks || iterations == MAX_ITERATIONS {
            let residual = size.simd_max(rounding + rounding);
            return Candidate { x, moved: way + relative, residual, iterations };
        }
        way += relative;
        p = p.minus(&correction);
        previous = relative;
    }
}
