//! Group elements by blocks, as a person reads them.

use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{Block, Kind, matrix, split};
use nalgebra::{DMatrix, Matrix3, Rotation3, UnitQuaternion};

/// The largest number of blocks that are printed.
const MOST_BLOCKS: usize = 12;
/// Blocks with more rows are not printed.
const WIDEST: usize = 12;

/// Lines that say what the element is; zero blocks are left out.
pub(crate) fn lines(blocks: &[Block], entries: &[f64]) -> Vec<String> {
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
