//! The states of a table, and what one of them shares with the next.

use std::path::Path;
use std::sync::Arc;

use coadjoint_codegen::problem::Parameter;
use coadjoint_codegen::smooth::{Facts, Hamiltonian};
use coadjoint_codegen::step;
use coadjoint_learn::table::{Cells, Table};
use nalgebra::{DMatrix, Quaternion, UnitQuaternion};

use crate::engine::{Numbers, Space, group_of};
use crate::ensemble::{Attitude, Found, Known, Shape};
use crate::error::RunError;
use crate::simulate::DRIFTS;

/// The drift allowed a step, relative to the sum of the absolute values of the invariant's terms.
const DRIFT: f64 = 64.0 * f64::EPSILON;

/// A state of a file: the momentum and, where it is given, the matrix of the element, row by row.
pub(crate) struct Reading {
    pub momentum: Vec<f64>,
    pub element: Option<Vec<f64>>,
}

impl Reading {
    /// All its numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.momentum.iter().chain(self.element.iter().flatten()).copied()
    }
}

/// A defect of a table.
pub(crate) fn refused(table: &Table, what: impl std::fmt::Display) -> RunError {
    RunError::Option(format!("{}: {what}", table.path().display()))
}

/// The places of the time, the energy, the drifts and the state in a row.
pub(crate) struct Columns {
    pub time: Option<usize>,
    pub energy: Option<usize>,
    /// Of the spatial momentum, the Casimirs and the energy.
    pub drifts: [Option<usize>; 3],
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
        let drifts = DRIFTS.map(place);
        Ok(Self { time: place("time"), energy: place("energy"), drifts, found })
    }

    /// The state of a row.
    pub(crate) fn state(&self, row: &[f64]) -> Reading {
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
        Reading { momentum, element }
    }
}

/// The next row of a table, if there is one.
pub(crate) fn next(table: &mut Table) -> Result<Option<Vec<f64>>, RunError> {
    let mut row = Cells::default();
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

/// A state, what is conserved there, and how large the numbers are that this is made of.
pub(crate) struct Measured {
    pub state: Reading,
    pub start: step::Start,
    /// The sizes of what rounding of the state moves: the spatial momentum, where an element with an inverse is given, each
    /// Casimir, and the energy.
    spatial: Option<f64>,
    casimirs: Vec<f64>,
    energy: Option<f64>,
}

impl Measured {
    /// The drifts of the spatial momentum, the Casimirs and the energy from here to another state, where they are known, each
    /// with what rounding may do to it.
    pub(crate) fn drifts(&self, to: &Self) -> [Option<(f64, f64)>; 3] {
        let (scales, drift) = (&self.start.scales, self.start.drift(to.start.conserved()));
        let over = |size: f64, scale: f64| if scale == 0.0 { size } else { size / scale };
        let both = |a: Option<f64>, b: Option<f64>, scale| Some(over(a? + b?, scale));
        let casimirs = self.casimirs.iter().zip(&to.casimirs).zip(&scales.casimirs);
        let casimirs = casimirs.map(|((a, b), scale)| over(a + b, *scale));
        let pairs = [
            (drift.spatial_momentum, both(self.spatial, to.spatial, scales.spatial_momentum)),
            (drift.casimirs, casimirs.reduce(f64::max)),
            (drift.energy, both(self.energy, to.energy, scales.energy)),
        ];
        pairs.map(|(drift, size)| {
            drift.zip(size.map(|size| DRIFT * size)).filter(|(drift, _)| drift.is_finite())
        })
    }

    /// The energy, and what rounding may do to it; none where it moves in time.
    pub(crate) fn energy(&self) -> Option<(f64, f64)> {
        let energy = self.start.conserved().last().copied();
        energy.zip(self.energy.map(|size| DRIFT * size))
    }
}

/// The invariants of a problem, computed from its exact data.
pub(crate) struct Invariants {
    functions: step::Invariants,
    /// The group, as tables: its elements are their matrices.
    space: Space,
}

impl Invariants {
    /// Of a system whose parameters have values.
    pub(crate) fn new(hamiltonian: &Hamiltonian) -> Result<Self, RunError> {
        let Facts { name, algebra, .. } = hamiltonian.facts();
        let group = Arc::new(group_of(Path::new(name), algebra, false)?);
        let space = Space { group, compiled: None };
        let functions = step::Invariants::new(algebra, Some(hamiltonian));
        Ok(Self { functions, space })
    }

    /// A state and what is conserved there.
    pub(crate) fn at(&self, time: f64, state: Reading) -> Measured {
        let (functions, mu) = (&self.functions, &state.momentum);
        let numbers = |g: &Vec<f64>| Numbers { g: g.clone(), mu: mu.clone() };
        let spatial = state.element.as_ref().map(|g| self.space.spatial_momentum(&numbers(g)));
        let spatial = spatial.unwrap_or_default();
        let seen = step::Seen { spatial: &spatial, matrix: &[], momentum: mu };
        let start = functions.start(time, seen);
        let (casimirs, energy) = functions.sizes(time, seen);
        let length = mu.iter().map(|mu| mu * mu).sum::<f64>().sqrt();
        let stretch = state.element.as_ref().and_then(|element| condition(element));
        Measured {
            start,
            spatial: stretch.map(|stretch| stretch * length),
            casimirs,
            energy,
            state,
        }
    }

    /// The element of the group that this matrix, row by row, is but for rounding.
    pub(crate) fn nearest(&self, matrix: &[f64]) -> Option<Vec<f64>> {
        let fits = matrix.len() == self.space.size().pow(2);
        fits.then(|| self.space.nearest(matrix).ok()).flatten()
    }
}

/// The product of the norms of a square matrix, row by row, and its inverse, where there is one.
pub(crate) fn condition(entries: &[f64]) -> Option<f64> {
    let size = entries.len().isqrt();
    let matrix = DMatrix::from_row_slice(size, size, &entries[..size * size]);
    Some(matrix.norm() * matrix.try_inverse()?.norm())
}
