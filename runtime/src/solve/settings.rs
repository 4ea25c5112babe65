//! The options of the solve of a step.

use crate::number::scalar::Scalar;

/// How exactly a step is solved, and which series are taken seriously. The default is what
/// [`advance`](crate::steps::advance) uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<T> {
    tolerance: T,
    any_ratio: bool,
}

impl<T: Scalar> Default for Settings<T> {
    /// To rounding (four units of it), and a series whose last two terms have a ratio of at most ½.
    #[inline(always)]
    fn default() -> Self {
        Self { tolerance: T::of(4.0) * T::epsilon(), any_ratio: false }
    }
}

impl<T: Scalar> Settings<T> {
    /// Steps are solved until what is left of J_L(x, p) = μ, relative to the largest coordinate of μ, is at most this;
    /// not below four units of rounding. Momentum and Casimirs are exact all the same; the map is symplectic, and keeps
    /// integrals of symmetry other than the group's own, up to this.
    #[inline(always)]
    #[must_use]
    pub fn with_tolerance(self, tolerance: T) -> Self {
        Self { tolerance: tolerance.simd_max(Self::default().tolerance), ..self }
    }

    /// Accepts steps whatever the ratio of the last two terms of the series: for those who know that S is meant even
    /// where its series no longer converges. All other tests stand.
    #[inline(always)]
    #[must_use]
    pub fn with_any_ratio(self) -> Self {
        Self { any_ratio: true, ..self }
    }

    /// See [`Settings::with_tolerance`].
    #[inline(always)]
    #[must_use]
    pub fn tolerance(&self) -> T {
        self.tolerance
    }

    /// See [`Settings::with_any_ratio`].
    #[inline(always)]
    #[must_use]
    pub fn takes_any_ratio(&self) -> bool {
        self.any_ratio
    }
}
