//! Square rational matrices, stored by their nonzero entries.

use crate::number::Rational;
use num_traits::Zero;
use std::collections::BTreeMap;

/// A matrix of exact rationals, stored by its nonzero entries.
///
/// A basis of SO(3)^256 has 768 matrices of size 768 × 768 with two entries each, so only the
/// nonzero entries are kept.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RationalMatrix {
    rows: usize,
    columns: usize,
    entries: BTreeMap<(usize, usize), Rational>,
}

impl RationalMatrix {
    /// The zero matrix.
    pub fn zero(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: BTreeMap::new() }
    }

    /// The matrix with these rows; the longest row gives the number of columns and shorter rows
    /// are filled with zeros.
    pub fn from_rows(rows: impl IntoIterator<Item = Vec<Rational>>) -> Self {
        let mut result = Self::zero(0, 0);
        for (i, row) in rows.into_iter().enumerate() {
            result.rows = i + 1;
            result.columns = result.columns.max(row.len());
            for (j, value) in row.into_iter().enumerate() {
                if !value.is_zero() {
                    result.entries.insert((i, j), value);
                }
            }
        }
        result
    }

    /// The `rows` × `columns` matrix with these entries (row, column, value); entries outside are
    /// dropped and entries at the same place are added.
    pub fn from_entries(
        rows: usize,
        columns: usize,
        entries: impl IntoIterator<Item = (usize, usize, Rational)>,
    ) -> Self {
        let mut result = Self::zero(rows, columns);
        for (i, j, value) in entries {
            if i < rows && j < columns {
                result.add_to(i, j, value);
            }
        }
        result
    }

    pub(super) fn add_to(&mut self, i: usize, j: usize, value: Rational) {
        let slot = self.entries.entry((i, j)).or_insert_with(Rational::zero);
        *slot += value;
        if slot.is_zero() {
            self.entries.remove(&(i, j));
        }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The entry at (row, column), counted from zero.
    pub fn get(&self, row: usize, column: usize) -> Rational {
        self.entries.get(&(row, column)).cloned().unwrap_or_else(Rational::zero)
    }

    /// The nonzero entries (row, column, value), row by row.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &Rational)> + '_ {
        self.entries.iter().map(|(&(i, j), value)| (i, j, value))
    }

    /// True if the transpose is the negative. Exponentials of such matrices are orthogonal.
    pub fn is_antisymmetric(&self) -> bool {
        self.entries().all(|(i, j, value)| self.get(j, i) == -value.clone())
    }

    /// True if every entry is zero.
    pub(crate) fn is_zero(&self) -> bool {
        self.entries.is_empty()
    }

    /// The product with another matrix.
    pub fn times(&self, other: &Self) -> Self {
        let mut result = Self::zero(self.rows, other.columns);
        for (&(i, k), a) in &self.entries {
            for (&(_, j), b) in other.entries.range((k, 0)..(k + 1, 0)) {
                result.add_to(i, j, a * b);
            }
        }
        result
    }

    /// The sum with `factor` times another matrix.
    pub fn plus(&self, other: &Self, factor: &Rational) -> Self {
        let mut result = self.clone();
        for (&(i, j), value) in &other.entries {
            result.add_to(i, j, value * factor);
        }
        result
    }

    /// The commutator `self·other − other·self`.
    pub(crate) fn commutator(&self, other: &Self) -> Self {
        self.times(other).plus(&other.times(self), &crate::number::integer(-1))
    }
}
