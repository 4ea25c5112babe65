//! Group elements put back bit by bit.

use coadjoint::{LieGroup, Phase, groups::DirectProduct};
use nalgebra::{DMatrix, DVector};

use super::Group;

/// Groups whose elements can be put back as they were. Reading a matrix as a user's would straighten
/// it: other bits.
pub trait Restore: Group {
    /// The element with these entries, all rows and columns; none are checked.
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element;
}

impl<G: LieGroup<Scalar = f64, Element = DMatrix<f64>> + Send + Sync> Restore for DirectProduct<G> {
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element {
        let mut first = 0;
        let factor = |factor: &G| {
            let size = factor.matrix_size();
            first += size;
            DMatrix::from_fn(size, size, |i, j| entry(first - size + i, first - size + j))
        };
        self.factors().map(factor).collect()
    }
}

/// The matrix of an element, row by row.
pub fn entries_of<G: LieGroup<Scalar = f64>>(group: &G, element: &G::Element) -> Vec<f64> {
    let size = group.matrix_size();
    (0..size * size).map(|at| group.matrix_entry(element, at / size, at % size)).collect()
}

/// The state with this matrix, row by row, and this momentum; neither is checked.
pub fn phase_of<G: Restore>(group: &G, matrix: &[f64], mu: &[f64]) -> Phase<G> {
    let size = group.matrix_size();
    let element = group.restore(&|i, j| matrix[i * size + j]);
    Phase::<G>::new(element, DVector::from_column_slice(mu))
}
