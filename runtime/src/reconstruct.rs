//! From a generating function to maps: Poisson on 𝔤\*, symplectic on T\*G.

use nalgebra::SimdPartialOrd;

use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::phase::Phase;
use crate::scalar::Scalar;
use crate::solve::{Ahead, AtOnce, Increment, Solution, solve, solve_after};

/// How the solve of one step went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport<T> {
    /// Newton iterations, or evaluations of the fixed point.
    pub iterations: u32,
    /// An estimate of the residual left in J_L(x, p) = μ, relative to the largest coordinate of μ.
    pub residual: T,
}

/// The Poisson map μ′ → μ″ = Ad\*_{τ(x)⁻¹} μ′ of 𝔤\* that `generating` induces, with the
/// motion of the frame where that is a comoving one ([`GeneratingFunction::frame`]).
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
    let mut moved = generating.chart().transport(group, &solution.x, mu).1;
    let mut part = 0;
    while let Some(y) = generating.frame(part, &moved) {
        moved = group.exp_transport(&y, &moved).1;
        part += 1;
    }
    Ok(moved)
}

/// Advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′): Algorithm 1 of the paper. Symplectic,
/// G-equivariant, and J_L-preserving. A comoving frame moves on after it
/// ([`GeneratingFunction::frame`]).
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
/// one before ([`GeneratingFunction::predict_after`]), or [`AT_ONCE`](crate::AT_ONCE) steps are solved at once
/// ([`GeneratingFunction::linearise`]), a comoving frame moves on for many at once,
/// and what steps read of `generating` is prepared once. The report holds the largest number of
/// iterations and the largest residual of a step; no step, none.
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
    march(generating, phase, steps, true).map_err(|stopped| stopped.error)
}

/// How far [`march`] came, and why no farther.
pub(crate) struct Stopped {
    /// Steps made; ensembles report it.
    #[cfg_attr(not(feature = "ensemble"), allow(dead_code))]
    pub(crate) done: u64,
    /// Why the next one was not.
    pub(crate) error: StepError,
}

/// The most steps for which a comoving frame moves on at once: few enough for its integrals, which drift
/// by rounding, to be the same in all of them.
const STEPS_PER_FRAME: u64 = 256;

/// The steps of [`advance_by`]; not several at once, lanes and scalars have the same bits.
#[inline(always)]
pub(crate) fn march<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
    at_once: bool,
) -> Result<StepReport<ScalarOf<S>>, Stopped> {
    let mut worst = StepReport { iterations: 0, residual: ScalarOf::<S>::of(0.0) };
    let mut last = None;
    // By branches on constants alone: where they are false nothing of this is compiled.
    let mut ahead = if S::IN_PARTS { Ahead::new(generating) } else { None };
    let mut at_once = if S::LINEARISES { at_once.then(|| AtOnce::new(generating)) } else { None };
    // Steps that the frame has not made yet.
    let mut behind = 0;
    for done in 0..steps {
        let (mu, left) = (&phase.momentum, steps - done);
        let found = if S::IN_PARTS
            && let Some(ahead) = &mut ahead
        {
            if S::LINEARISES
                && let Some(several) = &mut at_once
            {
                several.solve(generating, mu, left, ahead)
            } else {
                ahead.solve(generating, mu, left).map(Increment::from)
            }
        } else {
            solve_after(generating, mu, last.as_ref()).map(|solution| {
                let Solution { p, x, iterations, residual } = solution;
                last = Some(p);
                Increment { x, iterations, residual }
            })
        };
        let Increment { x, iterations, residual } = match found {
            Ok(found) => found,
            Err(error) => {
                move_frame(generating, phase, behind);
                return Err(Stopped { done, error });
            }
        };
        displace(generating, phase, &x);
        behind += 1;
        if behind == STEPS_PER_FRAME {
            if move_frame(generating, phase, behind) {
                last = None;
                if let Some(ahead) = &mut ahead {
                    ahead.forget();
                }
                if let Some(several) = &mut at_once {
                    several.forget();
                }
            }
            behind = 0;
        }
        worst.iterations = worst.iterations.max(iterations);
        worst.residual = worst.residual.simd_max(residual);
    }
    move_frame(generating, phase, behind);
    Ok(worst)
}

/// The momentum about one step later, by the first guess of x where there is one; a comoving frame's own motion
/// left out. Near enough to the motion to look at it there.
pub(crate) fn about_onwards<S: GeneratingFunction>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<VectorOf<S>, StepError> {
    match generating.predict_increment(mu) {
        Some(x) => Ok(generating.chart().transport(generating.group(), &x, mu).1),
        None => poisson_map(generating, mu),
    }
}

/// The second half of [`advance`]: advances (g′, μ′) to (g′·τ(x), Ad\*_{τ(x)⁻¹} μ′) with the x that
/// [`solve`] has found for μ′, and moves a comoving frame on.
#[inline(always)]
pub fn reconstruct<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    x: &VectorOf<S>,
) {
    displace(generating, phase, x);
    move_frame(generating, phase, 1);
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

/// Moves a comoving frame on by so many steps; whether there is one.
#[inline(always)]
fn move_frame<S: GeneratingFunction + ?Sized>(
    generating: &S,
    phase: &mut Phase<S::Group>,
    steps: u64,
) -> bool {
    let group = generating.group();
    let times = ScalarOf::<S>::of(steps as f64);
    let mut part = 0;
    while let Some(mut y) = generating.frame(part, &phase.momentum) {
        for i in 0..y.dim() {
            y[i] *= times;
        }
        let (increment, momentum) = group.exp_transport(&y, &phase.momentum);
        phase.group_element = group.compose(&phase.group_element, &increment);
        phase.momentum = momentum;
        part += 1;
    }
    part > 0
}
