//! Quadratic forms on a Lie algebra.

use crate::number::Rational;
use num_traits::{ToPrimitive, Zero};
use std::collections::BTreeMap;

/// A quadratic form Σ c_ij x_i x_j in the coordinates of an algebra, with exact coefficients.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct QuadraticForm {
    terms: BTreeMap<(usize, usize), Rational>,
}

impl QuadraticForm {
    /// The form with these entries (i, j, c); those at the same pair, in either order, are added.
    pub(super) fn from_entries(
        entries: impl IntoIterator<Item = (usize, usize, Rational)>,
    ) -> Self {
        let mut terms: BTreeMap<(usize, usize), Rational> = BTreeMap::new();
        for (i, j, value) in entries {
            *terms.entry((i.min(j), i.max(j))).or_insert_with(Rational::zero) += value;
        }
        terms.retain(|_, value| !value.is_zero());
        Self { terms }
    }

    /// The terms (i, j, c_ij) with i ≤ j and c_ij ≠ 0, ascending; coordinates count from zero, and
    /// the coefficient of x_i x_j is c_ij (not half of it).
    pub fn terms(&self) -> impl Iterator<Item = (usize, usize, &Rational)> + '_ {
        self.terms.iter().map(|(&(i, j), value)| (i, j, value))
    }

    /// Whether the form vanishes.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The value at `x`; coordinates beyond its length count as zero.
    #[must_use]
    pub fn value(&self, x: &[f64]) -> f64 {
        let at = |i: usize| x.get(i).copied().unwrap_or(0.0);
        self.terms().map(|(i, j, c)| c.to_f64().unwrap_or(f64::NAN) * at(i) * at(j)).sum()
    }

    /// The same form in other coordinates: x_i of this one is x_`places[i]`.
    pub(super) fn moved(&self, places: &[usize]) -> Self {
        Self::from_entries(self.terms().map(|(i, j, c)| (places[i], places[j], c.clone())))
    }

    pub(super) fn scaled(&self, factor: &Rational) -> Self {
        Self::from_entries(self.terms().map(|(i, j, c)| (i, j, c * factor)))
    }
}
