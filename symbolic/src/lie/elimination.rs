//! Sparse exact elimination.

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use crate::cancel;
use crate::lie::RationalMatrix;
use crate::number::{Rational, integer};

/// A row: its entries that are not zero, by column.
pub(crate) type Row = BTreeMap<u32, Rational>;

/// Rows by pivot. The pivot of a row is its first column; its entry there is one.
pub(crate) struct Echelon {
    rows: BTreeMap<u32, Row>,
    operations: u64,
    limit: u64,
}

/// More multiplications than allowed.
pub(crate) struct Exceeded;

impl Echelon {
    pub(crate) fn new(limit: u64) -> Self {
        Self { rows: BTreeMap::new(), operations: 0, limit }
    }

    /// The remainder of a row without multiples of those in the echelon, and the multiplications that took; the row is not
    /// finished where the work exceeds the limit.
    pub(crate) fn reduced(&self, mut row: Row) -> (Row, u64) {
        let mut operations = 0;
        let mut at = row.keys().next().copied();
        while let Some(column) = at {
            cancel::check();
            if let (Some(pivot), Some(value)) = (self.rows.get(&column), row.get(&column).cloned())
            {
                operations += pivot.len() as u64;
                if self.operations + operations > self.limit {
                    break;
                }
                subtract(&mut row, pivot, &value);
            }
            at = row.range(column + 1..).next().map(|(c, _)| *c);
        }
        (row, operations)
    }

    /// Adds a row. Returns what is left of it after reduction, scaled to a leading one, or nothing
    /// if it depends on the rows before (or the work exceeds the limit; see
    /// [`within_limit`](Self::within_limit)).
    pub(crate) fn insert(&mut self, row: Row) -> Option<Row> {
        let (mut row, operations) = self.reduced(row);
        self.operations += operations;
        if self.operations > self.limit {
            return None;
        }
        let (&lead, value) = row.first_key_value()?;
        let inverse = value.recip();
        for value in row.values_mut() {
            *value *= &inverse;
        }
        self.rows.insert(lead, row.clone());
        Some(row)
    }

    pub(crate) fn within_limit(&self) -> Result<(), Exceeded> {
        if self.operations > self.limit { Err(Exceeded) } else { Ok(()) }
    }

    /// Vectors spanning what all rows annihilate, in columns 0..`columns`: one for each column
    /// without pivot, being one there and zero at the others without pivot.
    pub(crate) fn kernel(mut self, columns: u32) -> Result<Vec<Row>, Exceeded> {
        // From the last pivot to the first, every row is freed of other pivots.
        let pivots: Vec<u32> = self.rows.keys().rev().copied().collect();
        for pivot in pivots {
            let Some(mut row) = self.rows.remove(&pivot) else { continue };
            let others: Vec<u32> = row.keys().copied().filter(|c| *c != pivot).collect();
            for column in others {
                if let (Some(other), Some(value)) =
                    (self.rows.get(&column), row.get(&column).cloned())
                {
                    self.operations += other.len() as u64;
                    subtract(&mut row, other, &value);
                }
            }
            self.rows.insert(pivot, row);
            self.within_limit()?;
        }
        let mut kernel: BTreeMap<u32, Row> = BTreeMap::new();
        for column in 0..columns {
            if !self.rows.contains_key(&column) {
                kernel.insert(column, BTreeMap::from([(column, Rational::one())]));
            }
        }
        for (pivot, row) in &self.rows {
            for (column, value) in row {
                if let Some(vector) = kernel.get_mut(column) {
                    vector.insert(*pivot, -value);
                }
            }
        }
        Ok(kernel.into_values().collect())
    }
}

/// Multiplications in a search for vectors at most.
const OPERATIONS: u64 = 10_000_000;

/// A basis of the vectors in `dim` coordinates that all rows take to zero, in reduced echelon form; empty where that is too
/// much work to find.
pub(crate) fn null_space(rows: impl IntoIterator<Item = Row>, dim: usize) -> Vec<Vec<Rational>> {
    let mut echelon = Echelon::new(OPERATIONS);
    let mut rank = 0;
    for row in rows {
        rank += usize::from(echelon.insert(row).is_some());
        if rank == dim || echelon.within_limit().is_err() {
            return Vec::new();
        }
    }
    let dense = |vector: Row| {
        let entry = |i: usize| vector.get(&(i as u32)).cloned().unwrap_or_else(|| integer(0));
        (0..dim).map(entry).collect()
    };
    echelon.kernel(dim as u32).unwrap_or_default().into_iter().map(dense).collect()
}

fn subtract(row: &mut Row, other: &Row, factor: &Rational) {
    for (column, value) in other {
        let slot = row.entry(*column).or_insert_with(Rational::zero);
        *slot -= factor * value;
        if slot.is_zero() {
            row.remove(column);
        }
    }
}

/// A set of independent matrices of one size, prepared for finding coordinates in their span.
///
/// Rows of the echelon are the entries of matrices, and behind them in a column for each of the given matrices how
/// they are made of these.
pub(crate) struct Span {
    echelon: Echelon,
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

    fn row(&self, matrix: &RationalMatrix) -> Row {
        let entries = matrix.entries();
        entries.map(|(i, j, value)| ((i * self.columns + j) as u32, value.clone())).collect()
    }
}

impl RationalMatrix {
    /// The inverse of a square matrix; nothing where there is none.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{integer, ratio};

    fn row(values: &[i64]) -> Row {
        let entries = values.iter().enumerate().filter(|(_, v)| **v != 0);
        entries.map(|(column, v)| (column as u32, integer(*v))).collect()
    }

    #[test]
    fn kernel_of_a_small_matrix() {
        let mut echelon = Echelon::new(1000);
        assert!(echelon.insert(row(&[1, 2, 3, 4])).is_some());
        assert!(echelon.insert(row(&[2, 4, 6, 8])).is_none());
        assert!(echelon.insert(row(&[0, 0, 2, 1])).is_some());
        let kernel = echelon.kernel(4).ok().unwrap();
        let half = BTreeMap::from([(0, ratio(-5, 2)), (2, ratio(-1, 2)), (3, integer(1))]);
        assert_eq!(kernel, [row(&[-2, 1]), half]);
    }

    #[test]
    fn work_is_limited() {
        let mut echelon = Echelon::new(5);
        for i in 1..6 {
            echelon.insert(row(&[1, i, i * i, i * i * i]));
        }
        assert!(echelon.within_limit().is_err());
        assert!(echelon.kernel(4).is_err());
    }
}
