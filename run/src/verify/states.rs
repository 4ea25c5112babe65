//! The states of a table, and what one of them shares with the next.

use std::path::Path;

use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint_codegen::problem::Parameter;
use coadjoint_codegen::smooth::{Facts, Hamiltonian};
use coadjoint_codegen::step;
use coadjoint_learn::table::{Row, Table};
use nalgebra::{DMatrix, Quaternion, UnitQuaternion};

use crate::engine::{phase_of, product_group};
use crate::ensemble::{Attitude, Found, Known, Shape};
use crate::error::RunError;

/// The drift allowed a step, relative to the sum of the absolute values of the invariant's terms.
pub(crate) const DRIFT: f64 = 64.0 * f64::EPSILON;

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

/// The places of the time, the energy and the state in a row.
pub(crate) struct Columns {
    pub time: Option<usize>,
    pub energy: Option<usize>,
    found: Found,
}

impl Columns {
    /// By names, or by the number of columns where there are none. `parameters` are all those of the system's file.
    pub(crate) fn find(
        hamiltonian: &Hamiltonian,
        parameters: &[Parameter],
        table: &Table,
    ) -> Result<Self, RunError> {
        let facts = hamiltonian.facts();
        let (shape, names) = (Shape::of(facts.algebra), table.names());
        let shape = Shape { quaternions: shape.dim == 3 && shape.matrix_size == 3, ..shape };
        let found = Found::of(shape, &Known::of(&facts, parameters), names, table.width());
        let found = found.map_err(|error| refused(table, error))?;
        if let Some(name) = found.layout.parameters.first() {
            let what =
                format_args!("column {name}: rows with parameters of their own are not judged");
            return Err(refused(table, what));
        }
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
        let what = format_args!("row {number}: {cells} cells in place of {width}");
        return Err(refused(table, what));
    }
    Ok(Some(row.numbers()))
}

/// The invariants of a problem, computed from its exact data.
pub(crate) struct Invariants {
    functions: step::Invariants,
    /// The group, as tables.
    group: DirectProduct<MatrixGroup>,
}

impl Invariants {
    /// Of a system whose parameters have values.
    pub(crate) fn new(hamiltonian: &Hamiltonian) -> Result<Self, RunError> {
        let Facts { name, algebra, .. } = hamiltonian.facts();
        let group = product_group(Path::new(name), algebra)?;
        let functions = step::Invariants::new(algebra, step::Energy::new(hamiltonian), None);
        Ok(Self { functions, group })
    }

    /// The energy of a momentum at this time, and the sum of the absolute values of its terms; none where it moves in time.
    pub(crate) fn energy(&self, time: f64, mu: &[f64]) -> Option<(f64, f64)> {
        let energy = self.functions.hamiltonian.as_ref()?;
        Some((energy.value(time, mu), energy.magnitude(time, mu)))
    }

    /// By how much each Casimir drifts from one momentum to another, relative to its terms.
    pub(crate) fn casimir_drifts(
        &self,
        before: &[f64],
        after: &[f64],
    ) -> impl Iterator<Item = f64> {
        self.functions.casimirs.iter().map(move |casimir| {
            let difference = (casimir.value(before) - casimir.value(after)).abs();
            let [a, b] = [before, after].map(|mu| casimir.magnitude(mu));
            if difference == 0.0 { 0.0 } else { difference / a.max(b) }
        })
    }

    /// By how much the spatial momentum Ad\*_g μ drifts from one state to another, relative to what rounding of g and μ may
    /// leave of it; none where a matrix has no inverse, or no element is given.
    pub(crate) fn spatial_drift(&self, before: &State, after: &State) -> Option<f64> {
        let spatial = |state: &State| {
            let size = condition(state.element.as_ref()?)?;
            let phase = phase_of(&self.group, state.element.as_ref()?, &state.momentum);
            Some((phase.spatial_momentum(&self.group), size * phase.momentum.norm()))
        };
        let ((one, size), (other, next)) = (spatial(before)?, spatial(after)?);
        let difference = (one - other).amax();
        // The inverse of a long element may overflow.
        let drift = if difference == 0.0 { 0.0 } else { difference / (size + next) };
        (!drift.is_nan()).then_some(drift)
    }
}

/// The product of the norms of a square matrix, row by row, and its inverse, where there is one.
pub(crate) fn condition(entries: &[f64]) -> Option<f64> {
    let size = entries.len().isqrt();
    let matrix = DMatrix::from_row_slice(size, size, &entries[..size * size]);
    Some(matrix.norm() * matrix.try_inverse()?.norm())
}
