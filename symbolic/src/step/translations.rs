//! The translations of a space; elements as vectors, the last column of their matrices.

use crate::graph::{Graph, Id};
use crate::step::product::{Moved, Part};
use crate::step::vector::{Matrix, finite};

/// The translations of n dimensions. They commute, so that μ stays, both charts are the same, and a step may be of any
/// length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Translations {
    /// n.
    pub dim: usize,
}

impl Part for Translations {
    fn dim(&self) -> usize {
        self.dim
    }

    fn element(&self) -> usize {
        self.dim
    }

    fn pull_back(&self, _graph: &Graph, _x: &[Id], mu: &[Id]) -> Vec<Id> {
        mu.to_vec()
    }

    fn pull_back_with_derivative(&self, graph: &Graph, _x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        (mu.to_vec(), Matrix::zeros(graph, self.dim, self.dim))
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let g = g.iter().zip(x).map(|(&g, &x)| graph.add(g, x)).collect();
        Moved { g, mu: mu.to_vec() }
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(self.transport(graph, g, y, mu))
    }

    fn spatial(&self, _graph: &Graph, _g: &[Id], _back: &[Id], mu: &[Id]) -> Vec<Id> {
        mu.to_vec()
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        finite(graph, x)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        finite(graph, g)
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        Matrix::new(self.dim + 1, self.dim + 1, |i, j| match (i, j) {
            _ if i == j => one,
            _ if j == self.dim => g[i],
            _ => zero,
        })
    }

    fn about(&self) -> String {
        "the vector".into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let column = matrix.iter().skip(self.dim).step_by(self.dim + 1);
        column.take(self.dim).copied().collect()
    }
}
