//! Newton's method, for groups of few dimensions.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::{MAX_ITERATIONS, Solution, Solver, failure};
use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::scalar::Scalar;

/// [`solve`](super::solve) by [`Solver::Newton`].
#[inline(always)]
pub fn newton<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<Solution<VectorOf<S>, ScalarOf<S>>, StepError> {
    let group = generating.group();
    let chart = generating.chart();
    let dim = group.dim();
    let one = ScalarOf::<S>::of(1.0);

    // The smallest positive scale keeps μ = 0 (whose solution is p = 0) from dividing 0 by 0.
    let scale = mu.largest_entry() + ScalarOf::<S>::of(f64::from(f32::MIN_POSITIVE));
    let inverse_scale = one / scale;
    let tolerance = ScalarOf::<S>::of(4.0) * ScalarOf::<S>::epsilon();

    let half = ScalarOf::<S>::of(0.5);
    let half_defect = half * scale * generating.hessian_defect(mu.pairing(mu).simd_sqrt());

    let mut p = generating.predict(mu);
    let mut solved = (p.clone(), mu.clone());
    let mut remaining = one;
    let mut iterations = 0;
    while iterations < MAX_ITERATIONS {
        iterations += 1;
        let (x, hessian) = generating.newton_model(&p);
        let (pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
        let jacobian = VectorOf::<S>::matrix_from_entries(dim, |i, j| {
            let mut sum = derivative[(i, 0)] * hessian[(0, j)];
            for k in 1..dim {
                sum = derivative[(i, k)].times_plus(hessian[(k, j)], sum);
            }
            if i == j { one - sum } else { -sum }
        });
        let residual = VectorOf::<S>::from_entries(dim, |i| p[i] - pulled[i]);
        let correction = VectorOf::<S>::solve(jacobian, residual);
        let shift = correction.left_multiply(&hessian);
        let next = VectorOf::<S>::from_entries(dim, |i| p[i] - correction[i]);
        // x moves linearly with p; what that leaves out is of the order of what Newton leaves.
        let moved = VectorOf::<S>::from_entries(dim, |i| x[i] - shift[i]);

        let relative = correction.largest_entry() * inverse_scale;
        let stretch = shift.largest_entry();
        // Newton leaves ½F″(δp, δp): about |μ| |δx|²/6 from the chart, ½|D| |S‴ δp δp| from S with
        // |D| ≈ |μ|/2, and, where the Hessian is not the whole one, D·(Hess S − H)·δp.
        let bend = generating.bend(x.largest_entry());
        let left = stretch * (half * stretch + bend * relative) + half_defect * relative;
        let was_open = remaining.simd_gt(tolerance);
        solved = (
            VectorOf::<S>::from_entries(dim, |i| next[i].select(was_open, solved.0[i])),
            VectorOf::<S>::from_entries(dim, |i| moved[i].select(was_open, solved.1[i])),
        );
        remaining = left.select(was_open, remaining);
        if remaining.simd_le(tolerance).all() {
            let (p, x) = solved;
            return Ok(Solution { p, x, iterations, residual: remaining });
        }
        p = next;
    }
    Err(failure(Solver::Newton, mu, iterations, remaining))
}
