//! Following the solution from the identity: x = s·∂S/∂p((d^R τ_x)ᵀ μ), s from 0 to 1.
//!
//! At s = 0 it is x = 0, p = μ. Each stretch of s starts at the solution before it, extended by its last slope, and is
//! kept if the correction is small and the next one smaller by far, which is what the theorem of Newton and Kantorovich
//! asks of a ball in which the solution is unique (tested by the corrections themselves, not proven by bounds on the
//! second derivative), and if det(1 − s ∂p/∂x·Hess S) has kept its sign in each direct factor of the group: where motions
//! are symmetric, a solution can go on through a fork without a correction. Otherwise the stretch is halved, and given up
//! below [`SHORTEST`].

use super::candidate::{Branch, CandidateOf};
use super::{Integrator, propose_scaled};
use crate::chart::Chart;
use crate::generating::{ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// The first stretch of s, and the longest.
const LONGEST: f64 = 0.25;
/// The shortest stretch that is tried.
const SHORTEST: f64 = 1.0 / 1024.0;
/// The farthest from its extension that a solution is taken, relative to the largest coordinate of μ.
const CORRECTED: f64 = 0.01;

/// The solution for μ, or the s beyond which it could not be followed.
pub(super) fn follow<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<CandidateOf<S>, f64> {
    let dim = mu.dim();
    let (group, chart) = (generating.group(), S::Chart::default());
    let (mut reached, mut stretch) = (0.0, LONGEST);
    let (mut p, mut slope) = (mu.clone(), VectorOf::<S>::zeros(dim));
    let mut iterations = 0;
    loop {
        let next = f64::min(reached + stretch, 1.0);
        let way = ScalarOf::<S>::of(next - reached);
        let guess = VectorOf::<S>::from_entries(dim, |i| slope[i].times_plus(way, p[i]));
        let scale = ScalarOf::<S>::of(next);
        let found = propose_scaled(generating, mu, scale, guess);
        iterations += found.iterations;
        if found.branch != Branch::Bent && found.is_solution_within(CORRECTED) {
            if next >= 1.0 {
                return Ok(CandidateOf::<S> { iterations, ..found });
            }
            let end = chart.pull_back(group, &found.x, mu);
            slope = VectorOf::<S>::from_entries(dim, |i| (end[i] - p[i]) / way);
            (p, reached) = (end, next);
            stretch = f64::min(2.0 * stretch, LONGEST);
        } else {
            stretch *= 0.5;
            if stretch < SHORTEST {
                return Err(reached);
            }
        }
    }
}
