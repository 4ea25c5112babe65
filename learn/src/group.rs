//! Reading group elements from data.

use coadjoint::groups::{CayleyMatrixGroup, Coordinates, MatrixGroup};
use coadjoint::{LieGroup, SE3, SO3};
use nalgebra::{DMatrix, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// A group whose elements can be read from data.
pub trait DataGroup: LieGroup<Scalar = f64> + Sized {
    /// The element nearest to `matrix` (in the representation of [`LieGroup::matrix_entry`]);
    /// `None` where none exists or none is found.
    ///
    /// By default a matrix must be an element to 8 digits; SO(3) projects any matrix.
    fn element_near(&self, matrix: &DMatrix<f64>) -> Option<Self::Element> {
        let size = self.matrix_size();
        if matrix.shape() != (size, size) {
            return None;
        }
        self.element_from_matrix(|i, j| matrix[(i, j)]).ok()
    }

    /// The element of the quaternion (w, x, y, z) of about unit length, where the group has them.
    fn element_of_quaternion(&self, _wxyz: [f64; 4]) -> Option<Self::Element> {
        None
    }

    /// The element that the columns of an attitude name, a quaternion w, x, y, z or a matrix row by row, if there is one, and
    /// how far they are off the group: in an entry of the matrix, or in the length of the quaternion.
    fn element_of_columns(
        &self,
        columns: &[f64],
        quaternion: bool,
    ) -> (Option<Self::Element>, f64) {
        if let (true, &[w, x, y, z]) = (quaternion, columns) {
            let norm = (w * w + x * x + y * y + z * z).sqrt();
            return (self.element_of_quaternion([w, x, y, z]), (norm - 1.0).abs());
        }
        let size = self.matrix_size();
        let given = DMatrix::from_row_slice(size, size, columns);
        let found = self.element_near(&given);
        let nearest = found.as_ref().map(|g| matrix_of(self, g));
        (found, nearest.map_or(f64::INFINITY, |nearest| (nearest - given).amax()))
    }

    /// How far the increment with coordinate `x` is on the way to the fold of the chart's
    /// canonical momentum: 1 at the fold, `None` where no fold is known.
    fn fold_measure(&self, _chart: &str, _x: &Self::Vector) -> Option<f64> {
        None
    }
}

/// The fold of rotations. Cayley: along a fixed axis p = μ cos²(θ/2), which grows with the angle
/// θ = t|Ω| only up to θ tan(θ/2) = 1 (θ ≈ 1.3065 rad); beyond it two increments share one p.
/// Exponential: along an axis p = μ, so the limit is the half turn, where the coordinate jumps. These
/// are limits of a single increment; folds that the flow causes earlier are found from all samples
/// (`data::fold`).
fn rotation_fold(chart: &str, norm: f64) -> Option<f64> {
    match chart {
        "cayley" => Some(2.0 * (0.5 * norm).atan() * 0.5 * norm),
        "exp" => Some(norm / (std::f64::consts::PI * 0.95)),
        _ => None,
    }
}

impl DataGroup for SO3<f64> {
    fn element_near(&self, matrix: &DMatrix<f64>) -> Option<Self::Element> {
        if matrix.shape() != (3, 3) || !matrix.iter().all(|v| v.is_finite()) {
            return None;
        }
        let given = Matrix3::from_fn(|i, j| matrix[(i, j)]);
        // The orthogonal factor of the polar decomposition is the nearest one.
        let svd = given.try_svd(true, true, f64::EPSILON, 100)?;
        let rotation = svd.u? * svd.v_t?;
        (rotation.determinant() > 0.0).then(|| {
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation))
        })
    }

    fn element_of_quaternion(&self, [w, x, y, z]: [f64; 4]) -> Option<Self::Element> {
        let quaternion = Quaternion::new(w, x, y, z);
        let norm = quaternion.norm();
        (norm.is_finite() && norm > 0.0).then(|| UnitQuaternion::from_quaternion(quaternion))
    }

    fn fold_measure(&self, chart: &str, x: &Vector3<f64>) -> Option<f64> {
        rotation_fold(chart, x.pairing(x).sqrt())
    }
}

impl DataGroup for SE3<f64> {
    /// The rotation part decides; translations do not fold.
    fn fold_measure(&self, chart: &str, x: &Self::Vector) -> Option<f64> {
        rotation_fold(chart, (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt())
    }
}

impl DataGroup for MatrixGroup {}

impl DataGroup for CayleyMatrixGroup {}

/// The matrix of a group element.
pub fn matrix_of<G: LieGroup<Scalar = f64>>(group: &G, g: &G::Element) -> DMatrix<f64> {
    let size = group.matrix_size();
    DMatrix::from_fn(size, size, |i, j| group.matrix_entry(g, i, j))
}
