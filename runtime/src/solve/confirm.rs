//! Confirming, out of the way of what is fast, a solution of a momentum so large that bounds on the series say nothing:
//! estimates are then measured, and being near the first guess is not enough.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::continuation::{LARGEST, follow};
use super::{CandidateOf, Integrator, Settings, propose_scaled};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Solutions nearer than this, relative to the largest coordinate of x, are the same.
const SAME: f64 = 1e-6;

/// The findings at x: p = (d^R τ_x)ᵀ μ, whether x = ∂S(p) to rounding and the tolerance, and whether
/// ‖∂p/∂x·Hess S‖ < 1, so that s ∂S∘p has no fold or fork at x for any s from 0 to 1.
struct Findings<S: GeneratingFunction + ?Sized> {
    p: VectorOf<S>,
    exact: bool,
    contracts: bool,
}

fn examine<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Findings<S> {
    let dim = mu.dim();
    let (p, derivative) = S::Chart::default().pull_back_with_derivative(generating.group(), x, mu);
    let (gradient, hessian) = generating.gradient_and_hessian(&p);
    let rounding = ScalarOf::<S>::of(dim as f64) * ScalarOf::<S>::epsilon() + settings.tolerance();
    let momenta = p.largest_entry() + mu.largest_entry();
    let allowed = rounding * (x.largest_entry() + row_sums::<S>(dim, &hessian) * momenta);
    let left = gradient.minus(x).largest_entry();
    let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
    let one = ScalarOf::<S>::of(1.0);
    let product = VectorOf::<S>::matrix_from_entries(dim, |i, j| {
        if i == j { one - jacobian[(i, j)] } else { -jacobian[(i, j)] }
    });
    let (exact, contracts) = (left.simd_le(allowed), row_sums::<S>(dim, &product).simd_lt(one));
    Findings { p, exact: exact.all(), contracts: contracts.all() }
}

/// The largest sum of a row's absolute entries.
fn row_sums<S: GeneratingFunction + ?Sized>(dim: usize, matrix: &MatrixOf<S>) -> ScalarOf<S> {
    let row = |i| (0..dim).fold(ScalarOf::<S>::of(0.0), |sum, j| sum + matrix[(i, j)].simd_abs());
    (1..dim).fold(row(0), |largest, i| largest.worse(row(i)))
}

/// The candidate, made more exact where it was not, if it is the solution continued from the identity; else the s up to
/// which that could be followed. Lanes are confirmed only where nothing is to be done: others have to be tried one by
/// one.
pub(super) fn confirm<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<CandidateOf<S>, f64> {
    if mu.dim() > LARGEST {
        return Ok(candidate);
    }
    let Findings { p, exact, contracts } = examine(generating, mu, &candidate.x, settings);
    if exact && contracts {
        return Ok(candidate);
    }
    if <ScalarOf<S> as SimdValue>::LANES > 1 {
        return Err(0.0);
    }
    if contracts {
        let one = ScalarOf::<S>::of(1.0);
        let refined = propose_scaled(generating, mu, one, p, settings);
        if refined.residual.simd_le(settings.tolerance()).all() {
            let moved = candidate.moved + refined.moved;
            return Ok(CandidateOf::<S> { moved, ..refined });
        }
    }
    let followed = follow(generating, mu, settings)?;
    let apart = followed.x.clone().minus(&candidate.x).largest_entry();
    let same = ScalarOf::<S>::of(SAME) + ScalarOf::<S>::of(100.0) * settings.tolerance();
    match apart.simd_le(same * followed.x.largest_entry()).all() {
        true if exact => Ok(candidate),
        true => Ok(followed),
        false => Err(1.0),
    }
}
