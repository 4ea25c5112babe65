//! Groups in closed form, whose formulas are traced.

use std::f64::consts::PI;
use std::fmt::Debug;
use std::marker::PhantomData;

use coadjoint_geometry::angle::Length;
use coadjoint_geometry::group::{Group, Matrices};
use coadjoint_geometry::motion::Motions;
use coadjoint_geometry::plane::Plane;
use coadjoint_geometry::rotation::Quaternions;

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::product::{ESTIMATED, Moved, Part};
use crate::step::traced::{Traced, matrix, nodes, traced};
use crate::step::transposed::transposed;
use crate::step::vector::Matrix;

/// The group of formulas G: N coordinates, elements of M numbers, matrices of D rows.
#[derive(Debug)]
pub(crate) struct Closed<G, const N: usize, const M: usize, const D: usize> {
    chart: Chart,
    /// [`Part::estimated`]
    estimated: f64,
    about: &'static str,
    element_of: fn(&[f64]) -> Vec<f64>,
    group: PhantomData<fn() -> G>,
}

/// The group in closed form of this name.
pub(crate) fn closed(name: &str, chart: Chart) -> Option<Box<dyn Part>> {
    fn of<G, const N: usize, const M: usize, const D: usize>(
        chart: Chart,
        estimated: f64,
        about: &'static str,
        element_of: fn(&[f64]) -> Vec<f64>,
    ) -> Option<Box<dyn Part>>
    where
        G: Group<N, M> + Matrices<M, D> + Debug + 'static,
    {
        let group = PhantomData::<fn() -> G>;
        Some(Box::new(Closed::<G, N, M, D> { chart, estimated, about, element_of, group }))
    }
    match name {
        "SO3" => of::<Quaternions<false>, 3, 4, 3>(
            chart,
            0.5,
            "a unit quaternion (w, x, y, z), the rotation from body to space",
            |matrix| quaternion_of(matrix, 3),
        ),
        "SU2" => of::<Quaternions<true>, 3, 4, 4>(
            chart,
            ESTIMATED,
            "a unit quaternion (w, x, y, z)",
            quaternion_of_cover,
        ),
        "SE3" => of::<Motions, 6, 7, 4>(
            chart,
            ESTIMATED,
            "a unit quaternion (w, x, y, z), the rotation from body to space, then the translation",
            motion_of,
        ),
        "SE2" => of::<Plane, 3, 4, 3>(
            chart,
            ESTIMATED,
            "the cosine and the sine of half the angle from body to space, then the translation",
            motion_of_plane,
        ),
        _ => None,
    }
}

/// The unit quaternion of a rotation matrix, row by row with `stride` numbers a row (S. Shepperd, J. Guidance 1, 1978).
fn quaternion_of(matrix: &[f64], stride: usize) -> Vec<f64> {
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

/// The element of SU(2) with this matrix.
fn quaternion_of_cover(matrix: &[f64]) -> Vec<f64> {
    let m = |i: usize, j: usize| matrix.get(i * 4 + j).copied().unwrap_or(0.0);
    let q = [m(0, 0), -m(2, 1), m(1, 0), -m(2, 0)];
    let norm = q.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    q.iter().map(|entry| entry / norm).collect()
}

/// The quaternion and the translation of a motion.
fn motion_of(matrix: &[f64]) -> Vec<f64> {
    let mut element = quaternion_of(matrix, 4);
    let place = |i: usize| matrix.get(i * 4 + 3).copied().unwrap_or(0.0);
    element.extend((0..3).map(place));
    element
}

/// The numbers of a motion of the plane, from its matrix.
fn motion_of_plane(matrix: &[f64]) -> Vec<f64> {
    let m = |i: usize, j: usize| matrix.get(i * 3 + j).copied().unwrap_or(0.0);
    let space = [
        [m(0, 0), m(0, 1), 0.0, m(0, 2)],
        [m(1, 0), m(1, 1), 0.0, m(1, 2)],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let element = motion_of(space.as_flattened());
    [0, 3, 4, 5].map(|place| element[place]).to_vec()
}

impl<G: Group<N, M>, const N: usize, const M: usize, const D: usize> Closed<G, N, M, D> {
    fn moved<'g>(
        graph: &'g Graph,
        increment: G::Increment<Traced<'g>>,
        g: &[Id],
        mu: &[Id],
    ) -> Moved {
        let g = G::after(increment, traced(graph, g));
        let mu = G::back(increment, traced(graph, mu));
        Moved { g: nodes(graph, g), mu: nodes(graph, mu) }
    }
}

impl<G, const N: usize, const M: usize, const D: usize> Part for Closed<G, N, M, D>
where
    G: Group<N, M> + Matrices<M, D> + Debug,
{
    fn dim(&self) -> usize {
        N
    }

    fn element(&self) -> usize {
        M
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let value = match self.chart {
            Chart::Exponential => G::pull_back(x, mu, Length::Short),
            Chart::Cayley => G::cayley_pull_back(x, mu),
        };
        nodes(graph, value)
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let (x, mu) = (traced(graph, x), traced(graph, mu));
        let (value, derivative) = match self.chart {
            Chart::Exponential => G::pull_back_with_derivative(x, mu),
            Chart::Cayley => G::cayley_pull_back_with_derivative(x, mu),
        };
        (nodes(graph, value), matrix(graph, derivative))
    }

    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        nodes(graph, G::momentum(traced(graph, x), traced(graph, p), degree))
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let x = traced(graph, x);
        let increment = match self.chart {
            Chart::Exponential => G::exp(x, Length::Short),
            Chart::Cayley => G::cayley(x),
        };
        Self::moved(graph, increment, g, mu)
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(Self::moved(graph, G::exp(traced(graph, y), Length::Long), g, mu))
    }

    fn trail(&self, graph: &Graph, y: &[Id], xi: &[Id], change: &[Id]) -> Vec<Id> {
        let maps = transposed(N, |graph, y, w| {
            let back = traced(graph, y).map(|y| -y);
            let (increment, w) = (G::exp(back, Length::Long), traced(graph, w));
            let moved = [G::back(increment, w), G::pull_back(back, w, Length::Long)];
            moved.map(|moved| nodes(graph, moved))
        });
        graph.call(&maps, &[y, xi, change, &[graph.zero(); N]].concat())
    }

    fn spatial(&self, graph: &Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        nodes(graph, G::coadjoint(traced(graph, g), traced(graph, mu)))
    }

    fn estimated(&self) -> f64 {
        self.estimated
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        let limit = match self.chart {
            Chart::Exponential => PI,
            Chart::Cayley => G::CAYLEY_LIMIT,
        };
        G::extent(traced(graph, x), limit).id(graph)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        G::defect(traced(graph, g)).id(graph)
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        matrix(graph, G::matrix(traced(graph, g)))
    }

    fn about(&self) -> String {
        self.about.into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        (self.element_of)(matrix)
    }
}
