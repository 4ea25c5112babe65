//! The fixed point p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), for groups of many dimensions.

use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};

use super::candidate::{Candidate, CandidateOf, NEAR, inverse_scale};
use super::settings::Settings;
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Evaluations of the fixed point allowed before the solver gives up.
pub const MAX_EVALUATIONS: u32 = 60;

/// The solution for `scale`·S from this guess: more iterations than Newton's method, each with the gradient of S alone
/// and work linear in the dimension.
pub(super) fn fixed_point<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: ScalarOf<S>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let (group, chart) = (generating.group(), S::Chart::default());
    let dim = mu.dim();
    let (near, half) = (ScalarOf::<S>::of(NEAR), ScalarOf::<S>::of(0.5));
    let (inverse_scale, tolerance) = (inverse_scale(mu), settings.tolerance());
    // Rounding of many coordinates may stay above that: then it no longer halves.
    let rounding = ScalarOf::<S>::of((4.0 * dim as f64).min(32.0)) * ScalarOf::<S>::epsilon();

    let mut p = guess.clone();
    let mut found = Candidate {
        x: mu.clone(),
        moved: ScalarOf::<S>::of(0.0),
        residual: ScalarOf::<S>::of(1.0),
        iterations: 0,
    };
    let mut open = near.simd_le(half);
    while found.iterations < MAX_EVALUATIONS {
        found.iterations += 1;
        let x = generating.gradient(&p);
        let x = VectorOf::<S>::from_entries(dim, |i| x[i] * scale);
        let next = chart.pull_back(group, &x, mu);
        let left = next.clone().minus(&p).largest_entry() * inverse_scale;
        let moved = p.clone().minus(&guess).largest_entry() * inverse_scale;
        // Stalled at rounding is solved as well as it can be.
        let stalled = left.simd_gt(half * found.residual);
        let done = left.simd_le(rounding.simd_max(tolerance).select(stalled, tolerance));
        let left = left.simd_min(tolerance).select(done, left);
        found.x = x.select(open, &found.x);
        found.moved = moved.select(open, found.moved);
        found.residual = left.select(open, found.residual);
        // A point far from its guess will not be accepted, nor will NaN.
        open = open & !done & moved.simd_le(near) & left.simd_le(ScalarOf::<S>::of(f64::MAX));
        if open.none() {
            break;
        }
        p = next;
    }
    found
}
