//! From a generating function to maps: Poisson on 𝔤\*, symplectic on T\*G.

mod frame;
pub(crate) mod kicked;
mod march;
pub(crate) mod monitor;
mod moves;
pub(crate) mod phase;
pub(crate) mod splitting;

#[cfg(feature = "ensemble")]
pub(crate) use march::{STEPS_PER_BLOCK, block};

use nalgebra::{SimdBool, SimdPartialOrd};

use self::frame::move_frame;
use self::march::march;
use self::moves::{Momentum, Moves, finite_or_nan};
use self::phase::Phase;
use crate::chart::Chart;
use crate::error::{StepError, Stopped};
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::number::scalar::Scalar;
use crate::solve::{CandidateOf, Integrator, Method, Settings, is_right, rescue};

/// How the solve of one step went.
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
#[inline(always)]
pub fn poisson_map<S: Integrator + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<VectorOf<S>, StepError> {
    let mut moved = Momentum::<S::Group>(mu.clone());
    single(generating, &mut moved, Settings::default())?;
    Ok(moved.0)
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
    advance_with(generating, phase, Settings::default())
}

/// As [`advance`], with settings of one's own.
///
/// # Errors
/// As [`advance`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn advance_with<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    single(generating, phase, settings)
}

/// Many steps of [`advance`], and faster than one by one: each step takes its first guess from the
/// one before ([`Predict::predict_after`](crate::solve::Predict::predict_after)), or several are solved at once
/// ([`BlockNewton`](crate::solve::BlockNewton)), a comoving frame moves on for many at once,
/// and what steps read of `generating` is prepared once. The report holds the largest number of
/// iterations and the largest residual of a step; no step, none.
///
/// # Errors
/// [`Stopped`]: how many steps were made, and why the next one was not; `phase` is then the state before that.
// Not inlined: beside code that might write to `generating`, nothing can be prepared.
#[inline(never)]
pub fn advance_by<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    march(generating, phase, steps, Settings::default())
}

/// As [`advance_by`], with settings of one's own.
///
/// # Errors
/// As [`advance_by`].
#[inline(never)]
pub fn advance_by_with<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    march(generating, phase, steps, settings)
}

/// One step of whatever moves; it is left as it was where there is none.
#[cfg_attr(not(debug_assertions), inline(always))]
fn single<S: Integrator + ?Sized, M: Moves<S::Group>>(
    generating: &S,
    state: &mut M,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let mut method = S::Method::begin(generating);
    let candidate = method.propose(generating, state.momentum(), 1, settings);
    if is_right(generating, state.momentum(), &candidate, settings) {
        return complete(generating, state, &candidate);
    }
    // A copy, so that a state that steps in a loop go from can stay in registers.
    let mut next = state.clone();
    let report = generating.apart(|s| rescued(s, &mut next, candidate, settings))?;
    *state = next;
    Ok(report)
}

/// The same for a candidate that is not right.
#[cold]
#[inline(never)]
fn rescued<S: Integrator + ?Sized, M: Moves<S::Group>>(
    generating: &S,
    state: &mut M,
    candidate: CandidateOf<S>,
    settings: Settings<ScalarOf<S>>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let candidate = rescue(generating, state.momentum(), candidate, settings)?;
    complete(generating, state, &candidate)
}

/// Moves a state by an accepted step, and checks what comes of it.
#[cfg_attr(not(debug_assertions), inline(always))]
fn complete<S: Integrator + ?Sized, M: Moves<S::Group>>(
    generating: &S,
    state: &mut M,
    candidate: &CandidateOf<S>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let mut next = state.clone();
    displace(generating, &mut next, &candidate.x);
    move_frame(generating, &mut next, 1);
    next.check(generating.group())?;
    *state = next;
    Ok(StepReport { iterations: candidate.iterations, residual: candidate.residual })
}

/// The second half of [`advance`]: advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′) with the x that
/// [`solve`](crate::solve::solve) has found for μ′, and moves a comoving frame on.
///
/// # Errors
/// [`StepError::OffGroup`] and [`StepError::Overflow`]; `phase` is then left as it was.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn reconstruct<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    x: &VectorOf<S>,
) -> Result<(), StepError> {
    let mut next = phase.clone();
    displace(generating, &mut next, x);
    move_frame(generating, &mut next, 1);
    check(generating.group(), &next)?;
    *phase = next;
    Ok(())
}

/// (g, μ) ↦ (g·τ(x), Ad\*_{τ(x)⁻¹} μ).
#[inline(always)]
fn displace<S: GeneratingFunction + ?Sized, M: Moves<S::Group>>(
    generating: &S,
    state: &mut M,
    x: &VectorOf<S>,
) {
    let group = generating.group();
    let (increment, moved) = S::Chart::default().transport(group, x, state.momentum());
    state.move_by(group, &increment, moved);
}

/// How far a group element may be from the group, in units of √rounding: products keep it at rounding.
const OFF_GROUP: f64 = 1.0;

/// Whether a state is finite, and its group element on the group.
///
/// # Errors
/// What is wrong with it.
#[inline(always)]
fn check<G: LieGroup>(group: &G, phase: &Phase<G>) -> Result<(), StepError> {
    let defect = group.element_defect(&phase.group_element) + finite_or_nan(&phase.momentum);
    match defect.simd_le(largest_defect()).all() {
        true => Ok(()),
        // A copy, so that the phase itself can stay in registers.
        false => Err(unsound(group, phase.clone())),
    }
}

/// The largest [`LieGroup::element_defect`] of a state that is accepted: the square root of rounding.
#[inline(always)]
fn largest_defect<T: Scalar>() -> T {
    // Of rounding in the scalar, not in its lanes' type.
    T::of(OFF_GROUP) * T::epsilon().simd_sqrt()
}

/// Names what is wrong with a state.
#[cold]
#[inline(never)]
fn unsound<G: LieGroup>(group: &G, phase: Phase<G>) -> StepError {
    if !finite_or_nan(&phase.momentum).simd_le(G::Scalar::of(0.0)).all() {
        return StepError::Overflow;
    }
    StepError::OffGroup { defect: group.element_defect(&phase.group_element).largest_lane() }
}
