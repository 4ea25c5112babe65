//! The columns of a table that hold states, times and energies.

use coadjoint_codegen::problem::Problem;
use coadjoint_learn::table::{Row, Table};
use nalgebra::{Quaternion, UnitQuaternion};

use crate::ensemble::{Attitude, Found, Known, Shape};
use crate::error::RunError;

/// The places of the time, the energy and the state in a row.
pub(crate) struct Columns {
    pub time: Option<usize>,
    pub energy: Option<usize>,
    found: Found,
}

/// A state of a file: the momentum and, where it is given, the matrix of the element, row by row.
pub(crate) struct State {
    pub momentum: Vec<f64>,
    pub element: Option<Vec<f64>>,
}

impl State {
    /// All its numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.momentum.iter().chain(self.element.iter().flatten()).copied()
    }
}

/// A defect of a table.
pub(crate) fn refused(table: &Table, what: impl std::fmt::Display) -> RunError {
    RunError::Option(format!("{}: {what}", table.path().display()))
}

impl Columns {
    /// By names, or by the number of columns where there are none.
    pub(crate) fn find(problem: &Problem, table: &Table) -> Result<Self, RunError> {
        let (shape, names) = (Shape::of(&problem.algebra), table.names());
        let shape = Shape { quaternions: shape.dim == 3 && shape.matrix_size == 3, ..shape };
        let found = Found::of(shape, &Known::of(problem, &[]), names, table.width());
        let found = found.map_err(|error| refused(table, error))?;
        let place = |name: &str| names.iter().position(|known| known == name);
        Ok(Self { time: place("time"), energy: place("energy"), found })
    }

    /// The state of a row.
    pub(crate) fn state(&self, row: &[f64]) -> State {
        let numbers = self.found.places.iter().map(|place| place.map_or(0.0, |place| row[place]));
        let mut momentum: Vec<f64> = numbers.collect();
        let attitude = momentum.split_off(self.found.layout.shape.dim);
        let element = match self.found.layout.attitude {
            Attitude::None => None,
            Attitude::Matrix => Some(attitude),
            Attitude::Quaternion => {
                let q = Quaternion::new(attitude[0], attitude[1], attitude[2], attitude[3]);
                let rotation = UnitQuaternion::new_unchecked(q).to_rotation_matrix();
                Some(rotation.transpose().matrix().as_slice().to_vec())
            }
        };
        State { momentum, element }
    }
}

/// The next row of a table, if there is one.
pub(crate) fn next(table: &mut Table) -> Result<Option<Vec<f64>>, RunError> {
    let mut row = Row::default();
    if !table.read(&mut row)? {
        return Ok(None);
    }
    let (cells, width, number) = (row.len(), table.width(), table.number());
    if cells != width {
        return Err(refused(
            table,
            format_args!("row {number}: {cells} cells in place of {width}"),
        ));
    }
    Ok(Some(row.numbers()))
}
