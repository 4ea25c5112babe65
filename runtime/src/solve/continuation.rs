//! Following the solution from the identity: x = s·∂S/∂p((d^R τ_x)ᵀ μ), s from 0 to 1.
//!
//! At s = 0 it is x = 0, p = μ. Each stretch of s starts at the solution before it, extended by its last slope, and is
//! kept if the correction is small and the next one smaller by far, which is what the theorem of Newton and Kantorovich
//! asks of a ball in which the solution is unique (tested by the corrections themselves, not proven by bounds on the
//! second derivative), and if det(1 − s ∂p/∂x·Hess S) has kept its sign: where motions are symmetric, a solution can go
//! on through a fork without a correction. Otherwise the stretch is halved, and given up below [`SHORTEST`].

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::candidate::{CandidateOf, NEAR};
use super::{Integrator, Settings, propose_scaled};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Hessians and determinants are taken up to this dimension.
pub(super) const LARGEST: usize = 32;

/// The first stretch of s, and the longest.
const LONGEST: f64 = 0.25;
/// The shortest stretch that is tried.
const SHORTEST: f64 = 1.0 / 1024.0;

/// The solution for μ, or the s beyond which it could not be followed.
pub(super) fn follow<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
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
        let found = propose_scaled(generating, mu, scale, guess, settings);
        iterations += found.iterations;
        let near = found.moved.simd_le(ScalarOf::<S>::of(NEAR)).all();
        let solved = near && found.residual.simd_le(settings.tolerance()).all();
        if solved && keeps_orientation(generating, mu, &found.x, scale) {
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

/// Whether det(1 − s ∂p/∂x·Hess S) is positive at the x of a solution for s·S, as it is at s = 0; not asked beyond
/// [`LARGEST`] dimensions.
fn keeps_orientation<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
    scale: ScalarOf<S>,
) -> bool {
    let dim = mu.dim();
    if dim > LARGEST {
        return true;
    }
    let (p, derivative) = S::Chart::default().pull_back_with_derivative(generating.group(), x, mu);
    let hessian = generating.gradient_and_hessian(&p).1;
    let hessian = VectorOf::<S>::matrix_from_entries(dim, |i, j| scale * hessian[(i, j)]);
    has_positive_determinant::<S>(dim, VectorOf::<S>::one_minus_product(dim, &derivative, &hessian))
}

/// By elimination with pivots, of one lane.
fn has_positive_determinant<S: GeneratingFunction + ?Sized>(
    dim: usize,
    mut matrix: MatrixOf<S>,
) -> bool {
    let mut positive = true;
    for k in 0..dim {
        let size = |matrix: &MatrixOf<S>, i: usize| matrix[(i, k)].simd_abs().largest_lane();
        let mut pivot = k;
        for i in k + 1..dim {
            if size(&matrix, i) > size(&matrix, pivot) {
                pivot = i;
            }
        }
        if pivot != k {
            positive = !positive;
            for j in k..dim {
                let entry = matrix[(k, j)];
                matrix[(k, j)] = matrix[(pivot, j)];
                matrix[(pivot, j)] = entry;
            }
        }
        let top = matrix[(k, k)];
        let value = top.largest_lane();
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        positive ^= value < 0.0;
        for i in k + 1..dim {
            let factor = matrix[(i, k)] / top;
            for j in k + 1..dim {
                let change = factor * matrix[(k, j)];
                matrix[(i, j)] -= change;
            }
        }
    }
    positive
}
