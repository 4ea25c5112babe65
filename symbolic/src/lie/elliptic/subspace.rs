//! Subspaces of ℚⁿ by fully reduced rows.

use crate::number::{Rational, integer};
use num_traits::Zero;
use std::collections::BTreeMap;

/// A vector by its nonzero entries.
pub(super) type Vector = BTreeMap<usize, Rational>;

/// A subspace: rows by pivot. A row is one at its pivot and zero at every other row's.
#[derive(Default)]
pub(super) struct Subspace {
    rows: BTreeMap<usize, Vector>,
}

impl Subspace {
    pub(super) fn dim(&self) -> usize {
        self.rows.len()
    }

    /// The rows, ascending by pivot; coordinates in this basis are the entries at the pivots.
    pub(super) fn rows(&self) -> impl Iterator<Item = &Vector> + '_ {
        self.rows.values()
    }

    pub(super) fn pivots(&self) -> Vec<usize> {
        self.rows.keys().copied().collect()
    }

    /// The remainder of a vector modulo the subspace: zero at every pivot.
    pub(super) fn reduced(&self, vector: &Vector) -> Vector {
        let mut rest = vector.clone();
        for (at, value) in vector {
            if let Some(row) = self.rows.get(at) {
                subtract(&mut rest, row, value);
            }
        }
        rest
    }

    /// Adds a vector; whether the subspace grew.
    pub(super) fn insert(&mut self, vector: &Vector) -> bool {
        let mut row = self.reduced(vector);
        let Some((pivot, lead)) = row.iter().next().map(|(at, value)| (*at, value.recip())) else {
            return false;
        };
        for value in row.values_mut() {
            *value *= &lead;
        }
        for other in self.rows.values_mut() {
            if let Some(value) = other.get(&pivot).cloned() {
                subtract(other, &row, &value);
            }
        }
        self.rows.insert(pivot, row);
        true
    }

    /// The annihilator of all rows in ℚⁿ.
    pub(super) fn annihilator(&self, n: usize) -> Self {
        let mut result = Self::default();
        for free in (0..n).filter(|at| !self.rows.contains_key(at)) {
            let mut vector = Vector::from([(free, integer(1))]);
            for (pivot, row) in &self.rows {
                if let Some(value) = row.get(&free) {
                    vector.insert(*pivot, -value);
                }
            }
            result.insert(&vector);
        }
        result
    }
}

fn subtract(target: &mut Vector, row: &Vector, factor: &Rational) {
    for (at, value) in row {
        let slot = target.entry(*at).or_insert_with(Rational::zero);
        *slot -= value * factor;
        if slot.is_zero() {
            target.remove(at);
        }
    }
}
