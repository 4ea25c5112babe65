//! What a step moves: a phase point, or a momentum alone.

use nalgebra::{SimdBool, SimdPartialOrd};

use super::check;
use crate::error::StepError;
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;
use crate::step::phase::Phase;

/// Something that a group increment moves.
pub(super) trait Moves<G: LieGroup>: Clone {
    /// The momentum now.
    fn momentum(&self) -> &G::Vector;

    /// (g, μ) ↦ (g·k, Ad\*_{k⁻¹} μ), given both k and the moved momentum.
    fn move_by(&mut self, group: &G, k: &G::Element, moved: G::Vector);

    /// Whether it is finite, and its group element on the group.
    ///
    /// # Errors
    /// What is wrong with it.
    fn check(&self, group: &G) -> Result<(), StepError>;
}

impl<G: LieGroup> Moves<G> for Phase<G> {
    #[inline(always)]
    fn momentum(&self) -> &G::Vector {
        &self.momentum
    }

    #[inline(always)]
    fn move_by(&mut self, group: &G, k: &G::Element, moved: G::Vector) {
        self.group_element = group.compose(&self.group_element, k);
        self.momentum = moved;
    }

    #[inline(always)]
    fn check(&self, group: &G) -> Result<(), StepError> {
        check(group, self)
    }
}

/// A momentum alone: a point of 𝔤\*.
pub(super) struct Momentum<G: LieGroup>(pub G::Vector);

// A derived one would ask for `G: Clone`.
impl<G: LieGroup> Clone for Momentum<G> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<G: LieGroup> Moves<G> for Momentum<G> {
    #[inline(always)]
    fn momentum(&self) -> &G::Vector {
        &self.0
    }

    #[inline(always)]
    fn move_by(&mut self, _: &G, _: &G::Element, moved: G::Vector) {
        self.0 = moved;
    }

    #[inline(always)]
    fn check(&self, _: &G) -> Result<(), StepError> {
        match finite_or_nan(&self.0).simd_le(T::<G>::of(0.0)).all() {
            true => Ok(()),
            false => Err(StepError::Overflow),
        }
    }
}

type T<G> = <G as LieGroup>::Scalar;

/// Zero where all coordinates are finite, else NaN.
#[inline(always)]
pub(super) fn finite_or_nan<T: Scalar, V: Coordinates<T>>(mu: &V) -> T {
    let mut sum = T::of(0.0);
    for i in 0..mu.dim() {
        sum = mu[i].times_plus(T::of(0.0), sum);
    }
    sum
}
