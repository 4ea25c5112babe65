//! Velocities and torques given along the axes of space, as the body has them.

use coadjoint_program::{Graph, Id};
use num_traits::ToPrimitive;

use crate::lie::{LieAlgebra, RationalMatrix};

/// The coadjoint and the adjoint action of g⁻¹, by the matrix of g, on a group of rotations and motions: its matrices are ((A, c), (0, 1))
/// with an orthogonal A, up to the order of rows.
#[derive(Clone, Debug)]
pub struct Spatial {
    basis: Vec<RationalMatrix>,
    /// Matrices Dₖ with ⟨Dₖ, Eₗ⟩ = δₖₗ.
    dual: Vec<RationalMatrix>,
    /// For each row, if it is one of A.
    turned: Vec<bool>,
}

impl Spatial {
    /// The actions of this algebra's group; `None` where its matrices are of another form.
    pub fn new(algebra: &LieAlgebra) -> Option<Self> {
        let (basis, size) = (algebra.matrices(), algebra.matrix_size());
        let moves = |row| basis.iter().any(|e| e.entries().any(|(i, ..)| i == row));
        let turned: Vec<bool> = (0..size).map(moves).collect();
        let fits = |e: &RationalMatrix| {
            e.entries().all(|(i, j, value)| !turned[j] || *value == -e.get(j, i))
        };
        let dual = algebra.dual_matrices()?;
        basis.iter().all(fits).then_some(Self { basis, dual, turned })
    }

    /// The velocity in the body, Ad_{g⁻¹} η, of one in space.
    pub(crate) fn velocity(&self, graph: &Graph, g: &[Id], eta: &[Id]) -> Vec<Id> {
        let inside = sum(graph, &self.basis, eta, self.size());
        let inverse = self.inverse(graph, g);
        let moved = product(graph, &product(graph, &inverse, &inside), &matrix(g, self.size()));
        self.dual.iter().map(|dual| pairing(graph, dual, &moved)).collect()
    }

    /// The torque on the body, Ad\*_{g⁻¹} τ, of one in space: g·μ then changes by the integral of τ.
    pub(crate) fn torque(&self, graph: &Graph, g: &[Id], tau: &[Id]) -> Vec<Id> {
        // ⟨τ, Ad_g Eₖ⟩ = ⟨W, g Eₖ g⁻¹⟩ = ⟨gᵀ W g⁻ᵀ, Eₖ⟩ with W = Σ τₗ Dₗ.
        let inside = sum(graph, &self.dual, tau, self.size());
        let back = transposed(&self.inverse(graph, g));
        let turned = product(graph, &transposed(&matrix(g, self.size())), &inside);
        let moved = product(graph, &turned, &back);
        self.basis.iter().map(|e| pairing(graph, e, &moved)).collect()
    }

    fn size(&self) -> usize {
        self.turned.len()
    }

    /// ((Aᵀ, −Aᵀ c), (0, 1))
    fn inverse(&self, graph: &Graph, g: &[Id]) -> Rows {
        let (size, g) = (self.size(), matrix(g, self.size()));
        let entry = |i: usize, j: usize| match (self.turned[i], self.turned[j]) {
            (true, true) => g[j][i],
            (false, _) => graph.constant(f64::from(u8::from(i == j))),
            (true, false) => {
                let rows = (0..size).filter(|&k| self.turned[k]);
                graph.neg(rows.fold(graph.zero(), |sum, k| graph.times_plus(g[k][i], g[k][j], sum)))
            }
        };
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    }
}

/// A matrix by its rows.
type Rows = Vec<Vec<Id>>;

fn matrix(g: &[Id], size: usize) -> Rows {
    g.chunks(size).take(size).map(<[Id]>::to_vec).collect()
}

fn transposed(a: &Rows) -> Rows {
    (0..a.len()).map(|j| a.iter().map(|row| row[j]).collect()).collect()
}

fn product(graph: &Graph, a: &Rows, b: &Rows) -> Rows {
    let entry = |row: &[Id], j: usize| {
        let terms = row.iter().zip(b);
        terms.fold(graph.zero(), |sum, (&a, b)| graph.times_plus(a, b[j], sum))
    };
    a.iter().map(|row| (0..row.len()).map(|j| entry(row, j)).collect()).collect()
}

/// Σ weightᵢ · matrixᵢ
fn sum(graph: &Graph, matrices: &[RationalMatrix], weights: &[Id], size: usize) -> Rows {
    let mut sum = vec![vec![graph.zero(); size]; size];
    for (matrix, &weight) in matrices.iter().zip(weights) {
        for (i, j, value) in matrix.entries() {
            let value = graph.constant(value.to_f64().unwrap_or(f64::NAN));
            sum[i][j] = graph.times_plus(value, weight, sum[i][j]);
        }
    }
    sum
}

/// Σ of the entries of one matrix times those of another.
fn pairing(graph: &Graph, constant: &RationalMatrix, matrix: &Rows) -> Id {
    constant.entries().fold(graph.zero(), |sum, (i, j, value)| {
        let value = graph.constant(value.to_f64().unwrap_or(f64::NAN));
        graph.times_plus(value, matrix[i][j], sum)
    })
}
