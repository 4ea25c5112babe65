//! The states of a table, and what one of them shares with the next.

use std::path::Path;

use coadjoint::LieGroup;
use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint_codegen::problem::Parameter;
use coadjoint_codegen::smooth::{Facts, Hamiltonian};
use coadjoint_codegen::step;
use coadjoint_learn::table::{Row, Table};
use nalgebra::{DMatrix, Quaternion, UnitQuaternion};

use crate::engine::{entries_of, phase_of, product_group};
use crate::ensemble::{Attitude, Found, Known, Shape};
use crate::error::RunError;
use crate::number::maximum;
use crate::simulate::DRIFTS;

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

    /// The conserved quantities of a state, and the sizes that drifts from them are relative to.
    pub(crate) fn start(&self, time: f64, state: &State) -> step::Start {
        let spatial = self.spatial(state).unwrap_or_default();
        self.functions.start(time, &state.momentum, &spatial, Vec::new)
    }

    /// The drifts of the spatial momentum, the Casimirs and the energy from the start to another state, where they are known,
    /// each with what rounding may do to it.
    pub(crate) fn drifts(
        &self,
        (first, start): (&State, &step::Start),
        (time, state): (f64, &State),
    ) -> [Option<(f64, f64)>; 3] {
        let spatial = self.spatial(state).unwrap_or_default();
        let now = self.functions.conserved(time, &state.momentum, &spatial, Vec::new);
        let drift = start.drift(&now);
        let over = |size: f64, scale: f64| if scale == 0.0 { size } else { size / scale };
        let both = |size: &dyn Fn(&State) -> Option<f64>| Some(size(first)? + size(state)?);
        let turned = both(&|state| {
            let length = state.momentum.iter().map(|mu| mu * mu).sum::<f64>().sqrt();
            Some(condition(state.element.as_ref()?)? * length)
        });
        let casimirs = self.functions.casimirs.iter().zip(&start.scales.casimirs);
        let sizes = casimirs.map(|(casimir, scale)| {
            let size = casimir.magnitude(&first.momentum) + casimir.magnitude(&state.momentum);
            over(size, *scale)
        });
        let energy = both(&|state| Some(self.energy(time, &state.momentum)?.1));
        let scales = &start.scales;
        let sizes = [
            turned.map(|size| over(size, scales.spatial_momentum)),
            sizes.reduce(f64::max),
            energy.map(|size| over(size, scales.energy)),
        ];
        let drifts = [drift.spatial_momentum, drift.casimirs, drift.energy];
        let mut pairs = drifts.into_iter().zip(sizes);
        std::array::from_fn(|_| {
            let (drift, size) = pairs.next()?;
            drift.zip(size.map(|size| DRIFT * size))
        })
    }

    /// The element of the group that this matrix, row by row, is but for rounding.
    pub(crate) fn nearest(&self, matrix: &[f64]) -> Option<Vec<f64>> {
        let size = matrix.len().isqrt();
        let element = self.group.element_from_matrix(|i, j| matrix[i * size + j]).ok()?;
        Some(entries_of(&self.group, &element))
    }

    fn spatial(&self, state: &State) -> Option<Vec<f64>> {
        let phase = phase_of(&self.group, state.element.as_ref()?, &state.momentum);
        Some(phase.spatial_momentum(&self.group).as_slice().to_vec())
    }

    /// By how much the spatial momentum Ad\*_g μ drifts from one state to another, relative to its largest coordinate, as runs
    /// measure it, and what rounding of the numbers of both states may do to it; none where a matrix has no inverse, or no
    /// element is given.
    pub(crate) fn spatial_drift(&self, before: &State, after: &State) -> Option<(f64, f64)> {
        let largest =
            |values: &[f64]| values.iter().fold(0.0, |size, value| maximum(size, value.abs()));
        let apart = |a: &[f64], b: &[f64]| {
            largest(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>())
        };
        // Rounding moves it by the sum of what each number moves, to first order.
        let rounding = |state: &State, here: &[f64]| {
            let element = state.element.as_ref()?;
            condition(element)?;
            let mut moved = vec![0.0; here.len()];
            for place in 0..state.momentum.len() + element.len() {
                let (mut momentum, mut element) = (state.momentum.clone(), element.clone());
                let number = momentum.iter_mut().chain(&mut element).nth(place)?;
                *number *= 1.0 + step::NUDGE;
                let beside = self.spatial(&State { momentum, element: Some(element) })?;
                let apart = here.iter().zip(&beside).map(|(a, b)| (a - b).abs());
                moved.iter_mut().zip(apart).for_each(|(moved, apart)| *moved += apart);
            }
            Some(largest(&moved) * (f64::EPSILON / step::NUDGE))
        };
        let (one, other) = (self.spatial(before)?, self.spatial(after)?);
        let (drift, scale) = (apart(&one, &other), largest(&one));
        let moved = rounding(before, &one)? + rounding(after, &other)?;
        let relative = |size: f64| if size == 0.0 { 0.0 } else { size / scale };
        // The inverse of a long element may overflow.
        let (drift, moved) = (relative(drift), relative(moved));
        (!(drift.is_nan() || moved.is_nan())).then_some((drift, moved))
    }
}

/// The product of the norms of a square matrix, row by row, and its inverse, where there is one.
pub(crate) fn condition(entries: &[f64]) -> Option<f64> {
    let size = entries.len().isqrt();
    let matrix = DMatrix::from_row_slice(size, size, &entries[..size * size]);
    Some(matrix.norm() * matrix.try_inverse()?.norm())
}
