//! The fixed point p = (d^R τ_x)ᵀ μ, x = ∂S/∂p(p), for groups of many dimensions.

use coadjoint_program::limits::NEAR;
use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};

use super::candidate::{Branch, Candidate, CandidateOf, inverse_scale, rounding, sized};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// Evaluations of the fixed point allowed before the solver gives up.
const MAX_EVALUATIONS: u32 = 60;

/// The distance from the guess at which iterations start, relative to the largest coordinate of μ: where motions are
/// symmetric the guess may be exact, also beyond a fork.
const DISTURBANCE: f64 = 1e-6;

/// The solution for `scale`·S from this guess: more iterations than Newton's method, each with the gradient of S alone
/// and work linear in the dimension. That they converge says that ∂p/∂x·Hess S contracts.
pub(super) fn fixed_point<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: ScalarOf<S>,
    guess: VectorOf<S>,
) -> CandidateOf<S> {
    let (group, chart, dim) = (generating.group(), S::Chart::default(), mu.dim());
    let (near, zero) = (ScalarOf::<S>::of(NEAR), ScalarOf::<S>::of(0.0));
    let (inverse_scale, rounding) = (inverse_scale(generating, mu), rounding(generating));

    let disturbance = ScalarOf::<S>::of(DISTURBANCE) / inverse_scale;
    let mut p = VectorOf::<S>::from_entries(dim, |i| {
        let share = [1.0, -0.7, 0.4][i % 3];
        disturbance.times_plus(ScalarOf::<S>::of(share / generating.unit(i)), guess[i])
    });
    let mut found = Candidate {
        x: mu.clone(),
        moved: zero,
        residual: ScalarOf::<S>::of(1.0),
        branch: Branch::Unknown,
        iterations: 0,
    };
    let mut open = zero.simd_le(near);
    while found.iterations < MAX_EVALUATIONS {
        found.iterations += 1;
        let x = generating.gradient(&p);
        let x = VectorOf::<S>::from_entries(dim, |i| x[i] * scale);
        let next = chart.pull_back(group, &x, mu);
        let size = |change: &_| sized(generating, change).largest_entry() * inverse_scale;
        let left = size(&next.clone().minus(&p));
        let moved = size(&p.clone().minus(&guess));
        found.x = x.select(open, &found.x);
        found.moved = moved.select(open, found.moved);
        found.residual = left.select(open, found.residual);
        // A point far from its guess will not be accepted, nor will NaN.
        open = open & left.simd_gt(rounding) & moved.simd_le(near);
        if open.none() {
            break;
        }
        p = next;
    }
    if found.residual.simd_le(rounding).all() {
        found.branch = Branch::Only;
    }
    found
}
