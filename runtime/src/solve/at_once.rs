//! Several steps solved at once, where registers are wide.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::ahead::Ahead;
use super::effort::Effort;
use super::{Solution, Yardstick};
use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{
    AT_ONCE, GeneratingFunction, Linearised, LinearisedOf, ScalarOf, VectorOf,
};
use crate::group::LieGroup;
use crate::scalar::Scalar;

/// Steps are refined so often at most.
const REFINEMENTS: u32 = 3;
/// Fewer steps at once do not pay.
const LEAST: usize = 3;
/// Steps made one by one where they are too long to be made at once.
const PAUSE: u64 = 64;

/// The x of a step, and how it was found: see [`Solution`](super::Solution).
pub struct Increment<V, T> {
    pub x: V,
    pub iterations: u32,
    pub residual: T,
}

/// That of a step of `S`.
type IncrementOf<S> = Increment<VectorOf<S>, ScalarOf<S>>;

impl<V, T> From<Solution<V, T>> for Increment<V, T> {
    #[inline(always)]
    fn from(Solution { x, iterations, residual, .. }: Solution<V, T>) -> Self {
        Self { x, iterations, residual }
    }
}

/// Newton's method for several steps at once.
///
/// All are linearised together about guesses of where they are ([`GeneratingFunction::linearise`]). What is
/// left to do one after the other is little: each step starts where the one before has ended, not quite where
/// it was guessed, and its x moves by a matrix times that difference. What is of second order in the difference is
/// rounding, or else all steps are refined together ([`GeneratingFunction::refine`]). Where that is not
/// enough, steps go as without this.
pub struct AtOnce<S: GeneratingFunction + ?Sized> {
    found: LinearisedOf<S>,
    /// How often these steps are refined, and how far they were before the last time.
    refined: u32,
    before: [Distance<ScalarOf<S>>; AT_ONCE],
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
#[derive(Clone, Copy)]
struct Distance<T> {
    /// How far x is from where the gradient was taken.
    gone: T,
    /// An estimate of how far it is from the solution.
    left: T,
}

impl<S: GeneratingFunction + ?Sized> AtOnce<S> {
    /// No guesses yet.
    pub fn new(generating: &S) -> Self {
        let dim = generating.group().dim();
        let (zero, nothing) = (VectorOf::<S>::zeros(dim), ScalarOf::<S>::of(0.0));
        Self {
            found: Linearised::zeros(dim),
            refined: 0,
            before: [Distance { gone: nothing, left: nothing }; AT_ONCE],
            needed: 0,
            effort: Effort::new(),
            yardstick: Yardstick::of(&zero),
            next: 0,
            count: 0,
            pause: 0,
        }
    }

    /// As [`solve`](super::solve) for the next step, from `mu`, with so many steps to go; by `otherwise` where
    /// steps are too long.
    ///
    /// # Errors
    /// As [`solve`](super::solve).
    #[inline(always)]
    pub fn solve(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        steps: u64,
        otherwise: &mut Ahead<VectorOf<S>, ScalarOf<S>>,
    ) -> Result<IncrementOf<S>, StepError> {
        // As often as the steps before were refined, there is no asking whether it takes that.
        let mut refinements = 0;
        if self.next == self.count {
            if self.count > 0 {
                self.effort.note(self.needed);
            }
            if !self.look(generating, mu, steps) {
                return without(generating, mu, steps, otherwise);
            }
            otherwise.forget();
            refinements = core::mem::take(&mut self.needed);
        }
        loop {
            if self.refined >= refinements {
                let (x, Distance { left, .. }) = self.follow(generating, self.next, mu);
                if left.simd_le(self.yardstick.tolerance).all() {
                    self.next += 1;
                    return Ok(Increment { x, iterations: 1 + self.refined, residual: left });
                }
            }
            if self.refined == REFINEMENTS || !self.refine(generating, mu) {
                break;
            }
        }
        self.effort.note(2 * REFINEMENTS);
        (self.pause, self.needed) = (PAUSE, 0);
        self.forget();
        without(generating, mu, steps, otherwise)
    }

    /// Forgets the guesses: what comes next does not follow from the steps so far.
    pub fn forget(&mut self) {
        (self.next, self.count) = (0, 0);
    }

    /// A step as linearised, for `mu`.
    #[inline(always)]
    fn follow(
        &self,
        generating: &S,
        number: usize,
        mu: &VectorOf<S>,
    ) -> (VectorOf<S>, Distance<ScalarOf<S>>) {
        let (group, chart) = (generating.group(), generating.chart());
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
            return (x, Distance { gone, left });
        }
        // As in Newton's method one by one. The fine part may change more in other directions than it did
        // from step to step.
        let stretch = self.found.correction[number] + moved;
        let gone = shifted + stretch;
        let curved = half * stretch + generating.bend(x.pairing(&x).simd_sqrt()) * gone;
        let defect = (yardstick.scale + yardstick.scale) * self.found.slope;
        let left = yardstick.left(stretch * curved + defect * gone, gone, None);
        (x, Distance { gone, left })
    }

    /// Takes the steps that are left, from `mu`, as far as they are found, and the gradient there; whether that
    /// can be. If not, they are of no more use.
    #[inline(never)]
    fn refine(&mut self, generating: &S, mu: &VectorOf<S>) -> bool {
        let (group, chart) = (generating.group(), generating.chart());
        let mut mu = mu.clone();
        let mut needed = false;
        for k in self.next..self.count {
            let (x, Distance { gone, left }) = self.follow(generating, k, &mu);
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
    fn look(&mut self, generating: &S, mu: &VectorOf<S>, steps: u64) -> bool {
        (self.next, self.count, self.refined) = (0, 0, 0);
        if self.pause > 0 || steps < LEAST as u64 {
            self.pause = self.pause.saturating_sub(1);
            return false;
        }
        if !generating.linearise(mu, self.effort.pieces(), &mut self.found) {
            self.pause = u64::MAX;
            return false;
        }
        self.count = AT_ONCE.min(steps as usize);
        self.yardstick = Yardstick::of(mu);
        true
    }
}

/// A step without this, out of the way of what is fast.
#[inline(never)]
fn without<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    steps: u64,
    ahead: &mut Ahead<VectorOf<S>, ScalarOf<S>>,
) -> Result<IncrementOf<S>, StepError> {
    ahead.solve(generating, mu, steps).map(Increment::from)
}
