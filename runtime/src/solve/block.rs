//! Newton's method for several steps at once, where registers are wide.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd, SimdValue};

use super::effort::Effort;
use super::lagged::{LaggedModel, LaggedNewton};
use super::newton::careful_newton;
use super::wide::Steps;
use super::{Candidate, CandidateOf, Method, Settings, Yardstick};
use crate::chart::Chart;
use crate::generating::{MatrixOf, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// Maximum refinements per block.
const REFINEMENTS: u32 = 3;
/// Fewer steps at once do not pay.
const LEAST: u64 = 3;
/// Steps made one by one where they are too long to be made at once.
const PAUSE: u64 = 64;

/// Steps in a block: as many as a register of the build target has lanes.
pub const BLOCK: usize = <Steps as SimdValue>::LANES;

/// The [`Linearised`] steps of `S`.
pub type LinearisedOf<S> = Linearised<VectorOf<S>, MatrixOf<S>, ScalarOf<S>>;

/// The equations x = ∂S/∂p(P(x, μ)), P(x, μ) = (d^R τ_x)ᵀ μ, of several steps, linearised about guesses of
/// their x and μ: the solution for another μ is x + J·(P(x, μ − start) + shift), up to second order.
///
/// The vectors' and the matrices' type, and that of their numbers.
#[derive(Clone, Debug)]
pub struct Linearised<V, M, T> {
    /// The guessed momentum before each step.
    pub start: [V; BLOCK],
    /// The solution for it, up to second order and to what `shift` brings.
    pub x: [V; BLOCK],
    /// How far p = P(x, start) is from where the gradient of S was taken; zero if `x` counts that already.
    pub shift: [V; BLOCK],
    /// How far that is from the guess: the largest difference of an entry.
    pub correction: [T; BLOCK],
    /// J = (1 − H·∂P/∂x)⁻¹ H with H the Hessian of the coarse function.
    pub response: [M; BLOCK],
    /// How much the fine gradient changes with p: the largest |δ fine| / |δp| from one step
    /// to the next.
    pub slope: T,
}

impl<V: Coordinates<T>, T: Scalar> Linearised<V, V::Matrix, T> {
    /// Zeros throughout, to be filled.
    #[must_use]
    pub fn zeros(dim: usize) -> Self {
        let zero = T::of(0.0);
        Self {
            start: core::array::from_fn(|_| V::zeros(dim)),
            x: core::array::from_fn(|_| V::zeros(dim)),
            shift: core::array::from_fn(|_| V::zeros(dim)),
            correction: [zero; BLOCK],
            response: core::array::from_fn(|_| V::zero_matrix(dim)),
            slope: zero,
        }
    }
}

/// A generating function whose next steps can be linearised together, in the lanes of one number, for little more than
/// one step costs.
pub trait BlockModel: LaggedModel {
    /// Linearises the next steps from `mu`. They are guessed by following the flow in so many substeps (for every
    /// four of them): the more, the better, and the more work. `false` where this cannot be, or does not pay.
    fn linearise(&self, mu: &VectorOf<Self>, substeps: u32, found: &mut LinearisedOf<Self>)
    -> bool;

    /// Re-evaluates ∂S/∂p at the current iterates, reusing the Jacobian: takes the gradient of S at P(x, start), given
    /// `found` with an x for each `start`, and leaves that gradient in `x` and the `shift` that it brings. `false` where
    /// that cannot be: steps for which one J is not enough then go one by one.
    fn refine(&self, found: &mut LinearisedOf<Self>) -> bool;
}

/// A step as it follows from its linearisation.
struct Followed<V, T> {
    x: V,
    distance: Distance<T>,
}

/// Newton's method for a block of steps at once.
///
/// All are linearised together about guesses of where they are ([`BlockModel::linearise`]). What is
/// left to do one after the other is little: each step starts where the one before has ended, not quite where
/// it was guessed, and its x moves by a matrix times that difference. What is of second order in the difference is
/// rounding, or else all steps are refined together ([`BlockModel::refine`]). Where that is not
/// enough, steps go by [`LaggedNewton`].
#[derive(Debug)]
pub struct BlockNewton<S: BlockModel + ?Sized> {
    /// Not made for a single step.
    block: Option<Block<S>>,
}

/// The block of steps that are being made.
#[derive(Debug)]
struct Block<S: BlockModel + ?Sized> {
    found: LinearisedOf<S>,
    /// How often these steps are refined, and how far they were before the last time.
    refined: u32,
    before: [Distance<ScalarOf<S>>; BLOCK],
    /// How often that was needed.
    needed: u32,
    /// How they are guessed.
    effort: Effort,
    /// The next step, and how many there are.
    next: usize,
    count: usize,
    /// Steps to be made otherwise.
    pause: u64,
    /// Of the momentum before these steps; its size changes little in them.
    yardstick: Yardstick<ScalarOf<S>>,
}

/// Relative to the scale.
#[derive(Clone, Copy, Debug)]
struct Distance<T> {
    /// How far x is from where the gradient was taken.
    gone: T,
    /// An estimate of how far it is from the solution.
    left: T,
}

impl<S: BlockModel + ?Sized> Method<S> for BlockNewton<S> {
    #[inline(always)]
    fn begin(_: &S) -> Self {
        Self { block: None }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        if !settings.goes_one_by_one() && (left >= LEAST || self.block.is_some()) {
            let block = self.block.get_or_insert_with(|| Block::new(generating));
            let candidate = block.propose(generating, mu, left, settings);
            if let Some(candidate) = candidate {
                return candidate;
            }
        }
        one_by_one(generating, mu, left, settings)
    }

    #[inline(always)]
    fn forget(&mut self) {
        if let Some(block) = &mut self.block {
            block.forget();
        }
    }

    fn propose_from(
        generating: &S,
        mu: &VectorOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        LaggedNewton::propose_from(generating, mu, guess, settings)
    }

    fn propose_scaled(
        generating: &S,
        mu: &VectorOf<S>,
        scale: ScalarOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        careful_newton(generating, mu, scale, guess, settings)
    }
}

/// A step without this, out of the way of what is fast.
#[inline(never)]
fn one_by_one<S: BlockModel + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    left: u64,
    settings: Settings<ScalarOf<S>>,
) -> CandidateOf<S> {
    LaggedNewton.propose(generating, mu, left, settings)
}

