//! What a step moves: a phase point, a compensated one, or a momentum alone.

use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;
use crate::step::phase::Phase;

/// Something that a group increment moves.
pub(super) trait Moves<G: LieGroup> {
    /// The momentum now.
    fn momentum(&self) -> &G::Vector;

    /// (g, μ) ↦ (g·k, Ad\*_{k⁻¹} μ), given both k and the moved momentum.
    fn move_by(&mut self, group: &G, k: &G::Element, moved: G::Vector);
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
}

/// A momentum alone: a point of 𝔤\*.
pub(super) struct Momentum<G: LieGroup>(pub G::Vector);

impl<G: LieGroup> Moves<G> for Momentum<G> {
    #[inline(always)]
    fn momentum(&self) -> &G::Vector {
        &self.0
    }

    #[inline(always)]
    fn move_by(&mut self, _: &G, _: &G::Element, moved: G::Vector) {
        self.0 = moved;
    }
}

/// Zero where all coordinates are finite, else NaN.
#[inline(always)]
pub(super) fn finite_or_nan<T: Scalar, V: Coordinates<T>>(mu: &V) -> T {
    let mut sum = T::of(0.0);
    for i in 0..mu.dim() {
        sum = mu[i].times_plus(T::of(0.0), sum);
    }
    sum
}
