//! Summing the tail of the series.
//!
//! S_{K+2}, S_{K+4}, … are left out of a truncated series, yet what went before foretells them: seen
//! as functions of t, S and its gradient have their nearest singularities on the real axis (where the
//! chart folds), so that along a motion ∂S_{k+2}/∂p ≈ a ∂S_k/∂p + b ∂S_{k−2}/∂p, with a and b that
//! hardly change with k or p. So the sum of all that is left out is about a combination of the last
//! terms: S_{K−4}, S_{K−2} and S_K are multiplied by numbers close to one, a step costs what it did, and
//! errors mostly fall by a factor of 10 to 100 (measured on free, heavy and submerged bodies; by less near a
//! separatrix, and for K = 7 not at all there).
//!
//! The numbers are found by least squares from exact steps along the motion, each made of two short
//! ones, which the same coefficients make: S_k goes with h^k.
//!
//! The factors differ from one by O(h²), O(h⁴) and O(h⁶) and multiply terms of order h^K, h^{K−2} and
//! h^{K−4}. So the order of accuracy stays K + 1; and since any function of p generates an equivariant
//! symplectic map, the geometry is as exact as before.
//!
//! A relative of the summation of Shanks, J. Math. Phys. 34 (1955) 1–42, with one recurrence for all
//! coordinates and momenta.

use core::array::from_fn;

use nalgebra::SimdBool;

use super::trial::{Moved, Sample, about_onwards, is_better, step, step_from};
use crate::chart::Chart;
use crate::error::StepError;
use crate::generating::{ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::linear::normal_equations::NormalEquations;
use crate::number::scalar::Scalar;
use crate::solve::{Integrator, Predict};

/// Momenta along the motion from each one given, a step apart; the last of them is looked at.
const STEPS: usize = 9;
/// Stride between the momenta that are fitted to.
const SPACING: usize = 4;
/// Terms with a factor: the last of them.
const TERMS: usize = 3;
/// Short steps in an exact one: what they leave out is 2^{K+1} times less.
const SHORT_STEPS: usize = 2;
/// Factors that differ from one by more than this together tell of terms that do not fall.
const FAR: f64 = 0.5;

/// What may be left of the errors for factors to be taken.
const SHARE: f64 = 0.5;

/// The factors of the terms S_k that sum the tail of a series: what `tuned` of a generated
/// integrator uses. Far from the motions it was made for the map is of the same order, and as
/// geometric, but no longer better than the plain series.
///
/// ```
/// use coadjoint::{Phase, SO3, lie_poisson};
///
/// #[lie_poisson(group = SO3, truncation = 9)]
/// fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
///     0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
/// }
///
/// # fn main() -> Result<(), coadjoint::StepError> {
/// let (inertia, start) = ([1.5, 2.0, 2.5], [2.0, 0.5, 1.0]);
/// let end = |step: Body, steps| {
///     let mut state = Phase::<SO3>::at_identity(start);
///     (0..steps).try_for_each(|_| step.advance(&mut state).map(|_| ()))?;
///     Ok::<_, coadjoint::StepError>(state.momentum)
/// };
/// let exact = end(Body::new(0.05, inertia)?, 400)?;
/// let plain = (end(Body::new(0.5, inertia)?, 40)? - exact).amax();
/// let tuned = (end(Body::tuned(0.5, inertia, [start])?, 40)? - exact).amax();
/// assert!(tuned < plain / 5.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tail<T> {
    truncation: usize,
    /// Those of S_K, S_{K−2}, S_{K−4}.
    factors: [T; TERMS],
}

impl<T: Scalar> Tail<T> {
    /// Nothing but the series S₁ … S_K itself.
    #[must_use]
    pub fn none(truncation: usize) -> Self {
        Self { truncation, factors: from_fn(|_| T::of(1.0)) }
    }

