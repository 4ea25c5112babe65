//! From a generating function to maps: Poisson on 𝔤\*, symplectic on T\*G.

pub(crate) mod kicked;
pub(crate) mod monitor;
pub(crate) mod numbers;
pub(crate) mod printed;
pub(crate) mod rows;

use nalgebra::{SimdBool, SimdPartialOrd};

use crate::chart::Chart;
use crate::error::{StepError, Stopped};
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::solve::{Candidate, DrivenIn, Integrator, accept, propose};

/// Statistics of the solve of one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport<T> {
    /// Newton iterations, or evaluations of the fixed point.
    pub iterations: u32,
    /// A bound on the residual left in J_L(x, p) = μ, relative to the largest coordinate of μ.
    pub residual: T,
}

/// The numbers of the states of steps.
pub type NumberOf<S> = <<S as Steps>::Group as LieGroup>::Scalar;

/// An increment that programs have found and refused, and how far p lies from its first guess.
pub(crate) type Refused<G> = (<G as LieGroup>::Vector, <G as LieGroup>::Scalar);

/// The steps of a system, by programs as far as these accept them. Every [`Integrator`] has steps, and so has a struct that the
/// attribute generates for a Hamiltonian that is no polynomial.
pub trait Steps {
    /// The group of the states.
    type Group: LieGroup;

    /// Makes up to `steps` steps by programs, where there are any, after those made since the time given.
    #[doc(hidden)]
    fn drive_from(
        &self,
        phase: &mut Phase<Self::Group>,
        since: (NumberOf<Self>, u64),
        steps: u64,
    ) -> DrivenIn<Self::Group>;

    /// Makes a step that programs have refused, or of which there are none.
    ///
    /// # Errors
    /// The reason why there is no right step; `phase` is then left as it was.
    #[doc(hidden)]
    fn by_hand(
        &self,
        phase: &mut Phase<Self::Group>,
        since: (NumberOf<Self>, u64),
        refused: Option<Refused<Self::Group>>,
    ) -> Result<StepReport<NumberOf<Self>>, StepError>;
}

impl<S: Integrator + ?Sized> Steps for S {
    type Group = S::Group;

    #[inline(always)]
    fn drive_from(
        &self,
        phase: &mut Phase<S::Group>,
        _: (ScalarOf<S>, u64),
        steps: u64,
    ) -> DrivenIn<S::Group> {
        self.drive(phase, steps)
    }

    #[cold]
    #[inline(never)]
    fn by_hand(
        &self,
        phase: &mut Phase<S::Group>,
        _: (ScalarOf<S>, u64),
        refused: Option<Refused<S::Group>>,
    ) -> Result<StepReport<ScalarOf<S>>, StepError> {
        let mu = &phase.momentum;
        let (guess, distance) = match refused {
            Some((x, distance)) => (S::Chart::default().pull_back(self.group(), &x, mu), distance),
            None => (self.predict(mu), ScalarOf::<S>::of(0.0)),
        };
        let mut candidate = propose(self, mu, guess);
        candidate.moved += distance;
        let Candidate { x, iterations, residual, .. } = accept(self, mu, candidate)?;
        reconstruct(self, phase, &x)?;
        Ok(StepReport { iterations, residual })
    }
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
    advance_at(generating, phase, ScalarOf::<S>::of(0.0))
}

/// Many steps of [`advance`], faster than one by one: a comoving frame moves on, and the state is checked, for many at
/// once. The report holds the largest number of iterations and the largest residual of a step.
///
/// # Errors
/// [`Stopped`]: how many steps were made, and why the next one was not; `phase` is then the state before that.
pub fn advance_by<S: Integrator + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    advance_from(generating, phase, ScalarOf::<S>::of(0.0), steps)
}

/// Makes a step from the state at `time`.
///
/// # Errors
/// [`StepError`]; `phase` is then left as it was.
#[inline(always)]
pub fn advance_at<S: Steps + ?Sized>(
    step: &S,
    phase: &mut Phase<S::Group>,
    time: NumberOf<S>,
) -> Result<StepReport<NumberOf<S>>, StepError> {
    let driven = step.drive_from(phase, (time, 0), 1);
    if driven.steps == 1 {
        return Ok(StepReport { iterations: driven.iterations, residual: driven.residual });
    }
    refused(step, phase, time)
}

/// The step that programs have refused, made anew: every step would have to keep its candidate in memory to hand it on.
#[cold]
fn refused<S: Steps + ?Sized>(
    step: &S,
    phase: &mut Phase<S::Group>,
    time: NumberOf<S>,
) -> Result<StepReport<NumberOf<S>>, StepError> {
    advance_from(step, phase, time, 1).map_err(|stopped| stopped.error)
}

/// Makes many steps from the state at `time`.
///
/// # Errors
/// [`Stopped`]; `phase` is then the state before the step that failed.
// Not inlined: what steps read of `step` is prepared once, where nothing beside it might write there.
#[inline(never)]
pub fn advance_from<S: Steps + ?Sized>(
    step: &S,
    phase: &mut Phase<S::Group>,
    time: NumberOf<S>,
    steps: u64,
) -> Result<StepReport<NumberOf<S>>, Stopped> {
    let mut worst = StepReport { iterations: 0, residual: NumberOf::<S>::of(0.0) };
    let mut note = |iterations: u32, residual: NumberOf<S>| {
        worst.iterations = worst.iterations.max(iterations);
        worst.residual = worst.residual.simd_max(residual);
    };
    let mut done = 0;
    while done < steps {
        let driven = step.drive_from(phase, (time, done), steps - done);
        done += driven.steps;
        note(driven.iterations, driven.residual);
        if done < steps {
            let report = step
                .by_hand(phase, (time, done), driven.refused)
                .map_err(|error| Stopped { steps: done, error })?;
            note(report.iterations, report.residual);
            done += 1;
        }
    }
    Ok(worst)
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
