//! How far the series has come to mean nothing: the ratio of its terms.

use coadjoint::groups::{Chart, Coordinates};
use coadjoint::{GeneratingFunction, LieGroup, Scalar, plumbing};

use super::interpreter::Interpreter;

/// Measures the ratio of terms by which steps are judged where it may be above [`STEEP`](super::STEEP).
pub struct Steepness<'s, S> {
    step: &'s S,
}

impl<'s, 'a, G: LieGroup<Scalar = f64>, C: Chart<G>> Steepness<'s, Interpreter<'a, G, C>> {
    /// For the steps of an interpreter.
    pub fn new(step: &'s Interpreter<'a, G, C>) -> Self {
        Self { step }
    }

    /// The ratio at p, of the last two terms of ∂S or that which the rate at which motions part stands for; 0 where it is
    /// known to be at most [`STEEP`](super::STEEP) and p need not be looked at.
    pub fn ratio(&self, p: &G::Vector) -> f64 {
        let quiet = p.pairing(p).sqrt() <= self.step.quiet;
        let of_terms = if quiet { 0.0 } else { self.step.series_ratio(p) };
        if self.step.largest_rate() >= f64::MAX {
            return of_terms;
        }
        of_terms.worse(plumbing::estimated_ratio(self.step, p, &self.step.gradient(p)))
    }
}
