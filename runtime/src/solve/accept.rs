//! Accepting a step: the one place that says which candidate is right.
//!
//! A candidate is right if it is solved and near its first guess, if no fold or fork can lie between it and the identity,
//! and if it lies in the domain: of the chart, and of a series that converges. One that may be the solution of another
//! branch is not taken: the solution is then followed from the identity.

use coadjoint_program::limits::{LARGEST_RATIO, NEAR, RATE_OF_HALF_TURN};
use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use crate::chart::{Chart, columns};
use crate::error::{Circumstances, StepError};
use crate::generating::{ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::solve::candidate::{Branch, CandidateOf, sized};
use crate::solve::continuation::follow;
use crate::solve::{Integrator, Solver};

/// The candidate if it is right, or the solution followed from the identity. Lanes are only accepted as they are: others
/// have to be tried again one by one.
pub(crate) fn accept<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: CandidateOf<S>,
) -> Result<CandidateOf<S>, StepError> {
    if (0..mu.dim()).any(|i| !mu[i].all_finite()) {
        return Err(StepError::NonFiniteState);
    }
    if candidate.is_solution_within(NEAR) {
        check_domain(generating, mu, &candidate)?;
        if candidate.branch == Branch::Only {
            return Ok(candidate);
        }
    }
    if <ScalarOf<S> as SimdValue>::LANES > 1 {
        let (iterations, residual) = (candidate.iterations, candidate.residual.largest_lane());
        let not_solved = |at| StepError::NotConverged { iterations, residual, at };
        return Err(refuse(generating, mu, &candidate, not_solved));
    }
    let followed = follow(generating, mu).map_err(|reached| {
        let not_followed = |at| StepError::NotFollowed { reached, at };
        let outside = check_chart(generating, mu, &candidate).err();
        outside.unwrap_or_else(|| refuse(generating, mu, &candidate, not_followed))
    })?;
    check_domain(generating, mu, &followed)?;
    Ok(followed)
}

/// Checks that x lies in the chart, and p where the series converges.
fn check_domain<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: &CandidateOf<S>,
) -> Result<(), StepError> {
    check_chart(generating, mu, candidate)?;
    let p = S::Chart::default().pull_back(generating.group(), &candidate.x, mu);
    // Of the ratio at p and the bound for all momenta as long as μ the smaller counts.
    let radius = generating.radius();
    let own = sized(generating, mu);
    let within = own.pairing(&own).simd_le(radius * radius);
    let of_terms = ScalarOf::<S>::of(0.0).select(within, generating.series_ratio(&p));
    let ratio = of_terms.worse(estimated_ratio(generating, mu, &candidate.x));
    if !ratio.simd_le(ScalarOf::<S>::of(LARGEST_RATIO)).all() {
        return Err(refuse(generating, mu, candidate, |at| StepError::SeriesDiverges { at }));
    }
    Ok(())
}

/// Checks that x lies in the chart.
fn check_chart<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: &CandidateOf<S>,
) -> Result<(), StepError> {
    let extent = S::Chart::default().extent(generating.group(), &candidate.x);
    if extent.simd_le(ScalarOf::<S>::of(1.0)).all() {
        return Ok(());
    }
    let extent = extent.simd_sqrt().largest_lane();
    Err(refuse(generating, mu, candidate, |at| StepError::OutsideChart { extent, at }))
}

#[cold]
fn refuse<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    candidate: &CandidateOf<S>,
    error: impl FnOnce(Circumstances) -> StepError,
) -> StepError {
    let estimated = estimated_ratio(generating, mu, &candidate.x);
    let ratio = generating.series_ratio(mu).worse(estimated).largest_lane();
    error(Circumstances { x: candidate.x.largest_entry().largest_lane(), ratio, usable_step: None })
}

/// The ratio of terms that the rate at x stands for: up to [`LARGEST_RATIO`] where the rate is at most
/// [`largest_rate`](crate::GeneratingFunction::largest_rate), zero where that is unbounded.
pub fn estimated_ratio<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
) -> ScalarOf<S> {
    let largest = generating.largest_rate();
    if largest >= f64::MAX {
        return ScalarOf::<S>::of(0.0);
    }
    let square = match generating.solver() {
        Solver::Newton => square_of_rate(generating, mu, x),
        Solver::FixedPoint => {
            let half_turn = ScalarOf::<S>::of(RATE_OF_HALF_TURN * RATE_OF_HALF_TURN);
            half_turn * S::Chart::default().extent(generating.group(), x)
        }
    };
    square.simd_sqrt() * ScalarOf::<S>::of(LARGEST_RATIO / largest)
}

/// maxᵢ Σⱼ |ZᵢⱼZⱼᵢ| of Z = ad_xᵀ + 2 ∂p/∂x·Hess S.
fn square_of_rate<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    x: &VectorOf<S>,
) -> ScalarOf<S> {
    let (group, dim) = (generating.group(), mu.dim());
    let (p, derivative) = S::Chart::default().pull_back_with_derivative(group, x, mu);
    let (_, hessian) = generating.gradient_and_hessian(&p);
    let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
    let [zero, one, two] = [0.0, 1.0, 2.0].map(ScalarOf::<S>::of);
    let turned = columns::<S::Group>(dim, |unit| group.ad_star(x, unit));
    let z = VectorOf::<S>::matrix_from_entries(dim, |i, j| {
        let identity = if i == j { one } else { zero };
        turned[(i, j)] + two * (identity - jacobian[(i, j)])
    });
    (0..dim).fold(zero, |largest, i| {
        let row = (0..dim).fold(zero, |sum, j| sum + (z[(i, j)] * z[(j, i)]).simd_abs());
        largest.worse(row)
    })
}
