//! What learning asks of a group beyond the runtime: reading elements from data.

use coadjoint::{Coordinates, LieGroup, SO3};
use nalgebra::{DMatrix, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// A group whose elements can be read from matrices, for data and models on disk.
pub trait MatrixGroup: LieGroup<Scalar = f64> {
    /// The name users write: `SO3`.
    fn name(&self) -> String;

    /// The element nearest to `matrix` (in the representation of
    /// [`LieGroup::matrix_entry`]); `None` where there is none.
    fn element_near(&self, matrix: &DMatrix<f64>) -> Option<Self::Element>;

    /// The element of the quaternion (w, x, y, z) of about unit length, where the group has them.
    fn element_of_quaternion(&self, _wxyz: [f64; 4]) -> Option<Self::Element> {
        None
    }

    /// How far the increment with coordinate `x` is on the way to the fold of the chart's
    /// canonical momentum: 1 at the fold, `None` where no fold is known.
    fn fold_measure(&self, _chart: &str, _x: &Self::Vector) -> Option<f64> {
        None
    }
}

impl MatrixGroup for SO3<f64> {
    fn name(&self) -> String {
        "SO3".into()
    }

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

    /// Cayley: along a fixed axis p = μ cos²(θ/2), which grows with the angle θ = t|Ω| only up to
    /// θ tan(θ/2) = 1 (θ ≈ 1.3065 rad); beyond it two increments share one p. Exponential: along
    /// an axis p = μ, so the limit is the half turn, where the coordinate jumps.
    fn fold_measure(&self, chart: &str, x: &Vector3<f64>) -> Option<f64> {
        let norm = x.pairing(x).sqrt();
        match chart {
            "cayley" => Some(2.0 * (0.5 * norm).atan() * 0.5 * norm),
            "exp" => Some(norm / (std::f64::consts::PI * 0.95)),
            _ => None,
        }
    }
}

/// The matrix of a group element.
pub fn matrix_of<G: LieGroup<Scalar = f64>>(group: &G, g: &G::Element) -> DMatrix<f64> {
    let size = group.matrix_size();
    DMatrix::from_fn(size, size, |i, j| group.matrix_entry(g, i, j))
}