impl<S: BlockModel + ?Sized> Block<S> {
    /// No guesses yet.
    fn new(generating: &S) -> Self {
        let dim = generating.group().dim();
        let (zero, nothing) = (VectorOf::<S>::zeros(dim), ScalarOf::<S>::of(0.0));
        Self {
            found: Linearised::zeros(dim),
            refined: 0,
            before: [Distance { gone: nothing, left: nothing }; BLOCK],
            needed: 0,
            effort: Effort::new(),
            yardstick: Yardstick::of(&zero, Settings::default()),
            next: 0,
            count: 0,
            pause: 0,
        }
    }

    /// The next step, where it can be made in a block.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> Option<CandidateOf<S>> {
        // As often as the steps before were refined, there is no asking whether it takes that.
        let mut refinements = 0;
        if self.next == self.count {
            if self.count > 0 {
                self.effort.note(self.needed);
            }
            if !self.look(generating, mu, left, settings) {
                return None;
            }
            refinements = core::mem::take(&mut self.needed);
        }
        loop {
            if self.refined >= refinements {
                let Followed { x, distance: Distance { gone, left } } =
                    self.follow(generating, self.next, mu);
                if left.simd_le(self.yardstick.tolerance).all() {
                    self.next += 1;
                    let iterations = 1 + self.refined;
                    return Some(Candidate { x, moved: gone, residual: left, iterations });
                }
            }
            if self.refined == REFINEMENTS || !self.refine(generating, mu) {
                break;
            }
        }
        self.effort.note(2 * REFINEMENTS);
        (self.pause, self.needed) = (PAUSE, 0);
        self.forget();
        None
    }

    /// Forgets the guesses: what comes next does not follow from the steps so far.
    fn forget(&mut self) {
        (self.next, self.count) = (0, 0);
    }

    /// A step as linearised, for `mu`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn follow(
        &self,
        generating: &S,
        number: usize,
        mu: &VectorOf<S>,
    ) -> Followed<VectorOf<S>, ScalarOf<S>> {
        let (group, chart) = (generating.group(), S::Chart::default());
        let half = ScalarOf::<S>::of(0.5);
        let guess = &self.found.x[number];

        let apart = mu.clone().minus(&self.found.start[number]);
        let shift = chart.pull_back(group, guess, &apart).plus(&self.found.shift[number]);
        let moved = shift.left_multiply(&self.found.response[number]);
        let x = guess.clone().plus(&moved);

        let yardstick = self.yardstick;
        let moved = moved.pairing(&moved).simd_sqrt();
        let shifted = shift.pairing(&shift).simd_sqrt() * yardstick.inverse_scale;
        if self.refined > 0 {
            let before = &self.before[number];
            let gone = shifted + moved;
            let bound = before.left * gone / before.gone;
            let left = yardstick.left(bound, gone, Some(before.gone));
            return Followed { x, distance: Distance { gone, left } };
        }
        // As in Newton's method one by one. The fine part may change more in other directions than it did
        // from step to step.
        let stretch = self.found.correction[number] + moved;
        let gone = shifted + stretch;
        let curved = half * stretch + generating.bend(x.pairing(&x).simd_sqrt()) * gone;
        let defect = (yardstick.scale + yardstick.scale) * self.found.slope;
        let left = yardstick.left(stretch * curved + defect * gone, gone, None);
        Followed { x, distance: Distance { gone, left } }
    }

    /// Takes the steps that are left, from `mu`, as far as they are found, and the gradient there; whether that
    /// can be. If not, they are of no more use.
    #[inline(never)]
    fn refine(&mut self, generating: &S, mu: &VectorOf<S>) -> bool {
        let (group, chart) = (generating.group(), S::Chart::default());
        let mut mu = mu.clone();
        let mut needed = false;
        for k in self.next..self.count {
            let Followed { x, distance: Distance { gone, left } } = self.follow(generating, k, &mu);
            needed |= !left.simd_le(self.yardstick.tolerance).all();
            self.before[k] = Distance { gone: gone + self.yardstick.smallest, left };
            let end = chart.transport(group, &x, &mu).1;
            self.found.x[k] = x;
            self.found.start[k] = core::mem::replace(&mut mu, end);
        }
        if !generating.refine(&mut self.found) {
            return false;
        }
        self.refined += 1;
        if needed {
            self.needed = self.refined;
        }
        true
    }

    /// Guesses for the next steps, the first from `mu`; whether there are any.
    #[inline(always)]
    fn look(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        steps: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> bool {
        (self.next, self.count, self.refined) = (0, 0, 0);
        if self.pause > 0 || steps < LEAST {
            self.pause = self.pause.saturating_sub(1);
            return false;
        }
        if !generating.linearise(mu, self.effort.substeps(), &mut self.found) {
            self.pause = u64::MAX;
            return false;
        }
        self.count = usize::try_from(steps).map_or(BLOCK, |steps| steps.min(BLOCK));
        self.yardstick = Yardstick::of(mu, settings);
        true
    }
}
