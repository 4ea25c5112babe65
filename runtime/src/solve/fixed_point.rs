//! The fixed point p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), for groups of many dimensions.

use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};

use super::{Candidate, CandidateOf, Method, NEAR, Predict, Settings, Yardstick};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Evaluations of the fixed point allowed before the solver gives up.
pub const MAX_EVALUATIONS: u32 = 60;

/// The fixed point: more iterations than Newton's method, each with the gradient of S alone and work linear in the
/// dimension. Contracts for about h|Ω| < 1.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint;

impl<S: Predict + ?Sized> Method<S> for FixedPoint {
    #[inline(always)]
    fn begin(_: &S) -> Self {
        Self
    }

    #[inline(always)]
    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        _left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        fixed_point(generating, mu, None, generating.predict(mu), settings)
    }

    #[inline(always)]
    fn forget(&mut self) {}

    #[inline(always)]
    fn propose_from(
        generating: &S,
        mu: &VectorOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        fixed_point(generating, mu, None, guess, settings)
    }

    fn propose_scaled(
        generating: &S,
        mu: &VectorOf<S>,
        scale: ScalarOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        fixed_point(generating, mu, Some(scale), guess, settings)
    }
}

/// A step by the fixed point from this guess, of a multiple of S where a scale is given.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fixed_point<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: Option<ScalarOf<S>>,
    guess: VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    let (group, chart) = (generating.group(), S::Chart::default());
    let dim = mu.dim();
    let (zero, one) = (ScalarOf::<S>::of(0.0), ScalarOf::<S>::of(1.0));
    let near = ScalarOf::<S>::of(NEAR);

    let Yardstick { inverse_scale, tolerance, .. } = Yardstick::of(mu, settings);
    // Rounding of many coordinates may stay above that: then it no longer halves.
    let rounding = ScalarOf::<S>::of((4.0 * dim as f64).min(32.0)) * ScalarOf::<S>::epsilon();
    let half = ScalarOf::<S>::of(0.5);

    let mut p = guess.clone();
    let mut x_solved = mu.clone();
    let mut remaining = one;
    let mut way = zero;
    // 1 in lanes that go on, 0 in those that are done.
    let mut open = one;
    let mut iterations = 0;
    for iteration in 0..MAX_EVALUATIONS {
        iterations = iteration + 1;
        let mut x = generating.gradient(&p);
        if let Some(scale) = scale {
            x = VectorOf::<S>::from_entries(dim, |i| x[i] * scale);
        }
        let next = chart.pull_back(group, &x, mu);

        let left = next.clone().minus(&p).largest_entry() * inverse_scale;
        let gone = p.clone().minus(&guess).largest_entry() * inverse_scale;
        let was_open = open.simd_gt(half);
        x_solved = x.select(was_open, &x_solved);
        way = gone.select(was_open, way);
        let stalled = left.simd_gt(half * remaining);
        let enough = rounding.simd_max(tolerance).select(stalled, tolerance);
        // Stalled at rounding is solved as well as it can be.
        let done = left.simd_le(enough);
        let left = left.simd_min(tolerance).select(done, left);
        // What is far from its guess is not going to be accepted; what is not a number neither.
        let goes_on = gone.simd_le(near) & left.simd_le(ScalarOf::<S>::of(f64::MAX));
        open = zero.select(done, open.select(goes_on, zero));
        remaining = left.select(was_open, remaining);
        if open.simd_le(half).all() {
            break;
        }
        p = next;
    }
    Candidate { x: x_solved, moved: way, residual: remaining, iterations }
}
