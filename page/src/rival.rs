//! The classical method of Runge and Kutta for the same equations, to run beside.
//!
//! μ̇ = ad\*_ξ μ and ġ = g·ξ with ξ = ∂H/∂μ, g as a matrix, by the same interpreter; so that what a step costs is
//! counted in the same operations.

use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix};
use coadjoint_codegen::number::nearest_float;
use coadjoint_program::{Graph, Id, Program};
use nalgebra::{DMatrix, DVector};

/// A step of the method, and how its states are read.
#[derive(Debug)]
pub struct Rival {
    dim: usize,
    size: usize,
    /// Places of the entries of g that can differ from those of the identity, row by row.
    entries: Vec<usize>,
    /// μ, entries, h, t ↦ μ, entries.
    step: Program,
    /// μ, t ↦ μ̇.
    rate: Program,
    /// The coefficients of both.
    slots: Vec<f64>,
    /// The matrices e_i, and the inverse of their Gram matrix; none where g is an adjoint matrix.
    basis: Option<(Vec<DMatrix<f64>>, DMatrix<f64>)>,
}

impl Rival {
    /// The method on a group for the Hamiltonian with this gradient, of μ and perhaps t, and its coefficients.
    pub fn new(algebra: &LieAlgebra, gradient: &Program, slots: &[f64]) -> Self {
        let dim = algebra.dim();
        let matrices = matrices(algebra);
        let size = algebra.matrix_size();
        let entries = reached(&matrices, size);
        let field = Field { algebra, gradient, matrices: &matrices, size, entries: &entries };
        let basis = algebra.basis().and_then(|_| {
            let gram = DMatrix::from_fn(dim, dim, |i, j| matrices[i].dot(&matrices[j]));
            gram.try_inverse().map(|inverse| (matrices.clone(), inverse))
        });
        let (step, rate) = (field.step(), field.rate());
        Self { dim, size, step, rate, slots: slots.to_vec(), basis, entries }
    }

    pub fn cost(&self) -> usize {
        self.step.cost().total()
    }

    pub fn start(&self, momentum: &[f64]) -> Vec<f64> {
        let identity = |&at: &usize| f64::from(u8::from(at / self.size == at % self.size));
        momentum.iter().copied().chain(self.entries.iter().map(identity)).collect()
    }

    pub fn advance(&self, state: &[f64], time: f64, h: f64) -> Vec<f64> {
        self.step.run(&[state, &[h, time]].concat(), &self.slots)
    }

    /// μ̇ at (t, μ).
    pub fn rate(&self, time: f64, momentum: &[f64]) -> Vec<f64> {
        self.rate.run(&[momentum, &[time]].concat(), &self.slots)
    }

    /// The spatial momentum Ad\*_g μ of a state as it is, wherever it has left the group; NaN where g has no inverse.
    pub fn spatial(&self, state: &[f64]) -> Vec<f64> {
        let mut g = DMatrix::<f64>::identity(self.size, self.size);
        for (&at, &value) in self.entries.iter().zip(&state[self.dim..]) {
            g[(at / self.size, at % self.size)] = value;
        }
        let mu = DVector::from_column_slice(&state[..self.dim]);
        let nothing = || vec![f64::NAN; self.dim];
        let Some((basis, inverse)) = &self.basis else {
            let solved = g.transpose().lu().solve(&mu);
            return solved.map_or_else(nothing, |found| found.as_slice().to_vec());
        };
        let Some(back) = g.clone().try_inverse() else { return nothing() };
        let dual = inverse * mu;
        basis
            .iter()
            .map(|e| {
                let moved = &back * e * &g;
                basis.iter().zip(dual.iter()).map(|(e, dual)| e.dot(&moved) * dual).sum()
            })
            .collect()
    }
}

/// The basis, or the adjoint matrices.
fn matrices(algebra: &LieAlgebra) -> Vec<DMatrix<f64>> {
    let float = |exact: &RationalMatrix| {
        let entry = |i, j| nearest_float(&exact.get(i, j));
        DMatrix::from_fn(exact.rows(), exact.columns(), entry)
    };
    algebra.matrices().iter().map(float).collect()
}

