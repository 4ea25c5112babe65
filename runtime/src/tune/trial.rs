//! Whether chosen coefficients are better than the series: both are tried against the exact flow.
//!
//! Small errors of single steps say little: those of the series come and go along a motion, and what piles up
//! from step to step may be much less than they are. So both maps make many steps in a row, and the
//! errors of what they lead to are compared. A motion may linger for long, near a separatrix, and then go where nothing
//! has been seen of it: so it is followed further, and single steps are compared on the way.

use core::array::from_fn;

use nalgebra::SimdPartialOrd;

use crate::chart::Chart;
use crate::error::StepError;
use crate::generating::{ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;
use crate::solve::{Integrator, Predict, solve_from};

/// Steps of a trial.
const STEPS: usize = 256;

/// Steps for which a motion is followed after them, and every how many-th of these both maps are compared. With 64 steps
/// and none later four in a thousand of 10 800 motions of free bodies were worse at T = 100 for it, some fitted ones
/// altogether wrong: those that had lingered near a separatrix all through the trial.
const LATER: usize = 256;
const LOOK: usize = 4;

/// Motions that are tried at most, evenly chosen among those given.
const MOTIONS: usize = 8;

type Element<S> = <<S as crate::GeneratingFunction>::Group as LieGroup>::Element;

/// An increment of the group, and the momentum after it.
pub(super) type Moved<S> = (Element<S>, VectorOf<S>);

/// A step of S from `mu`, a comoving frame's own motion left out, the solve begun at this guess of p.
#[inline(never)]
pub(super) fn step_from<S: Integrator>(
    generating: &S,
    mu: &VectorOf<S>,
    guess: VectorOf<S>,
) -> Result<Moved<S>, StepError> {
    let x = solve_from(generating, mu, guess)?.x;
    Ok(S::Chart::default().transport(generating.group(), &x, mu))
}

/// The same from the function's own guess.
pub(super) fn step<S: Integrator + Predict>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<Moved<S>, StepError> {
    step_from(generating, mu, generating.predict(mu))
}

/// The momentum about one step later, by the first guess of x where there is one; a comoving frame's own motion
/// left out. Near enough to the motion to look at it there.
pub(super) fn about_onwards<S: Integrator + Predict>(
    generating: &S,
    mu: &VectorOf<S>,
) -> Result<VectorOf<S>, StepError> {
    match generating.predict_increment(mu) {
        Some(x) => Ok(S::Chart::default().transport(generating.group(), &x, mu).1),
        None => step(generating, mu).map(|(_, end)| end),
    }
}

/// Up to [`MOTIONS`] of the momenta that pass by, evenly spread over all of them.
pub(super) struct Sample<V> {
    kept: [Option<V>; MOTIONS],
    /// How many are kept, how many have passed, and every how many-th is kept.
    count: usize,
    passed: usize,
    stride: usize,
}

impl<V> Sample<V> {
    /// Nothing yet.
    pub(super) fn new() -> Self {
        Self { kept: from_fn(|_| None), count: 0, passed: 0, stride: 1 }
    }

    /// Takes note of another momentum.
    pub(super) fn pass(&mut self, momentum: &V)
    where
        V: Clone,
    {
        if self.passed.is_multiple_of(self.stride) {
            if self.count == MOTIONS {
                for n in 0..MOTIONS {
                    let kept = if 2 * n < MOTIONS { self.kept[2 * n].take() } else { None };
                    self.kept[n] = kept;
                }
                (self.count, self.stride) = (MOTIONS / 2, 2 * self.stride);
            }
            if self.passed.is_multiple_of(self.stride) {
                self.kept[self.count] = Some(momentum.clone());
                self.count += 1;
            }
        }
        self.passed += 1;
    }

    fn iter(&self) -> impl Iterator<Item = &V> {
        self.kept.iter().flatten()
    }
}

/// In which lanes `chosen` makes at most this share of the errors of `plain` over [`STEPS`] steps of each of the motions, and
/// in single steps later on. `exact` makes a step of the exact flow. In none where a step fails, or where there is no
/// motion.
pub(super) fn is_better<S: Integrator + Predict>(
    plain: &S,
    chosen: &S,
    exact: impl Fn(&VectorOf<S>) -> Result<Moved<S>, StepError>,
    motions: &Sample<VectorOf<S>>,
    share: f64,
) -> <ScalarOf<S> as nalgebra::SimdValue>::SimdBool {
    let zero = ScalarOf::<S>::of(0.0);
    let (mut along, mut later) = ([zero; 2], [zero; 2]);
    for start in motions.iter() {
        let Some((more, after)) = errors_of(plain, chosen, &exact, start) else {
            return zero.simd_gt(zero);
        };
        along = from_fn(|n| along[n] + more[n]);
        later = from_fn(|n| later[n] + after[n]);
    }
    // Of the sums of squares.
    let share = ScalarOf::<S>::of(share * share);
    let ([of_plain, of_chosen], [plain_later, chosen_later]) = (along, later);
    of_chosen.simd_le(of_plain * share)
        & of_plain.simd_gt(zero)
        & chosen_later.simd_le(plain_later * share)
}

/// Sums of the squares of the errors of both maps, for what is not a number stays in them.
type Errors<S> = [ScalarOf<S>; 2];

/// The square of how far apart two elements are, of the first its inverse; none where that is beyond the chart. The momentum
/// is the group action on that at the start, so its error follows from this one.
fn apart<G: LieGroup>(group: &G, inverse: &G::Element, found: &G::Element) -> Option<G::Scalar> {
    let apart = group.log(&group.compose(inverse, found))?;
    Some(apart.pairing(&apart))
}

/// The errors along the motion from `start`, and those of single steps later on; none where a step fails.
fn errors_of<S: Integrator + Predict>(
    plain: &S,
    chosen: &S,
    exact: &impl Fn(&VectorOf<S>) -> Result<Moved<S>, StepError>,
    start: &VectorOf<S>,
) -> Option<(Errors<S>, Errors<S>)> {
    let group = plain.group();
    let mut errors = [ScalarOf::<S>::of(0.0); 2];
    let mut truth = (group.identity(), start.clone());
    let mut tried: [_; 2] = from_fn(|_| truth.clone());
    for _ in 0..STEPS {
        let (increment, end) = exact(&truth.1).ok()?;
        truth = (group.compose(&truth.0, &increment), end);
        let inverse = group.inverse(&truth.0);
        for ((map, at), error) in [plain, chosen].into_iter().zip(&mut tried).zip(&mut errors) {
            let (increment, end) = step(map, &at.1).ok()?;
            *at = (group.compose(&at.0, &increment), end);
            *error += apart(group, &inverse, &at.0)?;
        }
    }
    Some((errors, errors_later(plain, chosen, exact, truth.1)?))
}

/// The errors of single steps from where the motion is every so many steps after this momentum.
fn errors_later<S: Integrator + Predict>(
    plain: &S,
    chosen: &S,
    exact: &impl Fn(&VectorOf<S>) -> Result<Moved<S>, StepError>,
    mut mu: VectorOf<S>,
) -> Option<Errors<S>> {
    let group = plain.group();
    let mut errors = [ScalarOf::<S>::of(0.0); 2];
    for number in 0..LATER {
        if number % LOOK == 0 {
            let inverse = group.inverse(&exact(&mu).ok()?.0);
            for (map, error) in [plain, chosen].into_iter().zip(&mut errors) {
                *error += apart(group, &inverse, &step(map, &mu).ok()?.0)?;
            }
        }
        mu = about_onwards(plain, &mu).ok()?;
    }
    Some(errors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_are_chosen_evenly() {
        for count in [0, 1, 5, 8, 9, 16, 17, 100, 1000] {
            let mut sample = Sample::new();
            (0..count).for_each(|n: usize| sample.pass(&n));
            let kept: std::vec::Vec<usize> = sample.iter().copied().collect();
            assert!(kept.len() <= MOTIONS && kept.len() >= count.min(MOTIONS / 2), "{kept:?}");
            let stride = kept.get(1).copied().unwrap_or(1);
            assert!(kept.iter().enumerate().all(|(place, &n)| n == place * stride), "{kept:?}");
            assert!(kept.last().is_none_or(|&last| last + stride >= count), "{kept:?}");
        }
    }
}
