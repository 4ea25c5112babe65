//! Groups: how requests and model files name them, and how their elements are read from data.

use std::collections::BTreeMap;
use std::str::FromStr;

use coadjoint::groups::{CayleyMatrixGroup, Coordinates, MatrixGroup};
use coadjoint::{LieGroup, SE3, SO3};
use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix, catalogue};
use coadjoint_codegen::number::Rational;
use nalgebra::{DMatrix, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use crate::error::LearnError;

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

    /// A measure of the increment with coordinate `x`: below 1 before the fold of the chart's canonical momentum, 1 at the
    /// fold; `None` if no fold is known.
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

/// A group: one of the catalogue by its name, or one by its algebra, such as that of a system file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum GroupChoice {
    /// A name of the catalogue.
    Named(String),
    /// An algebra that is not in the catalogue.
    Own(OwnAlgebra),
}

/// The components (k, c_ij^k) of a bracket.
type Components = Vec<(usize, String)>;

/// An algebra as model files have it; numbers are fractions as texts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnAlgebra {
    name: String,
    generators: Vec<String>,
    /// \[e_i, e_j\] for i < j.
    brackets: Vec<(usize, usize, Components)>,
    /// The matrices of the basis row by row; none where the algebra is known by its brackets alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    basis: Vec<Vec<Vec<String>>>,
}

impl Default for GroupChoice {
    fn default() -> Self {
        Self::Named(String::new())
    }
}

impl<T: Into<String>> From<T> for GroupChoice {
    fn from(name: T) -> Self {
        Self::Named(name.into())
    }
}

impl GroupChoice {
    /// The group of this algebra, by its name where the catalogue has it.
    pub fn of(algebra: &LieAlgebra) -> Self {
        let name = algebra.name().to_owned();
        if catalogue::lookup(&name).is_ok_and(|known| known == *algebra) {
            return Self::Named(name);
        }
        let mut brackets: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for c in algebra.structure().iter().filter(|c| c.i < c.j) {
            brackets.entry((c.i, c.j)).or_default().push((c.k, c.value.to_string()));
        }
        let rows = |m: &RationalMatrix| {
            let row = |i| (0..m.columns()).map(|j| m.get(i, j).to_string()).collect();
            (0..m.rows()).map(row).collect()
        };
        Self::Own(OwnAlgebra {
            name,
            generators: algebra.generators().to_vec(),
            brackets: brackets.into_iter().map(|((i, j), terms)| (i, j, terms)).collect(),
            basis: algebra.basis().unwrap_or_default().iter().map(rows).collect(),
        })
    }

    /// The group's name.
    pub fn name(&self) -> &str {
        match self {
            Self::Named(name) => name,
            Self::Own(own) => &own.name,
        }
    }

    /// The algebra.
    ///
    /// # Errors
    /// [`LearnError::UnknownGroup`] for a name that the catalogue has not, or brackets and matrices that are no algebra.
    pub fn algebra(&self) -> Result<LieAlgebra, LearnError> {
        let found = match self {
            Self::Named(name) => catalogue::lookup(name).map_err(|error| error.to_string()),
            Self::Own(own) => own.algebra(),
        };
        found.map_err(|reason| LearnError::UnknownGroup { name: self.name().to_owned(), reason })
    }
}

impl OwnAlgebra {
    fn algebra(&self) -> Result<LieAlgebra, String> {
        let number = |text: &String| {
            Rational::from_str(text).map_err(|error| format!("`{text}` is no fraction: {error}"))
        };
        if catalogue::lookup(&self.name).is_ok() {
            return Err("it has the name of another group".to_owned());
        }
        let (name, generators) = (self.name.clone(), self.generators.clone());
        let algebra = if self.basis.is_empty() {
            let component = |(k, value): &(usize, String)| Ok((*k, number(value)?));
            let bracket = |(i, j, terms): &(usize, usize, Vec<_>)| {
                Ok((*i, *j, terms.iter().map(component).collect::<Result<Vec<_>, String>>()?))
            };
            let brackets = self.brackets.iter().map(bracket).collect::<Result<Vec<_>, String>>()?;
            LieAlgebra::from_brackets(name, generators, brackets)
        } else {
            let row = |row: &Vec<String>| row.iter().map(number).collect();
            let matrix = |rows: &Vec<Vec<String>>| {
                let rows = rows.iter().map(row).collect::<Result<Vec<_>, String>>()?;
                Ok(RationalMatrix::from_rows(rows))
            };
            let basis = self.basis.iter().map(matrix).collect::<Result<Vec<_>, String>>()?;
            LieAlgebra::from_named_basis(name, generators, basis)
        };
        algebra.map_err(|error| error.to_string())
    }
}
