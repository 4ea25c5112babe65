//! The Heisenberg group; elements as the entries (g₁₂, g₂₃, g₁₃) of an upper unitriangular matrix.

use crate::graph::{Graph, Id};
use crate::step::part::{Moved, Part};
use crate::step::vector::{Matrix, finite};

/// The upper unitriangular matrices of three rows. Cubes of what is above the diagonal vanish, so that the series of the
/// exponential end, and Cayley's chart is the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unitriangular;

/// μ + s·ad_xᵀ μ = (μ₁ − s x₂ μ₃, μ₂ + s x₁ μ₃, μ₃)
fn turned(graph: &mut Graph, s: f64, x: &[Id], mu: &[Id]) -> Vec<Id> {
    let s = graph.constant(s);
    let along = graph.mul(s, mu[2]);
    let back = graph.neg(along);
    vec![graph.times_plus(back, x[1], mu[0]), graph.times_plus(along, x[0], mu[1]), mu[2]]
}

impl Part for Unitriangular {
    fn dim(&self) -> usize {
        3
    }

    fn element(&self) -> usize {
        3
    }

    fn pull_back(&self, graph: &mut Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        turned(graph, 0.5, x, mu)
    }

    fn pull_back_with_derivative(
        &self,
        graph: &mut Graph,
        x: &[Id],
        mu: &[Id],
    ) -> (Vec<Id>, Matrix) {
        let half = graph.constant(0.5);
        let along = graph.mul(half, mu[2]);
        let back = graph.neg(along);
        let mut slope = Matrix::zeros(graph, 3, 3);
        slope.set(0, 1, back);
        slope.set(1, 0, along);
        (self.pull_back(graph, x, mu), slope)
    }

    fn transport(&self, graph: &mut Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        // g₁₃ + x₃ + (g₁₂ + x₁/2) x₂
        let half = graph.constant(0.5);
        let middle = graph.times_plus(half, x[0], g[0]);
        let corner = graph.add(g[2], x[2]);
        let corner = graph.times_plus(middle, x[1], corner);
        let g = vec![graph.add(g[0], x[0]), graph.add(g[1], x[1]), corner];
        Moved { g, mu: turned(graph, 1.0, x, mu) }
    }

    fn move_frame(&self, graph: &mut Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(self.transport(graph, g, y, mu))
    }

    fn spatial(&self, graph: &mut Graph, g: &[Id], _back: &[Id], mu: &[Id]) -> Vec<Id> {
        turned(graph, -1.0, g, mu)
    }

    fn extent(&self, graph: &mut Graph, x: &[Id]) -> Id {
        finite(graph, x)
    }

    fn defect(&self, graph: &mut Graph, g: &[Id]) -> Id {
        finite(graph, g)
    }

    fn matrix(&self, graph: &mut Graph, g: &[Id]) -> Matrix {
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        let rows = [[one, g[0], g[2]], [zero, one, g[1]], [zero, zero, one]];
        Matrix::new(3, 3, |i, j| rows[i][j])
    }

    fn about(&self) -> String {
        "the entries (1, 2), (2, 3) and (1, 3) of the upper triangular matrix".into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        [1, 5, 2].map(|entry| matrix.get(entry).copied().unwrap_or(0.0)).to_vec()
    }
}
