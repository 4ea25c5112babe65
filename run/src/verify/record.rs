//! Which columns hold what.

use std::path::Path;

use coadjoint_codegen::lie::RationalMatrix;
use coadjoint_codegen::problem::Problem;

use crate::error::RunError;

/// The places of the time, the momentum and the group element in a row.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The place of the time, where the file has it.
    pub time: Option<usize>,
    /// The place of the energy, where the file has it.
    pub energy: Option<usize>,
    momentum: Vec<usize>,
    element: Element,
    size: usize,
}

/// The places of the group element in a row.
#[derive(Clone, Debug)]
enum Element {
    /// The file has none.
    None,
    /// (place in the matrix, place in the row); entries without a column are 0.
    Matrix(Vec<(usize, usize)>),
    /// Of w, x, y, z, the unit quaternion of a rotation.
    Quaternion([usize; 4]),
}

/// The columns of a quaternion.
const QUATERNION: [&str; 4] = ["q_w", "q_x", "q_y", "q_z"];

impl Columns {
    /// By names, or by the number of columns where there are none.
    pub fn find(
        problem: &Problem,
        names: &[String],
        width: usize,
        file: &Path,
    ) -> Result<Self, RunError> {
        let dim = problem.algebra.dim();
        let size = problem
            .algebra
            .basis()
            .map_or(dim, |basis| basis.first().map_or(0, RationalMatrix::rows));
        let rotations = size == 3 && dim == 3;
        if names.is_empty() {
            let momentum = (0..dim).collect();
            let element = match width.checked_sub(dim) {
                Some(0) => Element::None,
                Some(4) if rotations => Element::Quaternion([dim, dim + 1, dim + 2, dim + 3]),
                Some(n) if n == size * size => {
                    Element::Matrix((0..n).map(|at| (at, dim + at)).collect())
                }
                _ => {
                    return Err(RunError::Option(format!(
                        "{}: {width} columns without names; this system has {dim} momenta, and {} \
                         entries of a group element",
                        file.display(),
                        size * size
                    )));
                }
            };
            return Ok(Self { time: None, energy: None, momentum, element, size });
        }
        let place = |name: &str| names.iter().position(|known| known == name);
        let mut momentum = Vec::new();
        for (i, name) in problem.coordinates.iter().enumerate() {
            let numbered = format!("mu_{}", i + 1);
            let found = place(&numbered)
                .or_else(|| place(&format!("momentum_{name}")))
                .or_else(|| place(name));
            momentum.push(found.ok_or_else(|| {
                RunError::Option(format!(
                    "{}: no column {name} or {numbered}; the file has {}",
                    file.display(),
                    names.join(", ")
                ))
            })?);
        }
        let separator = if size > 9 { "_" } else { "" };
        let mut matrix = Vec::new();
        for at in 0..size * size {
            let name = format!("g_{}{separator}{}", at / size + 1, at % size + 1);
            matrix.extend(place(&name).map(|column| (at, column)));
        }
        let quaternion: Vec<usize> = QUATERNION.iter().filter_map(|name| place(name)).collect();
        let element = match <[usize; 4]>::try_from(quaternion) {
            Ok(places) if rotations && matrix.is_empty() => Element::Quaternion(places),
            Ok(_) => {
                return Err(RunError::Option(format!(
                    "{}: columns {} are attitudes of SO3; the elements of {} are matrices of {size} rows",
                    file.display(),
                    QUATERNION.join(", "),
                    problem.algebra.name()
                )));
            }
            Err(_) if matrix.is_empty() => Element::None,
            Err(_) => Element::Matrix(matrix),
        };
        Ok(Self { time: place("time"), energy: place("energy"), momentum, element, size })
    }

    /// The momentum of a row.
    pub fn momentum(&self, row: &[f64]) -> Vec<f64> {
        self.momentum.iter().map(|&at| row[at]).collect()
    }

    /// The matrix of the group element of a row, row by row; entries that have no column are 0.
    pub fn element(&self, row: &[f64]) -> Option<Vec<f64>> {
        match &self.element {
            Element::None => None,
            Element::Matrix(places) => {
                let mut matrix = vec![0.0; self.size * self.size];
                for &(at, column) in places {
                    matrix[at] = row[column];
                }
                Some(matrix)
            }
            Element::Quaternion(places) => Some(rotation(places.map(|place| row[place])).to_vec()),
        }
    }

    /// Whether all that a state is made of is no number, as in the rows that an ensemble refuses.
    pub fn is_refused(&self, row: &[f64]) -> bool {
        self.momentum.iter().all(|&place| row[place].is_nan())
            && self.element(row).is_none_or(|element| element.iter().any(|value| value.is_nan()))
    }
}

/// The matrix of the rotation of a quaternion w, x, y, z, row by row.
fn rotation([w, x, y, z]: [f64; 4]) -> [f64; 9] {
    let cross = |a: f64, b: f64, c: f64| 2.0 * (a * b + w * c);
    [
        w * w + x * x - y * y - z * z,
        cross(x, y, -z),
        cross(x, z, y),
        cross(x, y, z),
        w * w - x * x + y * y - z * z,
        cross(y, z, -x),
        cross(x, z, -y),
        cross(y, z, x),
        w * w - x * x - y * y + z * z,
    ]
}
