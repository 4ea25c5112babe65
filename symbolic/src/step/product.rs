//! Direct products, factor by factor.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::graph::{Graph, Id};
use crate::step::vector::{Matrix, finite, largest};

/// A direct product: coordinates and elements of its factors one after the other.
#[derive(Debug)]
pub(crate) struct Product(pub Vec<Box<dyn Part>>);

/// A factor, the places of its coordinates, and those of its numbers in an element.
struct Factor<'a> {
    part: &'a dyn Part,
    own: Range<usize>,
    element: Range<usize>,
}

impl Product {
    fn factors(&self) -> Vec<Factor<'_>> {
        let (mut dim, mut element) = (0, 0);
        let mut factor = |part: &dyn Part| {
            let (own, numbers) = (dim..dim + part.dim(), element..element + part.element());
            (dim, element) = (own.end, numbers.end);
            (own, numbers)
        };
        let places: Vec<_> = self.0.iter().map(|part| factor(part.as_ref())).collect();
        let factors = self.0.iter().zip(places);
        factors.map(|(part, (own, element))| Factor { part: part.as_ref(), own, element }).collect()
    }

    /// Lists of the factors one after the other.
    fn joined<T>(&self, list: impl FnMut(Factor<'_>) -> Vec<T>) -> Vec<T> {
        self.factors().into_iter().flat_map(list).collect()
    }

    /// The coordinates of those factors that have one of these, factor by factor.
    pub(crate) fn whole_factors(&self, coordinates: &BTreeSet<usize>) -> Vec<Range<usize>> {
        let factors = self.factors().into_iter().map(|factor| factor.own);
        factors.filter(|own| own.clone().any(|i| coordinates.contains(&i))).collect()
    }

    /// The rows of a factor's matrices.
    fn size(part: &dyn Part) -> usize {
        let graph = Graph::new();
        let g: Vec<Id> = (0..part.element()).map(|i| graph.input(i)).collect();
        part.matrix(&graph, &g).rows()
    }
}

impl Part for Product {
    fn dim(&self) -> usize {
        self.0.iter().map(|part| part.dim()).sum()
    }

    fn element(&self) -> usize {
        self.0.iter().map(|part| part.element()).sum()
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        self.joined(|Factor { part, own, .. }| part.pull_back(graph, &x[own.clone()], &mu[own]))
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let n = self.dim();
        let mut derivative = Matrix::zeros(graph, n, n);
        let mut value = Vec::with_capacity(n);
        for Factor { part, own, .. } in self.factors() {
            let (p, slope) =
                part.pull_back_with_derivative(graph, &x[own.clone()], &mu[own.clone()]);
            value.extend(p);
            for i in 0..own.len() {
                for j in 0..own.len() {
                    derivative.set(own.start + i, own.start + j, slope.at(i, j));
                }
            }
        }
        (value, derivative)
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let moved = self.factors().into_iter().map(|Factor { part, own, element }| {
            let Moved { g, mu } = part.transport(graph, &g[element], &x[own.clone()], &mu[own]);
            (g, mu)
        });
        let (g, mu): (Vec<_>, Vec<_>) = moved.unzip();
        Moved { g: g.concat(), mu: mu.concat() }
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let mut moved = Moved { g: Vec::new(), mu: Vec::new() };
        for Factor { part, own, element } in self.factors() {
            let (g, y, mu) = (&g[element], &y[own.clone()], &mu[own]);
            let own_moved = match y.iter().all(|&entry| graph.is_zero(entry)) {
                true => Moved { g: g.to_vec(), mu: mu.to_vec() },
                false => part.move_frame(graph, g, y, mu)?,
            };
            moved.g.extend(own_moved.g);
            moved.mu.extend(own_moved.mu);
        }
        Some(moved)
    }

    fn trail(&self, graph: &Graph, y: &[Id], xi: &[Id], change: &[Id]) -> Vec<Id> {
        self.joined(|Factor { part, own, .. }| {
            let [y, xi, change] = [y, xi, change].map(|list| &list[own.clone()]);
            match [y, change].concat().iter().all(|&entry| graph.is_zero(entry)) {
                true => xi.to_vec(),
                false => part.trail(graph, y, xi, change),
            }
        })
    }

    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        self.joined(|Factor { part, own, .. }| {
            part.node_momentum(graph, &x[own.clone()], &p[own], degree)
        })
    }

    fn spatial(&self, graph: &Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id> {
        self.joined(|Factor { part, own, element }| {
            part.spatial(graph, &g[element.clone()], &back[element], &mu[own])
        })
    }

    fn inverted(&self) -> Vec<(usize, usize)> {
        self.joined(|Factor { part, element, .. }| {
            let places = part.inverted().into_iter();
            places.map(|(at, rows)| (element.start + at, rows)).collect()
        })
    }

    fn estimated(&self) -> f64 {
        self.0.iter().map(|part| part.estimated()).fold(1.0, f64::min)
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        let extents = self.joined(|Factor { part, own, .. }| vec![part.extent(graph, &x[own])]);
        // The larger of two may hide what is not a number; their sum does not.
        let sum = extents.iter().fold(graph.zero(), |sum, &extent| graph.add(sum, extent));
        graph.add(largest(graph, &extents), finite(graph, &[sum]))
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        let mut sum = graph.zero();
        for Factor { part, element, .. } in self.factors() {
            sum = graph.add(sum, part.defect(graph, &g[element]));
        }
        sum
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        let blocks: Vec<Matrix> = self
            .factors()
            .into_iter()
            .map(|factor| factor.part.matrix(graph, &g[factor.element]))
            .collect();
        let size = blocks.iter().map(Matrix::rows).sum();
        let mut whole = Matrix::zeros(graph, size, size);
        let mut start = 0;
        for block in blocks {
            for i in 0..block.rows() {
                for j in 0..block.rows() {
                    whole.set(start + i, start + j, block.at(i, j));
                }
            }
            start += block.rows();
        }
        whole
    }

    fn about(&self) -> String {
        let factors: Vec<String> = self.0.iter().map(|part| part.about()).collect();
        factors.join("; ")
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let (size, mut start) = (matrix.len().isqrt(), 0);
        self.joined(|Factor { part, .. }| {
            let rows = Self::size(part);
            let place = |at: usize| (start + at / rows) * size + start + at % rows;
            let entry = |at| matrix.get(place(at)).copied().unwrap_or(0.0);
            let block: Vec<f64> = (0..rows * rows).map(entry).collect();
            start += rows;
            part.element_of(&block)
        })
    }
}

