//! How far the series has come to mean nothing: the ratio of its terms.

use coadjoint::{Chart, Coordinates, GeneratingFunction, LieGroup, Scalar, plumbing};

use super::Interpreter;
use super::interpreter::of_last;

/// Above this ratio of terms a run says so; above twice this its steps are refused.
pub const STEEP: f64 = 0.25;

/// Measures the ratio of terms by which steps are judged where it may be above [`STEEP`].
pub struct Steepness<'s, S> {
    step: &'s S,
    /// The |μ| up to which the ratio is at most [`STEEP`] in every direction.
    quiet: f64,
}

impl<'s, 'a, G: LieGroup<Scalar = f64>, C: Chart<G>> Steepness<'s, Interpreter<'a, G, C>> {
    /// For the steps of an interpreter.
    pub fn new(step: &'s Interpreter<'a, G, C>) -> Self {
        let truncation = step.integrator.problem.truncation;
        // One half is the ratio that a radius is of: with the last term doubled, a quarter.
        let doubled = of_last(step.integrator, &step.last).map(|(value, order, monomial)| {
            (if order == truncation { 2.0 * value } else { value }, order, monomial)
        });
        Self { step, quiet: plumbing::radius_of(truncation, &step.factors, doubled) }
    }

    /// The ratio at p, of the last two terms of ∂S or that which the rate at which motions part stands for; 0 where it is
    /// known to be at most [`STEEP`] and p need not be looked at.
    pub fn ratio(&self, p: &G::Vector) -> f64 {
        let quiet = p.pairing(p).sqrt() <= self.quiet;
        let of_terms = if quiet { 0.0 } else { self.step.series_ratio(p) };
        if self.step.largest_rate() >= f64::MAX {
            return of_terms;
        }
        of_terms.worse(plumbing::estimated_ratio(self.step, p, &self.step.gradient(p)))
    }
}