    /// Whether all factors are one: nothing better than the plain series was found.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let one = T::of(1.0);
        self.factors.iter().all(|factor| factor.simd_eq(one).all())
    }

    /// The factor of S_k.
    #[inline]
    #[must_use]
    pub fn factor(&self, k: usize) -> T {
        let before = self.truncation.checked_sub(k).map(|before| before / 2);
        before.and_then(|n| self.factors.get(n)).copied().unwrap_or(T::of(1.0))
    }

    /// The tail for motions that start with `momenta`, at three of the first nine steps of each.
    /// `series` makes the generating function Σ factor(k) S_k for given factors. Where the terms do not
    /// fall fast enough to tell, where 256 steps in a row along the motions (up to eight of them), or single steps as far
    /// again, do not err by half as much at most, and for K < 5, all factors are one: the series is then the plain one
    /// ([`Tail::is_plain`]).
    ///
    /// # Errors
    /// Those of the steps.
    pub fn along<S>(
        truncation: usize,
        momenta: impl IntoIterator<Item = VectorOf<S>>,
        series: impl Fn(&dyn Fn(usize) -> T) -> S,
    ) -> Result<Self, StepError>
    where
        S: Integrator + Predict,
        S::Group: crate::LieGroup<Scalar = T>,
    {
        let none = Self::none(truncation);
        if truncation < 5 {
            return Ok(none);
        }
        let whole = series(&|_| T::of(1.0));
        let short = series(&|k| (0..k).fold(T::of(1.0), |share, _| share * share_of_step::<T>()));
        let terms: [S; TERMS] = from_fn(|n| {
            // S₁ has none.
            let order = truncation.checked_sub(2 * n).filter(|&order| order > 1);
            series(&|k| T::of(if Some(k) == order { 1.0 } else { 0.0 }))
        });
        let mut equations = NormalEquations::<T, TERMS>::default();
        let mut motions = Sample::new();
        for start in momenta {
            motions.pass(&start);
            // Tells whether steps can be made from there.
            let mut mu = step(&whole, &start)?.1;
            for number in 0..STEPS {
                if number % SPACING == 0
                    && let Some(ExactStep { x, p, end }) = exact_step(&short, &mu)
                {
                    let left_out = x.clone().minus(&whole.gradient(&p));
                    let columns = terms.each_ref().map(|term| term.gradient(&p));
                    equations.add(&columns, &left_out, &x);
                    mu = end;
                } else {
                    mu = about_onwards(&whole, &mu)?;
                }
            }
        }
        let shares = equations.solution();
        let size = shares.iter().fold(T::of(0.0), |size, share| size + share.simd_abs());
        let tells = size.simd_lt(T::of(FAR));
        if tells.none() {
            return Ok(none);
        }
        let one = T::of(1.0);
        let tail = Self { factors: shares.map(|share| (one + share).select(tells, one)), ..none };
        let summed = series(&|k| tail.factor(k));
        let better = is_better(&whole, &summed, |mu| exact_increment(&short, mu), &motions, SHARE);
        Ok(Self { factors: tail.factors.map(|factor| factor.select(better, one)), ..none })
    }
}

/// How much of a step a short one is.
fn share_of_step<T: Scalar>() -> T {
    T::of(1.0 / SHORT_STEPS as f64)
}

/// A step of the exact flow: its x and p, and the momentum after it.
struct ExactStep<V> {
    x: V,
    p: V,
    end: V,
}

/// That from `mu`, by steps of `short`; none where they fail or their product has no coordinate.
fn exact_step<S: Integrator + Predict>(
    short: &S,
    mu: &VectorOf<S>,
) -> Option<ExactStep<VectorOf<S>>> {
    let (group, chart) = (short.group(), S::Chart::default());
    let (increment, end) = exact_increment(short, mu).ok()?;
    let x = chart.coordinate(group, &increment)?;
    let p = chart.pull_back(group, &x, mu);
    Some(ExactStep { x, p, end })
}

/// The increment of that step, by steps of `short`.
fn exact_increment<S: Integrator + Predict>(
    short: &S,
    mu: &VectorOf<S>,
) -> Result<Moved<S>, StepError> {
    let group = short.group();
    let (mut increment, mut start) = (group.identity(), mu.clone());
    for _ in 0..SHORT_STEPS {
        // The first guess is still that of a long step.
        let mut ahead = short.predict(&start).minus(&start);
        for i in 0..ahead.dim() {
            ahead[i] *= share_of_step::<ScalarOf<S>>();
        }
        let (part, end) = step_from(short, &start, start.clone().plus(&ahead))?;
        increment = group.compose(&increment, &part);
        start = end;
    }
    Ok((increment, start))
}
