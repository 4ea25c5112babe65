//! Attitudes in rows: matrices of the group, and unit quaternions where the group is that of rotations.

use coadjoint::{LieGroup, SO3};
use coadjoint_learn::{DataGroup, matrix_of};
use nalgebra::DMatrix;

use super::layout::{Attitude, Layout};

/// How far an attitude may be from the group, as for `coadjoint learn`: far above rounding in files, far below noise.
const TOLERANCE: f64 = 1e-6;

impl Layout {
    /// The matrix, row by row, that the columns of an attitude name; none where there are none. Rotations are put on the
    /// group.
    ///
    /// # Errors
    /// The defect.
    pub(super) fn read_attitude(&self, columns: &[f64]) -> Result<Option<Vec<f64>>, String> {
        let rotations = SO3::<f64>::new();
        let (found, distance) = match self.attitude {
            Attitude::None => return Ok(None),
            Attitude::Matrix if !self.shape.quaternions => return Ok(Some(columns.to_vec())),
            Attitude::Matrix => {
                let given = DMatrix::from_row_slice(3, 3, columns);
                let found = rotations.element_near(&given).map(|g| matrix_of(&rotations, &g));
                let distance = found.as_ref().map_or(f64::INFINITY, |m| (m - given).amax());
                (found, distance)
            }
            Attitude::Quaternion => {
                let norm = columns.iter().map(|q| q * q).sum::<f64>().sqrt();
                let found = rotations.element_of_quaternion(std::array::from_fn(|i| columns[i]));
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

    /// Writes the element with this matrix, row by row, into the columns of an attitude.
    pub(super) fn write_attitude(&self, matrix: &[f64], columns: &mut [f64]) {
        match self.attitude {
            Attitude::None => {}
            Attitude::Matrix => columns.copy_from_slice(matrix),
            Attitude::Quaternion => {
                let rotation = SO3::<f64>::new().element_from_matrix(|i, j| matrix[3 * i + j]);
                // A matrix that is no rotation becomes NaN, which a check of rows tells.
                let wxyz = rotation.map_or([f64::NAN; 4], |q| [q.w, q.i, q.j, q.k]);
                columns.copy_from_slice(&wxyz);
            }
        }
    }
}
