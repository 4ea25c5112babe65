//! Newton's method or the fixed point, whichever suits the dimension.

use super::{CandidateOf, FixedPoint, Method, Newton, NewtonModel, Predict, Settings};
use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;

/// Up to this dimension Newton's method is faster than the fixed point.
const LARGEST_DENSE: usize = 24;

/// [`Newton`]'s method up to 24 dimensions, the [`FixedPoint`] beyond: for any function at all.
#[derive(Clone, Debug)]
pub struct ByDimension<S: GeneratingFunction + ?Sized>(Option<Newton<S>>);

fn is_small<S: GeneratingFunction + ?Sized>(generating: &S) -> bool {
    generating.group().dim() <= LARGEST_DENSE
}

impl<S: NewtonModel + Predict + ?Sized> Method<S> for ByDimension<S> {
    fn begin(generating: &S) -> Self {
        Self(is_small(generating).then(|| Newton::begin(generating)))
    }

    fn propose(
        &mut self,
        generating: &S,
        mu: &VectorOf<S>,
        left: u64,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        match &mut self.0 {
            Some(newton) => newton.propose(generating, mu, left, settings),
            None => FixedPoint.propose(generating, mu, left, settings),
        }
    }

    fn forget(&mut self) {
        if let Some(newton) = &mut self.0 {
            Method::<S>::forget(newton);
        }
    }

    fn propose_from(
        generating: &S,
        mu: &VectorOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        match is_small(generating) {
            true => Newton::propose_from(generating, mu, guess, settings),
            false => FixedPoint::propose_from(generating, mu, guess, settings),
        }
    }

    fn propose_scaled(
        generating: &S,
        mu: &VectorOf<S>,
        scale: ScalarOf<S>,
        guess: VectorOf<S>,
        settings: Settings<ScalarOf<S>>,
    ) -> CandidateOf<S> {
        match is_small(generating) {
            true => Newton::propose_scaled(generating, mu, scale, guess, settings),
            false => FixedPoint::propose_scaled(generating, mu, scale, guess, settings),
        }
    }
}