/// [`Part::estimated`] where nothing better is known, and where S is no series with a radius: beyond, estimates were found
/// ten times too small.
pub(crate) const ESTIMATED: f64 = 1.0 / 3.0;

/// A factor of a group, with the chart of a step: what programs of a step are built of.
///
/// Coordinates x and μ have n entries, a group element m numbers. Conventions are those of the runtime's `LieGroup`.
pub(crate) trait Part: std::fmt::Debug + Send + Sync {
    /// n, the dimension.
    fn dim(&self) -> usize;

    /// m, how many numbers make a group element.
    fn element(&self) -> usize;

    /// (d^R τ_x)ᵀ μ
    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        self.pull_back_with_derivative(graph, x, mu).0
    }

    /// (d^R τ_x)ᵀ μ and its derivative in x, which Newton's method alone uses.
    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix);

    /// g·τ(x) and Ad\*_{τ(x)⁻¹} μ.
    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved;

    /// J_R(x, p), the body momentum at a point of the exponential chart about the middle of a step of collocation. A series in x
    /// ends with the power `degree`.
    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id>;

    /// g·exp(y) and Ad\*_{exp(−y)} μ: the motion of a comoving frame, of any length.
    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved>;

    /// Ad_{exp(−y)} ξ + (d^L exp_y) δ for a motion of a comoving frame whose y changes by δ, of any length.
    fn trail(&self, graph: &Graph, y: &[Id], xi: &[Id], change: &[Id]) -> Vec<Id>;

    /// Ad\*_g μ, the spatial momentum. `back` has the numbers of g⁻¹ where [`Part::inverted`] asks for them, else
    /// anything.
    fn spatial(&self, graph: &Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id>;

    /// Parts of an element that are matrices with an inverse that formulas do not give: where each begins, and its rows.
    fn inverted(&self) -> Vec<(usize, usize)> {
        Vec::new()
    }

    /// The extent of x in the chart: the square of its share of a half turn, or a bound on it; not a number where x is not
    /// finite. These formulas hold up to half a half turn.
    fn extent(&self, graph: &Graph, x: &[Id]) -> Id;

    /// Up to which share of a half turn the estimate of what Newton's method leaves is taken for a bound, if S is a series
    /// with a radius.
    fn estimated(&self) -> f64 {
        ESTIMATED
    }

    /// The distance of g from the group; NaN if g is not finite.
    fn defect(&self, graph: &Graph, g: &[Id]) -> Id;

    /// The matrix of g.
    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix;

    /// A description of the numbers of an element.
    fn about(&self) -> String;

    /// The numbers of the element with this matrix, row by row.
    fn element_of(&self, matrix: &[f64]) -> Vec<f64>;
}

/// A state moved on.
#[derive(Clone, Debug)]
pub(crate) struct Moved {
    /// The group element.
    pub g: Vec<Id>,
    /// The momentum.
    pub mu: Vec<Id>,
}

/// The translations of n dimensions, and beside the vector numbers that steps by collocation leave to the next one. They
/// commute, so that μ stays, both charts are the same, and a step may be of any length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Translations {
    /// n.
    pub dim: usize,
    /// How many numbers steps leave.
    pub memory: usize,
}

impl Part for Translations {
    fn dim(&self) -> usize {
        self.dim
    }

    fn element(&self) -> usize {
        self.dim + self.memory
    }

    fn pull_back_with_derivative(&self, graph: &Graph, _x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        (mu.to_vec(), Matrix::zeros(graph, self.dim, self.dim))
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let moved = g.iter().zip(x).map(|(&g, &x)| graph.add(g, x));
        Moved { g: moved.chain(g[self.dim..].iter().copied()).collect(), mu: mu.to_vec() }
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        Some(self.transport(graph, g, y, mu))
    }

    fn trail(&self, graph: &Graph, _y: &[Id], xi: &[Id], change: &[Id]) -> Vec<Id> {
        xi.iter().zip(change).map(|(&xi, &change)| graph.add(xi, change)).collect()
    }

    fn node_momentum(&self, _graph: &Graph, _x: &[Id], p: &[Id], _degree: usize) -> Vec<Id> {
        p.to_vec()
    }

    fn spatial(&self, _graph: &Graph, _g: &[Id], _back: &[Id], mu: &[Id]) -> Vec<Id> {
        mu.to_vec()
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        finite(graph, x)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        finite(graph, &g[..self.dim])
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        // Of numbers alone there is none.
        let size = self.dim + self.dim.min(1);
        Matrix::new(size, size, |i, j| match (i, j) {
            _ if i == j => one,
            _ if j == self.dim => g[i],
            _ => zero,
        })
    }

    fn about(&self) -> String {
        match self.memory {
            0 => "the vector".into(),
            numbers => format!("{numbers} numbers that steps leave to the next one, at first 0"),
        }
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let column = matrix.iter().skip(self.dim).step_by(self.dim + 1);
        column.take(self.dim).copied().chain((0..self.memory).map(|_| 0.0)).collect()
    }
}
