//! From a generating function to maps: Poisson on 𝔤\*, symplectic on T\*G.

use nalgebra::SimdPartialOrd;

use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::phase::Phase;
use crate::scalar::Scalar;
use crate::solve::{Solution, solve, solve_after};

/// How the solve of one step went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport<T> {
    /// Newton iterations, or evaluations of the fixed point.
    pub iterations: u32,
    /// An estimate of the residual left in J_L(x, p) = μ, relative to the largest coordinate of μ.
    pub residual: T,
}

/// The Poisson map μ′ → μ″ = Ad\*_{τ(x)⁻¹} μ′ of 𝔤\* that `generating` induces, with the turn that
/// follows it where there is one ([`GeneratingFunction::turn`]).
///
/// The momentum moves by the group action, so Casimirs are kept whatever residual the solve
/// leaves.
///
/// # Errors
/// As [`solve`].
#[inline(always)]
pub fn poisson_map<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<VectorOf<S>, StepError> {
    let group = generating.group();
    let solution = solve(generating, mu)?;
    let moved = generating.chart().transport(group, &solution.x, mu).1;
    Ok(match generating.turn(&moved) {
        Some(y) => group.exp_transport(&y, &moved).1,
        None => moved,
    })
}

/// Advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′): Algorithm 1 of the paper. Symplectic,
/// G-equivariant, and J_L-preserving. The turn follows where there is one
/// ([`GeneratingFunction::turn`]).
///
/// # Errors
/// As [`solve`]; `phase` is then left as it was.
#[inline(always)]
pub fn advance<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    let solution = solve(generating, &phase.momentum)?;
    reconstruct(generating, phase, &solution.x);
    Ok(StepReport { iterations: solution.iterations, residual: solution.residual })
}

/// Many steps of [`advance`], and faster than one by one: each step takes its first guess from the
/// one before ([`GeneratingFunction::predict_after`]), many share a turn, and what steps read of
/// `generating` is prepared once. The report holds the largest number of iterations and the largest
/// residual of a step; no step, none.
///
/// # Errors
/// As [`solve`]; `phase` is then left before the step that failed.
// Not inlined: beside code that might write to `generating`, nothing can be prepared.
#[inline(never)]
pub fn advance_by<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> Result<StepReport<ScalarOf<S>>, StepError> {
    march(generating, phase, steps).map_err(|stopped| stopped.error)
}

/// How far [`march`] came, and why no farther.
pub(crate) struct Stopped {
    /// Steps made.
    pub(crate) done: u64,
    /// Why the next one was not.
    pub(crate) error: StepError,
}

/// The most steps that share a turn: rounding moves its angle by less than that of one step each.
const STEPS_PER_TURN: u64 = 256;

/// The steps of [`advance_by`].
#[inline(always)]
pub(crate) fn march<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    let mut last = None;
    // Steps whose turn is still to come.
    let mut straight = 0;
    for done in 0..steps {
        let Solution { p, x, iterations, residual } =
            match solve_after(generating, &phase.momentum, last.as_ref()) {
                Ok(solution) => solution,
                Err(error) => {
                    turn(generating, phase, straight);
                    return Err(Stopped { done, error });
                }
            };
        displace(generating, phase, &x);
        last = Some(p);
        straight += 1;
        if straight == STEPS_PER_TURN {
            if turn(generating, phase, straight) {
                last = None;
            }
            straight = 0;
        }
        worst.iterations = worst.iterations.max(iterations);
        worst.residual = worst.residual.simd_max(residual);
    }
    turn(generating, phase, straight);
    Ok(worst)
}

/// The second half of [`advance`]: advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′) with the x that
/// [`solve`] has found for μ′, and makes the turn.
#[inline(always)]
pub fn reconstruct<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    x: &VectorOf<S>,
) {
    displace(generating, phase, x);
    turn(generating, phase, 1);
}

/// (g, μ) ↦ (g·τ(x), Ad\*_{τ(x)⁻¹} μ).
#[inline(always)]
fn displace<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    x: &VectorOf<S>,
) {
    let group = generating.group();
    let (increment, momentum) = generating.chart().transport(group, x, &phase.momentum);
    phase.group_element = group.compose(&phase.group_element, &increment);
    phase.momentum = momentum;
}

/// The turns of so many steps at once; whether there are any.
#[inline(always)]
fn turn<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> bool {
    let Some(mut y) = generating.turn(&phase.momentum) else { return false };
    let times = ScalarOf::<S>::of(steps as f64);
    for i in 0..y.dim() {
        y[i] *= times;
    }
    let group = generating.group();
    let (increment, momentum) = group.exp_transport(&y, &phase.momentum);
    phase.group_element = group.compose(&phase.group_element, &increment);
    phase.momentum = momentum;
    true
}
