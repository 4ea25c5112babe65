//! SO(3) and SU(2), elements as unit quaternions (w, i, j, k).

use std::f64::consts::PI;

use coadjoint_geometry::angle::{Length, QUARTER_TURN_NEWTON};
use coadjoint_geometry::rotation::{self, Turn};

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::product::{ESTIMATED, Moved, Part};
use crate::step::traced::{Traced, matrix, nodes, traced};
use crate::step::vector::Matrix;

/// The rotations of space, or their double cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rotation {
    /// The chart.
    pub chart: Chart,
    /// Whether elements tell x from x + 2π.
    pub double_cover: bool,
}

/// The unit quaternion of a rotation matrix, row by row with `stride` numbers a row (S. Shepperd, J. Guidance 1, 1978).
pub(crate) fn quaternion_of(matrix: &[f64], stride: usize) -> Vec<f64> {
    let m = |i: usize, j: usize| matrix.get(i * stride + j).copied().unwrap_or(0.0);
    let trace = m(0, 0) + m(1, 1) + m(2, 2);
    let squares = [trace, m(0, 0), m(1, 1), m(2, 2)];
    let largest = (0..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    let q = match largest {
        0 => [1.0 + trace, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)],
        axis => {
            let (i, j, k) = (axis - 1, axis % 3, (axis + 1) % 3);
            let mut q = [m(k, j) - m(j, k), 0.0, 0.0, 0.0];
            q[1 + i] = 1.0 + m(i, i) - m(j, j) - m(k, k);
            q[1 + j] = m(j, i) + m(i, j);
            q[1 + k] = m(k, i) + m(i, k);
            q
        }
    };
    let norm = q.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    q.iter().map(|entry| entry / norm).collect()
}

impl Rotation {
    /// The |x| at which the chart ends.
    pub(crate) fn limit(self) -> f64 {
        match (self.chart, self.double_cover) {
            (Chart::Exponential, _) => PI,
            (Chart::Cayley, false) => 2.0,
            (Chart::Cayley, true) => 4.0,
        }
    }
}

/// The state moved by a turn.
fn moved(graph: &Graph, turn: Turn<Traced<'_>>, g: &[Id], mu: &[Id]) -> Moved {
    let (g, mu) = (turn.after(traced(graph, g)), turn.back(traced(graph, mu)));
    Moved { g: nodes(graph, g), mu: nodes(graph, mu) }
}

impl Part for Rotation {
    fn dim(&self) -> usize {
        3
    }

    fn element(&self) -> usize {
        4
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        if self.chart == Chart::Cayley {
            return self.pull_back_with_derivative(graph, x, mu).0;
        }
        nodes(graph, rotation::pull_back(traced(graph, x), traced(graph, mu), Length::Short))
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let (value, derivative) = match (self.chart, self.double_cover) {
            (Chart::Exponential, _) => {
                rotation::pull_back_with_derivative(x, mu, QUARTER_TURN_NEWTON)
            }
            (Chart::Cayley, false) => rotation::cayley_pull_back(x, mu),
            (Chart::Cayley, true) => rotation::cayley_pull_back_of_cover(x, mu),
        };
        (nodes(graph, value), matrix(graph, derivative))
    }

    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        nodes(graph, rotation::momentum(traced(graph, x), traced(graph, p), degree))
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let x = traced(graph, x);
        let turn = match (self.chart, self.double_cover) {
            (Chart::Exponential, _) => Turn::exp(x, Length::Short),
            (Chart::Cayley, false) => Turn::cayley(x),
            (Chart::Cayley, true) => Turn::cayley_of_cover(x),
        };
        moved(graph, turn, g, mu)
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(moved(graph, Turn::exp(traced(graph, y), Length::Long), g, mu))
    }

    fn spatial(&self, graph: &Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        nodes(graph, rotation::rotate(traced(graph, g), traced(graph, mu)))
    }

    fn estimated(&self) -> f64 {
        if self.double_cover { ESTIMATED } else { 0.5 }
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        rotation::extent(traced(graph, x), self.limit()).id(graph)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        rotation::defect(traced(graph, g)).id(graph)
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        let g = traced(graph, g);
        match self.double_cover {
            true => matrix(graph, rotation::matrix_of_cover(g)),
            false => matrix(graph, rotation::matrix(g)),
        }
    }

    fn about(&self) -> String {
        let of = if self.double_cover { "" } else { ", the rotation from body to space" };
        format!("a unit quaternion (w, x, y, z){of}")
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        if !self.double_cover {
            return quaternion_of(matrix, 3);
        }
        let m = |i: usize, j: usize| matrix.get(i * 4 + j).copied().unwrap_or(0.0);
        let q = [m(0, 0), -m(2, 1), m(1, 0), -m(2, 0)];
        let norm = q.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        q.iter().map(|entry| entry / norm).collect()
    }
}
