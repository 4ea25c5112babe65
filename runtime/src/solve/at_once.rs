//! Several steps solved at once, where registers are wide.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::ahead::Ahead;
use super::{Solution, Yardstick};
use crate::chart::Chart;
use crate::coordinates::Coordinates;
use crate::error::StepError;
use crate::generating_function::{
    AT_ONCE, GeneratingFunction, Linearised, LinearisedOf, ScalarOf, VectorOf,
};
use crate::group::LieGroup;
use crate::scalar::Scalar;

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
/// From the middle of one step to the middle of the next the momentum goes along the flow, about; there
/// all steps are linearised together ([`GeneratingFunction::linearise`]). What is left to do one after
/// the other is little: each step starts where the one before has ended, not quite where it was guessed,
/// and its x moves by a matrix times that difference. What is of second order in the difference is
/// rounding, or else mended with one more gradient. Where that is not enough, steps go as without this.
pub struct AtOnce<S: GeneratingFunction + ?Sized> {
    found: LinearisedOf<S>,
    /// The guessed momenta in the middle of these steps.
    middles: [VectorOf<S>; AT_ONCE],
    /// From the end of the last of them to the middle of the step after it, where that is known.
    onward: Option<VectorOf<S>>,
    /// How far the momentum before the step made last was from its guess.
    apart: VectorOf<S>,
    /// The next step, and how many there are.
    next: usize,
    count: usize,
    /// Steps to be made otherwise.
    pause: u64,
    /// Of the momentum before these steps; its size changes little in them.
    yardstick: Yardstick<ScalarOf<S>>,
}

/// An x that is not good enough.
struct Poor<V, T> {
    x: V,
    /// What it leaves, as a fraction of the way to it.
    gain: T,
}

impl<S: GeneratingFunction + ?Sized> AtOnce<S> {
    /// No guesses yet.
    pub fn new(generating: &S) -> Self {
        let dim = generating.group().dim();
        let zero = VectorOf::<S>::zeros(dim);
        Self {
            found: Linearised::zeros(dim),
            middles: core::array::from_fn(|_| zero.clone()),
            onward: None,
            yardstick: Yardstick::of(&zero),
            apart: zero,
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
        if self.next == self.count {
            if !self.look(generating, mu, steps) {
                return without(generating, mu, steps, otherwise);
            }
            otherwise.forget();
        }
        let found = match self.follow(generating, mu) {
            Ok(found) => Some(found),
            Err(poor) => self.mend(generating, mu, &poor),
        };
        self.next += 1;
        match found {
            Some(found) => Ok(found),
            None => {
                self.pause = PAUSE;
                self.forget();
                without(generating, mu, steps, otherwise)
            }
        }
    }

    /// Forgets the guesses: what comes next does not follow from the steps so far.
    pub fn forget(&mut self) {
        self.onward = None;
        (self.next, self.count) = (0, 0);
    }

    /// The next step as linearised, for `mu`; as an error where what that leaves is more than rounding.
    #[inline(always)]
    fn follow(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
    ) -> Result<IncrementOf<S>, Poor<VectorOf<S>, ScalarOf<S>>> {
        let (group, chart) = (generating.group(), generating.chart());
        let half = ScalarOf::<S>::of(0.5);
        let guess = &self.found.x[self.next];

        self.apart = mu.clone().minus(&self.found.start[self.next]);
        let shift = chart.pull_back(group, guess, &self.apart);
        let moved = shift.left_multiply(&self.found.response[self.next]);
        let x = guess.clone().plus(&moved);

        // As in Newton's method one by one. The fine part may change more in other directions than it did
        // from step to step.
        let yardstick = self.yardstick;
        let stretch = self.found.correction[self.next] + moved.pairing(&moved).simd_sqrt();
        let relative = shift.pairing(&shift).simd_sqrt() * yardstick.inverse_scale + stretch;
        let curved = half * stretch + generating.bend(x.pairing(&x).simd_sqrt()) * relative;
        let defect = (yardstick.scale + yardstick.scale) * self.found.slope;
        let left = yardstick.left(stretch * curved + defect * relative, relative, None);
        if left.simd_le(yardstick.tolerance).all() {
            return Ok(Increment { x, iterations: 1, residual: left });
        }
        Err(Poor { x, gain: left / relative })
    }

    /// Once more with the same matrix, now from the gradient at `poor`.
    #[inline(never)]
    fn mend(
        &self,
        generating: &S,
        mu: &VectorOf<S>,
        poor: &Poor<VectorOf<S>, ScalarOf<S>>,
    ) -> Option<IncrementOf<S>> {
        let (group, chart) = (generating.group(), generating.chart());
        let p = chart.pull_back(group, &poor.x, mu);
        let gradient = generating.gradient(&p);
        let shift = chart.pull_back(group, &gradient, mu).minus(&p);
        let moved = shift.left_multiply(&self.found.response[self.next]);
        let x = gradient.plus(&moved);

        let yardstick = self.yardstick;
        let relative = shift.largest_entry() * yardstick.inverse_scale + moved.largest_entry();
        let left = yardstick.left(poor.gain * relative, relative, None);
        let enough = left.simd_le(yardstick.tolerance).all();
        enough.then_some(Increment { x, iterations: 2, residual: left })
    }

    /// Guesses for the next steps, the first from `mu`; whether there are any.
    #[inline(always)]
    fn look(&mut self, generating: &S, mu: &VectorOf<S>, steps: u64) -> bool {
        (self.next, self.count) = (0, 0);
        if self.pause > 0 || steps < LEAST as u64 {
            self.pause = self.pause.saturating_sub(1);
            return false;
        }
        let (half, before) = match self.onward.take() {
            // With the rates along the guesses, and not along the motion, errors would grow.
            Some(half) => (half, self.middles[AT_ONCE - 1].clone().plus(&self.apart)),
            None => {
                // About μ as the middle of a step, half of it leads to its end, where the next has its middle.
                self.middles = core::array::from_fn(|_| mu.clone());
                if !generating.linearise(&self.middles, &mut self.found) {
                    self.pause = u64::MAX;
                    return false;
                }
                (self.found.end.clone().minus(mu), self.found.start[0].clone())
            }
        };
        let mut before = rates(generating, &before);
        let count = AT_ONCE.min(steps as usize);
        let mut middle = mu.clone().plus(&half);
        for k in 0..AT_ONCE {
            if k < count {
                self.middles[k] = middle.clone();
                (middle, before) = generating.next_middle(&before, &middle);
            } else {
                self.middles[k] = self.middles[k - 1].clone();
            }
        }
        if !generating.linearise(&self.middles, &mut self.found) {
            return false;
        }
        self.onward = Some(middle.minus(&self.found.end));
        self.count = count;
        self.yardstick = Yardstick::of(mu);
        true
    }
}

/// The rates of a step, given the momentum in its middle.
#[inline(never)]
fn rates<S: GeneratingFunction + ?Sized>(generating: &S, middle: &VectorOf<S>) -> [VectorOf<S>; 2] {
    let none = core::array::from_fn(|_| VectorOf::<S>::zeros(middle.dim()));
    generating.next_middle(&none, middle).1
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
