//! The quantities a row shares with the row before: Casimirs and the spatial momentum; and its energy.

use std::path::Path;

use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint_codegen::lie::watched_casimirs;
use coadjoint_codegen::poly::Numeric;
use coadjoint_codegen::problem::{Problem, values};
use nalgebra::DMatrix;

use super::columns::State;
use crate::engine::{phase_of, product_group};
use crate::error::RunError;

/// The drift allowed a step, relative to the sum of the absolute values of the invariant's terms.
pub(crate) const DRIFT: f64 = 64.0 * f64::EPSILON;

/// The invariants of a problem, computed from its exact data.
pub(crate) struct Invariants {
    casimirs: Vec<Numeric>,
    hamiltonian: Numeric,
    /// The group, as tables.
    group: DirectProduct<MatrixGroup>,
}

impl Invariants {
    /// The invariants of a problem whose parameters have values.
    pub(crate) fn new(problem: &Problem) -> Result<Self, RunError> {
        let dim = problem.algebra.dim();
        let float = |polynomial| Numeric::new(polynomial, dim, &values(&problem.symbols));
        Ok(Self {
            casimirs: watched_casimirs(&problem.algebra).iter().map(float).collect(),
            hamiltonian: float(&problem.hamiltonian),
            group: product_group(Path::new(&problem.name), &problem.algebra)?,
        })
    }

    /// The energy of a momentum, and the sum of the absolute values of its terms.
    pub(crate) fn energy(&self, mu: &[f64]) -> (f64, f64) {
        (self.hamiltonian.value(mu), self.hamiltonian.magnitude(mu))
    }

    /// By how much each Casimir drifts from one momentum to another, relative to its terms.
    pub(crate) fn casimir_drifts(
        &self,
        before: &[f64],
        after: &[f64],
    ) -> impl Iterator<Item = f64> {
        self.casimirs.iter().map(move |casimir| {
            let difference = (casimir.value(before) - casimir.value(after)).abs();
            let [a, b] = [before, after].map(|mu| casimir.magnitude(mu));
            if difference == 0.0 { 0.0 } else { difference / a.max(b) }
        })
    }

    /// By how much the spatial momentum Ad\*_g μ drifts from one state to another, relative to what rounding of g and μ may
    /// leave of it; none where a matrix has no inverse, or no element is given.
    pub(crate) fn spatial_drift(&self, before: &State, after: &State) -> Option<f64> {
        let spatial = |state: &State| {
            let matrix = square(state.element.as_ref()?);
            let size = matrix.norm() * matrix.clone().try_inverse()?.norm();
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

/// A square matrix with these entries, row by row.
pub(crate) fn square(entries: &[f64]) -> DMatrix<f64> {
    let size = entries.len().isqrt();
    DMatrix::from_row_slice(size, size, &entries[..size * size])
}
