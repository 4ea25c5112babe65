//! From a generating function to maps: Poisson on 𝔤\*, symplectic on T\*G.

pub(crate) mod kicked;
pub(crate) mod monitor;
pub(crate) mod numbers;
pub(crate) mod printed;

use nalgebra::{SimdBool, SimdPartialOrd};

use crate::chart::Chart;
use crate::error::{StepError, Stopped};
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::solve::{Candidate, Integrator, accept, propose};

/// Statistics of the solve of one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport<T> {
    /// Newton iterations, or evaluations of the fixed point.
    pub iterations: u32,
    /// A bound on the residual left in J_L(x, p) = μ, relative to the largest coordinate of μ.
    pub residual: T,
}

/// The Poisson map μ′ → μ″ = Ad\*_{τ(x)⁻¹} μ′ of 𝔤\* that `generating` induces, with the
/// motion of the frame where that is a comoving one ([`GeneratingFunction::frame`]).
///
/// The momentum moves by the group action, so Casimirs are kept whatever residual the solve
/// leaves.
///
/// # Errors
/// [`StepError`].
#[inline]
pub fn poisson_map<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<VectorOf<S>, StepError> {
    let mut phase = Phase { group_element: generating.group().identity(), momentum: mu.clone() };
    advance(generating, &mut phase)?;
    Ok(phase.momentum)
}

/// Advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′): Algorithm 1 of the paper. Symplectic,
/// G-equivariant, and J_L-preserving. A comoving frame moves on after it
/// ([`GeneratingFunction::frame`]).
///
/// # Errors
/// [`StepError`]; `phase` is then left as it was.
#[inline(always)]
pub fn advance<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let driven = generating.drive(phase, 1);
    if driven.steps == 1 {
        return Ok(StepReport { iterations: driven.iterations, residual: driven.residual });
    }
    refused(generating, phase)
}

/// The step that programs have refused, made anew: every step would have to keep its candidate in memory to hand it on.
#[cold]
fn refused<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    advance_by(generating, phase, 1).map_err(|stopped| stopped.error)
}

/// Many steps of [`advance`], faster than one by one: a comoving frame moves on, and the state is checked, for many at
/// once. The report holds the largest number of iterations and the largest residual of a step.
///
/// # Errors
/// [`Stopped`]: how many steps were made, and why the next one was not; `phase` is then the state before that.
// Not inlined: what steps read of `generating` is prepared once, where nothing beside it might write there.
#[inline(never)]
pub fn advance_by<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    let mut note = |iterations: u32, residual: ScalarOf<S>| {
        worst.iterations = worst.iterations.max(iterations);
        worst.residual = worst.residual.simd_max(residual);
    };
    let mut done = 0;
    while done < steps {
        let driven = generating.drive(phase, steps - done);
        done += driven.steps;
        note(driven.iterations, driven.residual);
        if done < steps {
            let report = by_hand(generating, phase, driven.refused)
                .map_err(|error| Stopped { steps: done, error })?;
            note(report.iterations, report.residual);
            done += 1;
        }
    }
    Ok(worst)
}

/// One step without programs, or from the x that programs have found and refused, and its distance from their guess.
#[cold]
#[inline(never)]
fn by_hand<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    refused: Option<(VectorOf<S>, ScalarOf<S>)>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let mu = &phase.momentum;
    let (guess, distance) = match refused {
        Some((x, distance)) => {
            (S::Chart::default().pull_back(generating.group(), &x, mu), distance)
        }
        None => (generating.predict(mu), ScalarOf::<S>::of(0.0)),
    };
    let mut candidate = propose(generating, mu, guess);
    candidate.moved += distance;
    let Candidate { x, iterations, residual, .. } = accept(generating, mu, candidate)?;
    reconstruct(generating, phase, &x)?;
    Ok(StepReport { iterations, residual })
}

/// The second half of [`advance`]: advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′) with the x that
/// [`solve`](crate::solve::solve) has found for μ′, and moves a comoving frame on.
///
/// # Errors
/// [`StepError::OffGroup`] and [`StepError::Overflow`]; `phase` is then left as it was.
pub fn reconstruct<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    x: &VectorOf<S>,
) -> Result<(), StepError> {
    let group = generating.group();
    let mut next = phase.clone();
    let (increment, moved) = S::Chart::default().transport(group, x, &next.momentum);
    move_by(group, &mut next, &increment, moved);
    let mut motion = 0;
    while let Some(y) = generating.frame(motion, &next.momentum) {
        let (increment, moved) = group.exp_transport(&y, &next.momentum);
        move_by(group, &mut next, &increment, moved);
        motion += 1;
    }
    check(group, &next)?;
    *phase = next;
    Ok(())
}

/// (g, μ) ↦ (g·k, Ad\*_{k⁻¹} μ), given both k and the moved momentum.
fn move_by<G: LieGroup>(group: &G, phase: &mut Phase<G>, k: &G::Element, moved: G::Vector) {
    phase.group_element = group.compose(&phase.group_element, k);
    phase.momentum = moved;
}

/// Zero where all coordinates are finite, else NaN.
fn finite_or_nan<T: Scalar, V: Coordinates<T>>(mu: &V) -> T {
    let mut sum = T::of(0.0);
    for i in 0..mu.dim() {
        sum = mu[i].times_plus(T::of(0.0), sum);
    }
    sum
}

/// The largest distance of a group element from the group, in units of √rounding: products keep it at rounding.
const OFF_GROUP: f64 = 1.0;

/// Checks that a state is finite, and its group element on the group.
pub(crate) fn check<G: LieGroup>(group: &G, phase: &Phase<G>) -> Result<(), StepError> {
    let defect = group.element_defect(&phase.group_element) + finite_or_nan(&phase.momentum);
    match defect.simd_le(largest_defect()).all() {
        true => Ok(()),
        false => Err(unsound(group, phase)),
    }
}

/// The largest [`LieGroup::element_defect`] of a state that is accepted: the square root of rounding.
fn largest_defect<T: Scalar>() -> T {
    // Of rounding in the scalar, not in its lanes' type.
    T::of(OFF_GROUP) * T::epsilon().simd_sqrt()
}

fn unsound<G: LieGroup>(group: &G, phase: &Phase<G>) -> StepError {
    if !finite_or_nan(&phase.momentum).simd_le(G::Scalar::of(0.0)).all() {
        return StepError::Overflow;
    }
    StepError::OffGroup { defect: group.element_defect(&phase.group_element).largest_lane() }
}
