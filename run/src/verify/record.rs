//! Which columns hold what.

use std::ops::Range;
use std::path::Path;

use coadjoint_codegen::problem::Problem;

use crate::ensemble::{Attitude, Known, Layout, Shape, matrix_size};
use crate::error::RunError;

/// The places of the time, the energy and the state in a row.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The place of the time, where the file has it.
    pub time: Option<usize>,
    /// The place of the energy, where the file has it.
    pub energy: Option<usize>,
    layout: Layout,
    /// The place of each number of a state; none for those that are 0.
    places: Vec<Option<usize>>,
}

impl Columns {
    /// By names, or by the number of columns where there are none.
    ///
    /// # Errors
    /// Where a column of the state is missing.
    pub fn find(
        problem: &Problem,
        names: &[String],
        width: usize,
        file: &Path,
    ) -> Result<Self, RunError> {
        let dim = problem.algebra.dim();
        let size = matrix_size(&problem.algebra);
        let shape = Shape { dim, matrix_size: size, quaternions: size == 3 && dim == 3 };
        let found = if names.is_empty() {
            Layout::of_width(shape, width).map(|layout| (layout, (0..width).map(Some).collect()))
        } else {
            let known = Known::of(problem, &[]);
            Layout::find(shape, &known, names).map(|found| (found.layout, found.places))
        };
        let (layout, places) =
            found.map_err(|error| RunError::Option(format!("{}: {error}", file.display())))?;
        let place = |name: &str| names.iter().position(|known| known == name);
        Ok(Self { time: place("time"), energy: place("energy"), layout, places })
    }

    fn numbers<'a>(
        &'a self,
        row: &'a [f64],
        places: Range<usize>,
    ) -> impl Iterator<Item = f64> + 'a {
        self.places[places].iter().map(|place| place.map_or(0.0, |place| row[place]))
    }

    /// The momentum of a row.
    pub fn momentum(&self, row: &[f64]) -> Vec<f64> {
        self.numbers(row, 0..self.layout.shape.dim).collect()
    }

    /// The matrix of the group element of a row, row by row.
    pub fn element(&self, row: &[f64]) -> Option<Vec<f64>> {
        let numbers = self.numbers(row, self.layout.shape.dim..self.places.len()).collect();
        match self.layout.attitude {
            Attitude::None => None,
            Attitude::Matrix => Some(numbers),
            Attitude::Quaternion => Some(rotation(&numbers).to_vec()),
        }
    }

    /// Whether all that a state is made of is no number, as in the rows that an ensemble refuses.
    pub fn is_refused(&self, row: &[f64]) -> bool {
        self.momentum(row).iter().all(|value| value.is_nan())
            && self.element(row).is_none_or(|element| element.iter().any(|value| value.is_nan()))
    }
}

/// The matrix of the rotation of a quaternion w, x, y, z, row by row.
fn rotation(wxyz: &[f64]) -> [f64; 9] {
    let [w, x, y, z] = std::array::from_fn(|i| wxyz[i]);
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
