//! Group elements by blocks: what each is, and how a person reads it.

use std::ops::Range;

use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix, catalogue};
use nalgebra::{DMatrix, Matrix3, Rotation3, UnitQuaternion};

use super::number::shortest;

/// At most so many blocks are printed.
const MOST_BLOCKS: usize = 12;
/// Blocks with more rows are not printed.
const WIDEST: usize = 12;

/// What a block of the matrix of a group element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
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
    /// What it is.
    pub kind: Kind,
}

/// The blocks of elements: one for each factor of the algebra, or those that the group knows.
pub fn blocks(algebra: &LieAlgebra, known: Vec<Range<usize>>) -> Vec<Block> {
    let factors = algebra.factors();
    let mut found: Vec<Block> = Vec::with_capacity(factors.len());
    let mut end = 0;
    for (i, factor) in factors.iter().enumerate() {
        let rows =
            factor.basis().map_or(factor.dim(), |b| b.first().map_or(0, RationalMatrix::rows));
        let kind = match found.last() {
            Some(last) if factors[i - 1] == *factor => last.kind,
            _ => kind(factor),
        };
        found.push(Block { range: end..end + rows, kind });
        end += rows;
    }
    if known.last().is_some_and(|last| last.end == end) {
        return found;
    }
    let kind = if algebra.basis().is_some() { Kind::Real } else { Kind::Adjoint };
    known.into_iter().map(|range| Block { range, kind }).collect()
}

fn kind(factor: &LieAlgebra) -> Kind {
    let Some(basis) = factor.basis() else { return Kind::Adjoint };
    let is = |name: &str| catalogue::lookup(name).is_ok_and(|known| known.basis() == Some(basis));
    let (n, rows) = (factor.dim(), basis.first().map_or(0, RationalMatrix::rows));
    let half = rows / 2;
    match (n, rows) {
        (1, 2) if is("SO2") => Kind::Plane,
        (3, 3) if is("SO3") => Kind::Rotation,
        (3, 3) if is("SE2") => Kind::PlaneMotion,
        (6, 4) if is("SE3") => Kind::Motion,
        (3, 4) if is("SU2") => Kind::Quaternion,
        _ if rows % 2 == 0 && n + 1 == half * half && is(&format!("SU{half}")) => Kind::Complex,
        _ if rows % 2 == 0 && n == half * half && is(&format!("U{half}")) => Kind::Complex,
        _ => Kind::Real,
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

/// Lines that say what the element is; zero blocks are left out.
pub fn lines(blocks: &[Block], entries: &[f64]) -> Vec<String> {
    let several = blocks.len() > 1;
    let mut lines = Vec::new();
    for (number, (block, entries)) in split(blocks, entries).take(MOST_BLOCKS).enumerate() {
        let which = if several { format!("{} ", number + 1) } else { String::new() };
        let g = matrix(block, entries);
        lines.push(format!("group element {which}({})", said(block)));
        lines.extend(rows(block, &g).into_iter().map(|row| format!("  {row}")));
    }
    if blocks.len() > MOST_BLOCKS {
        let rest = blocks.len() - MOST_BLOCKS;
        lines.push(format!("group elements of {rest} more factors: see --format json or --out"));
    }
    lines
}

fn said(block: &Block) -> String {
    let n = block.range.len();
    match block.kind {
        Kind::Plane => "rotation of the plane: angle in radians".into(),
        Kind::Rotation => "rotation, body to space: unit quaternion w, x, y, z".into(),
        Kind::PlaneMotion => "motion of the plane: angle in radians; translation x, y".into(),
        Kind::Motion => {
            "rigid motion, body to space: unit quaternion w, x, y, z; translation x, y, z".into()
        }
        Kind::Quaternion => "unit quaternion w, x, y, z".into(),
        Kind::Complex => format!("complex {0} × {0} matrix", n / 2),
        Kind::Real => format!("{n} × {n} matrix"),
        Kind::Adjoint => format!("{n} × {n} matrix of Ad_g"),
    }
}

fn rows(block: &Block, g: &DMatrix<f64>) -> Vec<String> {
    let list = |values: &[f64]| {
        values.iter().map(|&x| format!("{:>24}", shortest(x))).collect::<Vec<_>>().join(" ")
    };
    let angle = || g[(1, 0)].atan2(g[(0, 0)]);
    match block.kind {
        Kind::Plane => vec![list(&[angle()])],
        Kind::Rotation => vec![list(&quaternion(g))],
        Kind::PlaneMotion => vec![list(&[angle()]), list(&[g[(0, 2)], g[(1, 2)]])],
        Kind::Motion => {
            vec![list(&quaternion(g)), list(&[g[(0, 3)], g[(1, 3)], g[(2, 3)]])]
        }
        // U = w − i(xσ₁ + yσ₂ + zσ₃) as ((A, −B), (B, A)).
        Kind::Quaternion => vec![list(&[g[(0, 0)], -g[(2, 1)], -g[(0, 1)], -g[(2, 0)]])],
        _ if g.nrows() > WIDEST => vec!["too large to print: see --format json or --out".into()],
        Kind::Complex => {
            let n = g.nrows() / 2;
            let entry = |i: usize, j: usize| {
                let (re, im) = (g[(i, j)], g[(n + i, j)]);
                let sign = if im.is_sign_negative() { '-' } else { '+' };
                format!("{:>49}", format!("{} {sign} {}i", shortest(re), shortest(im.abs())))
            };
            let row = |i| (0..n).map(|j| entry(i, j)).collect::<Vec<_>>().join(" ");
            (0..n).map(row).collect()
        }
        Kind::Real | Kind::Adjoint => {
            (0..g.nrows()).map(|i| list(&g.row(i).iter().copied().collect::<Vec<_>>())).collect()
        }
    }
}

/// The unit quaternion w, x, y, z with w ≥ 0 of the rotation in the first three rows and columns.
fn quaternion(g: &DMatrix<f64>) -> [f64; 4] {
    let matrix = Matrix3::from_fn(|i, j| g[(i, j)]);
    let rotation = Rotation3::from_matrix_unchecked(matrix);
    let q = UnitQuaternion::from_rotation_matrix(&rotation);
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    // No negative zeros.
    [q.w, q.i, q.j, q.k].map(|x| sign * x + 0.0)
}
