//! Groups whose steps can be accumulated with compensation for rounding.

use core::fmt::Debug;

use super::LieGroup;
use crate::number::scalar::Scalar;

/// A group whose elements and momenta can be moved by small increments without cancellation.
pub trait CompensatedGroup: LieGroup {
    /// What an element's last rounding left over.
    type Remainder: Clone + Debug;

    /// Nothing left over.
    fn no_remainder(&self) -> Self::Remainder;

    /// Ad\*_{k⁻¹} μ − μ for an increment k near the neutral element, accurate relative to its own
    /// size.
    fn momentum_change(&self, k: &Self::Element, mu: &Self::Vector) -> Self::Vector;

    /// Replaces g by g·k, carrying the rounding along in `remainder`.
    fn compose_compensated(
        &self,
        g: &mut Self::Element,
        remainder: &mut Self::Remainder,
        k: &Self::Element,
    );
}

/// sum + (change − remainder), with the new remainder: Kahan's step.
#[inline(always)]
pub(crate) fn kahan<T: Scalar>(sum: &mut T, remainder: &mut T, change: T) {
    let corrected = change - *remainder;
    let next = *sum + corrected;
    *remainder = (next - *sum) - corrected;
    *sum = next;
}
