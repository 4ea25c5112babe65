//! A step as a method of solution proposes it, and the sizes by which it is judged.

use nalgebra::SimdBool;

use crate::generating::{GeneratingFunction, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// A step as a method of solution proposes it.
#[derive(Clone, Debug)]
pub struct Candidate<V, T> {
    /// The chart coordinate of the group increment.
    pub x: V,
    /// The distance of the solution from the first guess of p, relative to the largest coordinate of μ.
    pub moved: T,
    /// The residual p − (d^R τ_x)ᵀ μ, relative to the largest coordinate of μ.
    pub residual: T,
    /// Folds and forks of the equation at x.
    pub branch: Branch,
    /// Newton iterations, or evaluations of the fixed point (in lanes: until the last lane was done).
    pub iterations: u32,
}

/// Folds and forks of x = s ∂S(p) at a solution for an s from 0 to 1, as far as the matrices there tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// It has none: ‖∂p/∂x·Hess S‖ < 1, for the sums of rows.
    Only,
    /// The leading minors of 1 − ∂p/∂x·Hess S that belong to direct factors of the group are positive, as they are at the
    /// identity.
    Oriented,
    /// The equation bends much between the guess and x, which may be any of its solutions.
    Bent,
    /// Nothing is known, or the equation is not solved to rounding.
    Unknown,
}

/// A candidate for a step of `S`.
pub type CandidateOf<S> = Candidate<VectorOf<S>, ScalarOf<S>>;

/// The residual of a solved equation, relative to the largest coordinate of μ: rounding of many coordinates may stay above
/// four units of it, and S may have more of its own.
pub(super) fn rounding<S: GeneratingFunction + ?Sized>(generating: &S) -> ScalarOf<S> {
    let dim = generating.group().dim();
    let units = (4.0 * dim as f64).min(32.0) * generating.rounding();
    ScalarOf::<S>::of(units.max(4.0)) * ScalarOf::<S>::epsilon()
}

impl<V, T: Scalar> Candidate<V, T> {
    /// True if the candidate solves its equation within this distance of its first guess; false if the distance is NaN.
    pub(super) fn is_solution_within(&self, distance: f64) -> bool {
        self.branch != Branch::Unknown && self.moved.simd_le(T::of(distance)).all()
    }
}

/// A vector with the coordinates of a momentum in comparable units.
pub(super) fn sized<S: GeneratingFunction + ?Sized>(
    generating: &S,
    vector: &VectorOf<S>,
) -> VectorOf<S> {
    let unit = |i| ScalarOf::<S>::of(generating.unit(i));
    VectorOf::<S>::from_entries(vector.dim(), |i| vector[i] * unit(i))
}

/// The inverse of the largest coordinate of μ, by which sizes are measured; μ = 0, whose solution is p = 0, must not
/// divide 0 by 0.
pub(super) fn inverse_scale<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
) -> ScalarOf<S> {
    let smallest = ScalarOf::<S>::of(f64::from(f32::MIN_POSITIVE));
    ScalarOf::<S>::of(1.0) / (sized(generating, mu).largest_entry() + smallest)
}
