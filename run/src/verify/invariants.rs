//! The quantities a row shares with the row before: Casimirs and the spatial momentum; and its energy.

use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix, watched_casimirs};
use coadjoint_codegen::poly::{Numeric, Polynomial};
use coadjoint_codegen::problem::{Problem, values};
use nalgebra::{DMatrix, DVector};
use num_traits::ToPrimitive;

/// The drift allowed a step, relative to the sum of the absolute values of the invariant's terms.
pub const DRIFT: f64 = 64.0 * f64::EPSILON;

/// The invariants of a problem, computed from its exact data.
pub struct Invariants {
    casimirs: Vec<Polynomial>,
    hamiltonian: Numeric,
    factors: Vec<Factor>,
}

/// A direct factor of the group: where its coordinates and its matrices begin, and its basis.
struct Factor {
    first: usize,
    dim: usize,
    row: usize,
    size: usize,
    /// None where elements are the matrices of Ad.
    basis: Option<Basis>,
}

/// Matrices, and what finds the coordinates of a combination of them.
struct Basis {
    matrices: Vec<DMatrix<f64>>,
    gram: DMatrix<f64>,
}

impl Invariants {
    /// The invariants of a problem whose parameters have values.
    pub fn new(problem: &Problem) -> Self {
        let dim = problem.algebra.dim();
        Self {
            casimirs: watched_casimirs(&problem.algebra),
            hamiltonian: Numeric::new(&problem.hamiltonian, dim, &values(&problem.symbols)),
            factors: factors(&problem.algebra),
        }
    }

    /// The number of rows of the matrices of the group.
    pub fn matrix_size(&self) -> usize {
        self.factors.iter().map(|factor| factor.size).sum()
    }

    /// The energy of a momentum, and the sum of the absolute values of its terms.
    pub fn energy(&self, mu: &[f64]) -> (f64, f64) {
        (self.hamiltonian.value(mu), self.hamiltonian.magnitude(mu))
    }

    /// By how much each Casimir drifts from one momentum to another, relative to its terms.
    pub fn casimir_drifts(&self, before: &[f64], after: &[f64]) -> impl Iterator<Item = f64> {
        self.casimirs.iter().map(move |casimir| {
            let (one, other) = (casimir.evaluate(before), casimir.evaluate(after));
            let sizes = casimir.factors().map(|(factors, value)| {
                let term = Polynomial::from_factors(before.len(), [(factors, value)]);
                let [a, b] = [before, after].map(|mu| term.evaluate(mu).abs());
                if a.is_nan() || a > b { a } else { b }
            });
            let whole: f64 = sizes.sum();
            if one == other { 0.0 } else { (one - other).abs() / whole }
        })
    }

    /// By how much the spatial momentum ⟨μ, Ad_{g⁻¹} e_j⟩ drifts from one state to another, relative to the sum of the
    /// absolute values of its terms, of which rounding makes a part; none where a matrix has no inverse.
    pub fn spatial_drift(
        &self,
        (g, mu): (&[f64], &[f64]),
        (next_g, next_mu): (&[f64], &[f64]),
    ) -> Option<f64> {
        let mut largest = 0.0;
        for factor in &self.factors {
            let (one, size) = factor.spatial_momentum(g, mu)?;
            let (other, next_size) = factor.spatial_momentum(next_g, next_mu)?;
            let whole = size.amax() + next_size.amax();
            let difference = (one - other).amax();
            let drift = if difference == 0.0 { 0.0 } else { difference / whole };
            // NaN stays.
            if drift.is_nan() || drift > largest {
                largest = drift;
            }
        }
        Some(largest)
    }
}

impl Factor {
    /// The spatial momentum of this factor, and for each coordinate the sum of the absolute values of its terms.
    fn spatial_momentum(&self, g: &[f64], mu: &[f64]) -> Option<(DVector<f64>, DVector<f64>)> {
        let width = (0..=g.len()).find(|n| n * n >= g.len())?;
        let entry = |i, j| g.get((self.row + i) * width + self.row + j).copied().unwrap_or(0.0);
        let element = DMatrix::from_fn(self.size, self.size, entry);
        let mu = DVector::from_column_slice(mu.get(self.first..self.first + self.dim)?);
        let inverse = element.clone().try_inverse()?;
        // The error of g⁻¹ from rounding g, entry by entry.
        let (size, back) = (element.abs(), inverse.abs());
        let rounded = &back * &size * &back;
        // Column j: the coordinates of Ad_{g⁻¹} e_j, and the sums of the absolute values of their terms.
        let (adjoint, absolute) = match &self.basis {
            None => (inverse, rounded),
            Some(basis) => {
                let mut sides = DMatrix::zeros(self.dim, self.dim);
                let mut sums = DMatrix::zeros(self.dim, self.dim);
                for (j, matrix) in basis.matrices.iter().enumerate() {
                    let turned = &inverse * matrix * &element;
                    let terms = &rounded * matrix.abs() * &size;
                    for (i, other) in basis.matrices.iter().enumerate() {
                        sides[(i, j)] = other.dot(&turned);
                        sums[(i, j)] = other.abs().dot(&terms);
                    }
                }
                let gram = basis.gram.clone().try_inverse()?;
                (&gram * sides, gram.abs() * sums)
            }
        };
        Some((adjoint.tr_mul(&mu), absolute.tr_mul(&mu.abs())))
    }
}

fn factors(algebra: &LieAlgebra) -> Vec<Factor> {
    let (mut first, mut row) = (0, 0);
    let factor = |factor: LieAlgebra| {
        let dim = factor.dim();
        let size = factor.basis().map_or(dim, |b| b.first().map_or(0, RationalMatrix::rows));
        let basis = factor.basis().map(|basis| {
            let matrices: Vec<DMatrix<f64>> = basis.iter().map(float).collect();
            let gram = DMatrix::from_fn(dim, dim, |i, j| matrices[i].dot(&matrices[j]));
            Basis { matrices, gram }
        });
        let found = Factor { first, dim, row, size, basis };
        first += dim;
        row += size;
        found
    };
    algebra.factors().into_iter().map(factor).collect()
}

fn float(exact: &RationalMatrix) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(exact.rows(), exact.columns());
    for (i, j, value) in exact.entries() {
        matrix[(i, j)] = value.to_f64().unwrap_or(f64::NAN);
    }
    matrix
}
