//! Attitudes in rows: matrices of the group, and unit quaternions where the group is that of rotations.

use coadjoint::{LieGroup, SO3};
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_learn::{DataGroup, matrix_of};
use nalgebra::DMatrix;

use super::layout::Attitude;

/// How far an attitude may be from the group, as for `coadjoint learn`: far above rounding in files, far below noise.
const TOLERANCE: f64 = 1e-6;

/// How rows of a group may give elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attitudes {
    /// By matrices.
    Matrices,
    /// By matrices or unit quaternions: the group is SO(3).
    Rotations,
}

impl Attitudes {
    /// Those of the group with this algebra.
    pub fn of(algebra: &LieAlgebra) -> Self {
        if algebra.name() == "SO3" { Self::Rotations } else { Self::Matrices }
    }

    /// The matrix of size d, row by row, that the columns of a row name; none where they give no attitude. Rotations are
    /// put on the group.
    ///
    /// # Errors
    /// A description of the invalid attitude.
    pub fn read(
        self,
        attitude: Attitude,
        d: usize,
        columns: &[f64],
    ) -> Result<Option<Vec<f64>>, String> {
        let rotations = SO3::<f64>::new();
        let (found, distance) = match (attitude, self) {
            (Attitude::None, _) => return Ok(None),
            (Attitude::Matrix, Self::Matrices) => return Ok(Some(columns.to_vec())),
            (Attitude::Matrix, Self::Rotations) => {
                let given = DMatrix::from_row_slice(d, d, columns);
                let found = rotations.element_near(&given).map(|g| matrix_of(&rotations, &g));
                let distance = found.as_ref().map_or(f64::INFINITY, |m| (m - given).amax());
                (found, distance)
            }
            (Attitude::Quaternion, _) => {
                let wxyz = std::array::from_fn(|i| columns[i]);
                let norm = columns.iter().map(|q| q * q).sum::<f64>().sqrt();
                let found = rotations.element_of_quaternion(wxyz);
                (found.map(|g| matrix_of(&rotations, &g)), (norm - 1.0).abs())
            }
        };
        match found {
            Some(matrix) if distance <= TOLERANCE => {
                Ok(Some(matrix.transpose().as_slice().to_vec()))
            }
            Some(_) => Err(format!("the attitude is off the group by {distance:.1e}")),
            None => Err("the attitude is no element of the group".into()),
        }
    }

    /// Writes the element with this matrix, row by row, into the columns of a row.
    pub fn write(self, attitude: Attitude, matrix: &[f64], columns: &mut [f64]) {
        match attitude {
            Attitude::None => {}
            Attitude::Matrix => columns.copy_from_slice(matrix),
            Attitude::Quaternion => {
                let rotation = SO3::<f64>::new().element_from_matrix(|i, j| matrix[3 * i + j]);
                // A matrix that is no rotation becomes NaN, which a check of rows reports.
                let wxyz = rotation.map_or([f64::NAN; 4], |q| [q.w, q.i, q.j, q.k]);
                columns.copy_from_slice(&wxyz);
            }
        }
    }
}
