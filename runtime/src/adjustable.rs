//! Generating functions whose coefficients can be chosen anew.

use crate::generating_function::{GeneratingFunction, ScalarOf};

/// A polynomial generating function with adjustable coefficients: every generated integrator is one.
/// [`fit`](crate::fit) adjusts them to a motion.
pub trait Adjustable: GeneratingFunction + Sized {
    /// K, the truncation of the series.
    fn truncation(&self) -> usize;

    /// How many adjustable terms there are: those of S, and after them those of the first guess.
    fn terms(&self) -> usize;

    /// The term with this number, below [`Adjustable::terms`].
    fn term(&self, number: usize) -> Term<'_>;

    /// The function with correctionᵢ · monomialᵢ added for every term.
    #[must_use]
    fn adjusted(&self, corrections: &[ScalarOf<Self>]) -> Self;
}

/// A term of an [`Adjustable`] function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term<'a> {
    /// Where it belongs.
    pub part: Part,
    /// Its monomial, as pairs of a coordinate and its exponent.
    pub monomial: &'a [(u32, u32)],
    /// The highest power of the step size in its coefficient: k for a term of S_k.
    pub order: usize,
}

/// What a [`Term`] is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// S(p).
    Series,
    /// The part of a coordinate of the first guess that is even in the step size, a polynomial in μ
    /// ([`GeneratingFunction::predict_after`] takes it twice).
    Guess(usize),
}