/// The entries that products of exponentials can change.
fn reached(matrices: &[DMatrix<f64>], size: usize) -> Vec<usize> {
    let moves = DMatrix::from_fn(size, size, |i, j| matrices.iter().any(|e| e[(i, j)] != 0.0));
    let mut nonzero = DMatrix::from_fn(size, size, |i, j| i == j);
    let mut changed = DMatrix::from_element(size, size, false);
    loop {
        let mut grown = false;
        for i in 0..size {
            for j in 0..size {
                if !changed[(i, j)] && (0..size).any(|k| nonzero[(i, k)] && moves[(k, j)]) {
                    (changed[(i, j)], nonzero[(i, j)], grown) = (true, true, true);
                }
            }
        }
        if !grown {
            break;
        }
    }
    (0..size * size).filter(|&at| changed[(at / size, at % size)]).collect()
}

/// The equations of motion as nodes.
struct Field<'a> {
    algebra: &'a LieAlgebra,
    gradient: &'a Program,
    matrices: &'a [DMatrix<f64>],
    size: usize,
    entries: &'a [usize],
}

impl Field<'_> {
    fn dim(&self) -> usize {
        self.algebra.dim()
    }

    /// ξ = ∂H/∂μ.
    fn velocity(&self, graph: &Graph, mu: &[Id], time: Id) -> Vec<Id> {
        graph.call(self.gradient, &[mu, &[time]].concat())
    }

    /// ad\*_ξ μ.
    fn force(&self, graph: &Graph, xi: &[Id], mu: &[Id]) -> Vec<Id> {
        let mut force = vec![graph.zero(); self.dim()];
        for (i, j, k, value) in self.algebra.constants() {
            force[j] = graph.times_plus(graph.mul(xi[i], mu[k]), graph.constant(value), force[j]);
        }
        force
    }

    fn all(&self, graph: &Graph, state: &[Id], time: Id) -> Vec<Id> {
        let (mu, entries) = state.split_at(self.dim());
        let xi = self.velocity(graph, mu, time);
        let mut rates = self.force(graph, &xi, mu);
        // The entries of ξ as a matrix.
        let size = self.size;
        let zero = graph.zero();
        let mut moved = vec![zero; size * size];
        for (matrix, &xi) in self.matrices.iter().zip(&xi) {
            for at in 0..size * size {
                let value = matrix[(at / size, at % size)];
                if value != 0.0 {
                    moved[at] = graph.times_plus(graph.constant(value), xi, moved[at]);
                }
            }
        }
        for &at in self.entries {
            let (i, j) = (at / size, at % size);
            let mut sum = zero;
            for k in 0..size {
                let place = self.entries.binary_search(&(i * size + k));
                sum = match place {
                    Ok(place) => graph.times_plus(entries[place], moved[k * size + j], sum),
                    Err(_) if i == k => graph.add(moved[k * size + j], sum),
                    Err(_) => sum,
                };
            }
            rates.push(sum);
        }
        rates
    }

    fn step(&self) -> Program {
        let graph = Graph::new();
        let count = self.dim() + self.entries.len();
        let start: Vec<Id> = (0..count).map(|i| graph.input(i)).collect();
        let (h, start_time) = (graph.input(count), graph.input(count + 1));
        let share = |graph: &Graph, part: f64| graph.mul(h, graph.constant(part));
        let (half, sixth, third) =
            (share(&graph, 0.5), share(&graph, 1.0 / 6.0), share(&graph, 1.0 / 3.0));
        let along = |graph: &Graph, from: &[Id], by: Id, rates: &[Id]| -> Vec<Id> {
            from.iter().zip(rates).map(|(&a, &rate)| graph.times_plus(rate, by, a)).collect()
        };
        let mut end = start.clone();
        let (mut at, mut time) = (start.clone(), start_time);
        for (weight, next) in [(sixth, half), (third, half), (third, h), (sixth, h)] {
            let rates = self.all(&graph, &at, time);
            end = along(&graph, &end, weight, &rates);
            (at, time) = (along(&graph, &start, next, &rates), graph.add(start_time, next));
        }
        graph.finish(count + 2, &end)
    }

    fn rate(&self) -> Program {
        let graph = Graph::new();
        let mu: Vec<Id> = (0..self.dim()).map(|i| graph.input(i)).collect();
        let xi = self.velocity(&graph, &mu, graph.input(self.dim()));
        graph.finish(self.dim() + 1, &self.force(&graph, &xi, &mu))
    }
}
