//! Group elements by blocks, and what each is.

use std::ops::Range;

use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix, catalogue};
use nalgebra::DMatrix;

use crate::number::maximum;

/// The kind of a block of a group element's matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Representation {
    /// A rotation of the plane.
    Plane,
    /// A rotation of space.
    Rotation,
    /// A rigid motion of the plane.
    PlaneMotion,
    /// A rigid motion of space.
    Motion,
    /// A unit quaternion, in its real 4×4 form.
    Quaternion,
    /// A complex matrix A + iB as ((A, −B), (B, A)).
    Complex,
    /// A real matrix.
    Real,
    /// Ad_g, where the algebra is given by brackets.
    Adjoint,
}

/// A diagonal block of the matrix of a group element; entries outside of all blocks are 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its rows and columns.
    pub range: Range<usize>,
    /// The kind of its entries.
    pub kind: Representation,
    /// The leading rows and columns that are an orthogonal or unitary matrix; 0 if none are.
    pub orthogonal: usize,
}

impl Block {
    /// The places of its entries in the whole matrix, row by row, from 0.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let range = self.range.clone();
        self.range.clone().flat_map(move |i| range.clone().map(move |j| (i, j)))
    }
}

/// The blocks of elements that are matrices of `size` rows: one for each factor of the algebra, or all in one.
pub(crate) fn blocks(algebra: &LieAlgebra, size: usize) -> Vec<Block> {
    let factors = algebra.factors();
    let mut found: Vec<Block> = Vec::with_capacity(factors.len());
    let mut end = 0;
    for (i, factor) in factors.iter().enumerate() {
        let rows = factor.matrix_size();
        let range = end..end + rows;
        found.push(match found.last() {
            Some(last) if factors[i - 1] == *factor => Block { range, ..*last },
            _ => {
                let kind = kind(factor);
                Block { range, kind, orthogonal: orthogonal(kind, factor) }
            }
        });
        end += rows;
    }
    if end == size {
        return found;
    }
    let kind =
        if algebra.basis().is_some() { Representation::Real } else { Representation::Adjoint };
    vec![Block { range: 0..size, kind, orthogonal: 0 }]
}

fn kind(factor: &LieAlgebra) -> Representation {
    let Some(basis) = factor.basis() else { return Representation::Adjoint };
    let is = |name: &str| catalogue::lookup(name).is_ok_and(|known| known.basis() == Some(basis));
    let (n, rows) = (factor.dim(), factor.matrix_size());
    let half = rows / 2;
    match (n, rows) {
        (1, 2) if is("SO2") => Representation::Plane,
        (3, 3) if is("SO3") => Representation::Rotation,
        (3, 3) if is("SE2") => Representation::PlaneMotion,
        (6, 4) if is("SE3") => Representation::Motion,
        (3, 4) if is("SU2") => Representation::Quaternion,
        _ if rows % 2 == 0 && n + 1 == half * half && is(&format!("SU{half}")) => {
            Representation::Complex
        }
        _ if rows % 2 == 0 && n == half * half && is(&format!("U{half}")) => {
            Representation::Complex
        }
        _ => Representation::Real,
    }
}

/// The largest entry of RᵀR − 1, where R is what in these blocks of a group element is orthogonal or unitary; none where
/// nothing is.
pub(crate) fn off_group(blocks: &[Block], entries: &[f64]) -> Option<f64> {
    let off = |(block, own): (&Block, &[f64])| {
        let kept = block.orthogonal;
        let turn = matrix(block, own).view((0, 0), (kept, kept)).into_owned();
        (kept > 0).then(|| (turn.tr_mul(&turn) - DMatrix::identity(kept, kept)).amax())
    };
    split(blocks, entries).filter_map(off).reduce(maximum)
}

/// The leading rows and columns of elements of a factor's group that are an orthogonal or unitary matrix.
fn orthogonal(kind: Representation, factor: &LieAlgebra) -> usize {
    let rows = factor.matrix_size();
    let all = |basis: &[RationalMatrix]| basis.iter().all(RationalMatrix::is_antisymmetric);
    match kind {
        Representation::PlaneMotion | Representation::Motion => rows - 1,
        _ if factor.basis().is_some_and(all) => rows,
        _ => 0,
    }
}

/// The block's entries, which lie row by row in a slice.
pub fn matrix(block: &Block, entries: &[f64]) -> DMatrix<f64> {
    let size = block.range.len();
    DMatrix::from_row_slice(size, size, entries)
}

/// The entries of each block, out of those of all blocks one after the other.
pub fn split<'a>(
    blocks: &'a [Block],
    entries: &'a [f64],
) -> impl Iterator<Item = (&'a Block, &'a [f64])> {
    let mut rest = entries;
    blocks.iter().map(move |block| {
        let (own, after) = rest.split_at(block.range.len() * block.range.len());
        rest = after;
        (block, own)
    })
}
