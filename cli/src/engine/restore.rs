//! Group elements put back bit by bit.

use coadjoint::{LieGroup, groups::CayleyMatrixGroup, groups::DirectProduct, groups::MatrixGroup};
use nalgebra::DMatrix;

use super::Group;

/// Groups whose elements can be put back as they were. Reading a matrix as a user's would straighten
/// it: other bits.
pub trait Restore: Group {
    /// The element with these entries, all rows and columns; none are checked.
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element;
}

impl Restore for MatrixGroup {
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element {
        let size = self.matrix_size();
        DMatrix::from_fn(size, size, entry)
    }
}

impl Restore for CayleyMatrixGroup {
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element {
        let size = self.matrix_size();
        DMatrix::from_fn(size, size, entry)
    }
}

impl<G: Restore> Restore for DirectProduct<G>
where
    Self: Group<Element = Vec<G::Element>>,
{
    fn restore(&self, entry: &dyn Fn(usize, usize) -> f64) -> Self::Element {
        let mut row = 0;
        let factor = |factor: &G| {
            let first = row;
            row += factor.matrix_size();
            factor.restore(&|i, j| entry(first + i, first + j))
        };
        self.factors().map(factor).collect()
    }
}
