//! Generating functions whose coefficients can be chosen anew.

use crate::generating::{GeneratingFunction, ScalarOf};

/// A polynomial generating function with adjustable coefficients: every generated integrator is one.
/// [`fit`](crate::tune::fit) adjusts them to a motion.
pub trait Adjustable: GeneratingFunction + Sized {
    /// K, the truncation of the series.
    fn truncation(&self) -> usize;

    /// How many adjustable terms there are: those of S, and after them those of the first guess.
    fn terms(&self) -> usize;

    /// The term with this number, below [`Adjustable::terms`].
    fn term(&self, number: usize) -> Term<'_>;

    /// The function with correctionᵢ · monomialᵢ added for every term. Its series is no longer judged by the ratio
    /// of its terms: whoever adjusts it judges it where it is used.
    #[must_use]
    fn adjusted(&self, corrections: &[ScalarOf<Self>]) -> Self;
}

/// A term of an [`Adjustable`] function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term<'a> {
    /// What it is a term of.
    pub of: TermOf,
    /// Its monomial, as pairs of a coordinate and its exponent.
    pub monomial: &'a [(u32, u32)],
    /// The highest power of the step size in its coefficient: k for a term of S_k.
    pub order: usize,
}

/// What a [`Term`] is a term of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermOf {
    /// S(p).
    Series,
    /// That coordinate of the first guess, its polynomial in μ that is even in the step size
    /// ([`Predict::predict_after`](crate::solve::Predict::predict_after) takes it twice).
    Guess(usize),
}
