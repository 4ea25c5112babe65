//! A step as a method of solution proposes it, and the sizes by which it is judged.

use crate::generating::{ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// A step as a method of solution proposes it.
#[derive(Clone, Debug)]
pub struct Candidate<V, T> {
    /// The chart coordinate of the group increment.
    pub x: V,
    /// How far the solution lies from the first guess of p, relative to the largest coordinate of μ.
    pub moved: T,
    /// A bound on what is left of p − (d^R τ_x)ᵀ μ, relative to the largest coordinate of μ.
    pub residual: T,
    /// Newton iterations, or evaluations of the fixed point (in lanes: until the last lane was done).
    pub iterations: u32,
}

/// A candidate for a step of `S`.
pub type CandidateOf<S> = Candidate<VectorOf<S>, ScalarOf<S>>;

/// A solution this near to its first guess, relative to μ, is the one continued from the identity, since the guess is
/// (tried by the program `stress`, not proven).
pub(super) const NEAR: f64 = 0.05;

/// The inverse of the largest coordinate of μ, by which sizes are measured; μ = 0, whose solution is p = 0, must not
/// divide 0 by 0.
pub(super) fn inverse_scale<T: Scalar, V: Coordinates<T>>(mu: &V) -> T {
    T::of(1.0) / (mu.largest_entry() + T::of(f64::from(f32::MIN_POSITIVE)))
}
