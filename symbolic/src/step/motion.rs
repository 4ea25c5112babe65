//! SE(3), elements as a unit quaternion (w, i, j, k) and a translation, and SE(2) in it.

use coadjoint_geometry::angle::Length;
use coadjoint_geometry::motion::{self, Motion};
use coadjoint_geometry::plane;

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::product::{Moved, Part};
use crate::step::rotation::{Rotation, quaternion_of};
use crate::step::traced::{Traced, matrix, nodes, traced};
use crate::step::vector::Matrix;

/// The motions of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Motions {
    /// The chart.
    pub chart: Chart,
}

/// The |ω| at which a chart ends.
fn limit(chart: Chart) -> f64 {
    Rotation { chart, double_cover: false }.limit()
}

/// The state moved by a motion.
fn moved(graph: &Graph, motion: Motion<Traced<'_>>, g: &[Id], mu: &[Id]) -> Moved {
    let (g, mu) = (motion.after(traced(graph, g)), motion.back(traced(graph, mu)));
    Moved { g: nodes(graph, g), mu: nodes(graph, mu) }
}

impl Part for Motions {
    fn dim(&self) -> usize {
        6
    }

    fn element(&self) -> usize {
        7
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let value = match self.chart {
            Chart::Exponential => motion::pull_back(x, mu, Length::Short),
            Chart::Cayley => motion::cayley_pull_back(x, mu),
        };
        nodes(graph, value)
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let (value, derivative) = match self.chart {
            Chart::Exponential => motion::pull_back_with_derivative(x, mu),
            Chart::Cayley => motion::cayley_pull_back_with_derivative(x, mu),
        };
        (nodes(graph, value), matrix(graph, derivative))
    }

    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        nodes(graph, motion::momentum(traced(graph, x), traced(graph, p), degree))
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let x = traced(graph, x);
        let motion = match self.chart {
            Chart::Exponential => Motion::exp(x, Length::Short),
            Chart::Cayley => Motion::cayley(x),
        };
        moved(graph, motion, g, mu)
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(moved(graph, Motion::exp(traced(graph, y), Length::Long), g, mu))
    }

    fn spatial(&self, graph: &Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        nodes(graph, motion::coadjoint(traced(graph, g), traced(graph, mu)))
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        motion::extent(traced(graph, x), limit(self.chart)).id(graph)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        motion::defect(traced(graph, g)).id(graph)
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        matrix(graph, motion::matrix(traced(graph, g)))
    }

    fn about(&self) -> String {
        "a unit quaternion (w, x, y, z), the rotation from body to space, then the translation"
            .into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let mut element = quaternion_of(matrix, 4);
        let place = |i: usize| matrix.get(i * 4 + 3).copied().unwrap_or(0.0);
        element.extend((0..3).map(place));
        element
    }
}

/// The motions of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Plane {
    /// The chart.
    pub chart: Chart,
}

impl Plane {
    fn moved(graph: &Graph, motion: Motion<Traced<'_>>, g: &[Id], mu: &[Id]) -> Moved {
        let (g, mu) = plane::transport(traced(graph, g), motion, traced(graph, mu));
        Moved { g: nodes(graph, g), mu: nodes(graph, mu) }
    }
}

impl Part for Plane {
    fn dim(&self) -> usize {
        3
    }

    fn element(&self) -> usize {
        4
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let value = match self.chart {
            Chart::Exponential => plane::pull_back(x, mu, Length::Short),
            Chart::Cayley => plane::cayley_pull_back(x, mu),
        };
        nodes(graph, value)
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let of_space = match self.chart {
            Chart::Exponential => motion::pull_back_with_derivative,
            Chart::Cayley => motion::cayley_pull_back_with_derivative,
        };
        let (value, derivative) = plane::pull_back_with_derivative(x, mu, of_space);
        (nodes(graph, value), matrix(graph, derivative))
    }

    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        nodes(graph, plane::momentum(traced(graph, x), traced(graph, p), degree))
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let x = traced(graph, x);
        let motion = match self.chart {
            Chart::Exponential => plane::exp(x, Length::Short),
            Chart::Cayley => plane::cayley(x),
        };
        Self::moved(graph, motion, g, mu)
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(Self::moved(graph, plane::exp(traced(graph, y), Length::Long), g, mu))
    }

    fn spatial(&self, graph: &Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        nodes(graph, plane::coadjoint(traced(graph, g), traced(graph, mu)))
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        plane::extent(traced(graph, x), limit(self.chart)).id(graph)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        plane::defect(traced(graph, g)).id(graph)
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        matrix(graph, plane::matrix(traced(graph, g)))
    }

    fn about(&self) -> String {
        "the cosine and the sine of half the angle from body to space, then the translation".into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let m = |i: usize, j: usize| matrix.get(i * 3 + j).copied().unwrap_or(0.0);
        let space = [
            [m(0, 0), m(0, 1), 0.0, m(0, 2)],
            [m(1, 0), m(1, 1), 0.0, m(1, 2)],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        let element = Motions { chart: self.chart }.element_of(space.as_flattened());
        [0, 3, 4, 5].map(|place| element[place]).to_vec()
    }
}
