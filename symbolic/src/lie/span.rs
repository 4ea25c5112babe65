//! Coordinates in the span of matrices, by exact elimination.

use super::{Echelon, RationalMatrix};
use crate::number::{Rational, integer};
use std::collections::BTreeMap;

/// A set of independent matrices of one size, prepared for finding coordinates in their span.
///
/// Rows of the echelon are the entries of matrices, and behind them in a column for each of the given matrices how
/// they are made of these.
pub(crate) struct Span {
    echelon: Echelon<Rational>,
    entries: u32,
    columns: usize,
}

impl Span {
    /// Fails with the index of the first matrix that depends on those before it.
    pub(crate) fn new(matrices: &[RationalMatrix]) -> Result<Self, usize> {
        let (rows, columns) = matrices.first().map_or((0, 0), |one| (one.rows(), one.columns()));
        let entries = (rows * columns) as u32;
        let mut span = Self { echelon: Echelon::new(u64::MAX), entries, columns };
        for (index, matrix) in matrices.iter().enumerate() {
            let mut row = span.row(matrix);
            row.insert(entries + index as u32, integer(1));
            let rest = span.echelon.insert(row);
            if rest.is_none_or(|rest| rest.range(..entries).next().is_none()) {
                return Err(index);
            }
        }
        Ok(span)
    }

    /// The coordinates of a matrix, or nothing if it lies outside the span.
    pub(crate) fn coordinates(&self, matrix: &RationalMatrix) -> Option<Vec<(usize, Rational)>> {
        let (rest, _) = self.echelon.reduced(self.row(matrix));
        let coordinate = |(column, value): (u32, Rational)| {
            Some((column.checked_sub(self.entries)? as usize, -value))
        };
        rest.into_iter().map(coordinate).collect()
    }

    fn row(&self, matrix: &RationalMatrix) -> BTreeMap<u32, Rational> {
        let entries = matrix.entries();
        entries.map(|(i, j, value)| ((i * self.columns + j) as u32, value.clone())).collect()
    }
}

impl RationalMatrix {
    /// The inverse of a square matrix; nothing where there is none.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        if self.rows() != self.columns() {
            return None;
        }
        let mut rows = vec![Self::zero(1, self.columns()); self.rows()];
        self.entries().for_each(|(i, j, value)| rows[i].add_to(0, j, value.clone()));
        let span = Span::new(&rows).ok()?;
        let mut result = Self::zero(self.rows(), self.columns());
        for i in 0..self.rows() {
            let unit = Self::from_entries(1, self.columns(), [(0, i, integer(1))]);
            for (j, value) in span.coordinates(&unit)? {
                result.add_to(i, j, value);
            }
        }
        Some(result)
    }
}
