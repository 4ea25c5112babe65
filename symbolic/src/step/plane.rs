//! SE(2) as the motions of space that keep the third axis; elements as (w, k) of the quaternion, and two coordinates.

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::motion::Motion;
use crate::step::part::{Moved, Part};
use crate::step::vector::Matrix;

/// The motions of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Plane {
    /// The chart.
    pub chart: Chart,
}

/// The coordinates of se(2) in se(3).
const PLACES: [usize; 3] = [2, 3, 4];

/// The numbers of an element among those of a motion of space.
const NUMBERS: [usize; 4] = [0, 3, 4, 5];

fn lift<const N: usize>(
    graph: &mut Graph,
    list: &[Id],
    places: &[usize],
    zeros: [(); N],
) -> Vec<Id> {
    let zero = graph.zero();
    let mut lifted = vec![zero; zeros.len()];
    for (&place, &entry) in places.iter().zip(list) {
        lifted[place] = entry;
    }
    lifted
}

fn drop(list: &[Id], places: &[usize]) -> Vec<Id> {
    places.iter().map(|&place| list[place]).collect()
}

impl Plane {
    fn space(self) -> Motion {
        Motion { chart: self.chart }
    }
}

fn flat(moved: &Moved) -> Moved {
    Moved { g: drop(&moved.g, &NUMBERS), mu: drop(&moved.mu, &PLACES) }
}

impl Part for Plane {
    fn dim(&self) -> usize {
        3
    }

    fn element(&self) -> usize {
        4
    }

    fn pull_back(&self, graph: &mut Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let (x, mu) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        drop(&self.space().pull_back(graph, &x, &mu), &PLACES)
    }

    fn pull_back_with_derivative(
        &self,
        graph: &mut Graph,
        x: &[Id],
        mu: &[Id],
    ) -> (Vec<Id>, Matrix) {
        let (x, mu) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        let (p, slope) = self.space().pull_back_with_derivative(graph, &x, &mu);
        (drop(&p, &PLACES), Matrix::new(3, 3, |i, j| slope.at(PLACES[i], PLACES[j])))
    }

    fn transport(&self, graph: &mut Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let (x, mu) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        flat(&self.space().transport(graph, &g, &x, &mu))
    }

    fn move_frame(&self, graph: &mut Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let (y, mu) = (lift(graph, y, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        self.space().move_frame(graph, &g, &y, &mu).map(|moved| flat(&moved))
    }

    fn spatial(&self, graph: &mut Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id> {
        let (g, mu) = (lift(graph, g, &NUMBERS, [(); 7]), lift(graph, mu, &PLACES, [(); 6]));
        drop(&self.space().spatial(graph, &g, back, &mu), &PLACES)
    }

    fn extent(&self, graph: &mut Graph, x: &[Id]) -> Id {
        let x = lift(graph, x, &PLACES, [(); 6]);
        self.space().extent(graph, &x)
    }

    fn defect(&self, graph: &mut Graph, g: &[Id]) -> Id {
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        self.space().defect(graph, &g)
    }

    fn matrix(&self, graph: &mut Graph, g: &[Id]) -> Matrix {
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        let whole = self.space().matrix(graph, &g);
        const KEPT: [usize; 3] = [0, 1, 3];
        Matrix::new(3, 3, |i, j| whole.at(KEPT[i], KEPT[j]))
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
        let element = self.space().element_of(space.as_flattened());
        NUMBERS.iter().map(|&place| element[place]).collect()
    }
}
