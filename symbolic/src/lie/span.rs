//! Coordinates in the span of matrices, by exact elimination.

use super::RationalMatrix;
use crate::number::Rational;
use num_traits::Zero;
use std::collections::BTreeMap;

type Vector = BTreeMap<(usize, usize), Rational>;

/// A set of independent matrices, prepared for finding coordinates in their span.
///
/// Every row is reduced: its pivot entry is one. `combination` says which combination of the
/// given matrices it is.
pub(crate) struct Span {
    rows: BTreeMap<(usize, usize), Row>,
}

struct Row {
    vector: Vector,
    combination: BTreeMap<usize, Rational>,
}

impl Span {
    /// Fails with the index of the first matrix that depends on those before it.
    pub(crate) fn new(matrices: &[RationalMatrix]) -> Result<Self, usize> {
        let mut span = Self { rows: BTreeMap::new() };
        for (index, matrix) in matrices.iter().enumerate() {
            let (mut rest, used) = span.reduce(matrix);
            let Some((pivot, lead)) = rest.iter().next().map(|(k, v)| (*k, v.clone())) else {
                return Err(index);
            };
            let mut combination: BTreeMap<_, _> =
                used.into_iter().map(|(i, c)| (i, -c / &lead)).collect();
            combination.insert(index, lead.recip());
            for value in rest.values_mut() {
                *value /= &lead;
            }
            span.rows.insert(pivot, Row { vector: rest, combination });
        }
        Ok(span)
    }

    /// The coordinates of a matrix, or nothing if it lies outside the span.
    pub(crate) fn coordinates(&self, matrix: &RationalMatrix) -> Option<Vec<(usize, Rational)>> {
        let (rest, used) = self.reduce(matrix);
        rest.is_empty().then(|| used.into_iter().collect())
    }

    /// The remainder of a matrix after subtracting rows, and the combination subtracted.
    fn reduce(&self, matrix: &RationalMatrix) -> (Vector, BTreeMap<usize, Rational>) {
        let mut rest: Vector = matrix.entries().map(|(i, j, v)| ((i, j), v.clone())).collect();
        let mut used = BTreeMap::new();
        let mut place = rest.keys().next().copied();
        while let Some(at) = place {
            if let (Some(row), Some(value)) = (self.rows.get(&at), rest.get(&at).cloned()) {
                add(&mut rest, &row.vector, &-value.clone());
                add(&mut used, &row.combination, &value);
            }
            place = rest.range(at..).find(|(k, _)| **k > at).map(|(k, _)| *k);
        }
        (rest, used)
    }
}

fn add<K: Ord + Copy>(
    target: &mut BTreeMap<K, Rational>,
    other: &BTreeMap<K, Rational>,
    factor: &Rational,
) {
    for (key, value) in other {
        let slot = target.entry(*key).or_insert_with(Rational::zero);
        *slot += value * factor;
        if slot.is_zero() {
            target.remove(key);
        }
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
            let unit = Self::from_entries(1, self.columns(), [(0, i, crate::number::integer(1))]);
            for (j, value) in span.coordinates(&unit)? {
                result.add_to(i, j, value);
            }
        }
        Some(result)
    }
}
