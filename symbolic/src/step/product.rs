//! Direct products, factor by factor.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::graph::{Graph, Id};
use crate::step::part::{Moved, Part};
use crate::step::vector::{Matrix, largest};

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

    /// The coordinates of those factors that have one of these, factor by factor.
    pub(crate) fn whole_factors(&self, coordinates: &BTreeSet<usize>) -> Vec<Range<usize>> {
        let factors = self.factors().into_iter().map(|factor| factor.own);
        factors.filter(|own| own.clone().any(|i| coordinates.contains(&i))).collect()
    }

    /// The rows of a factor's matrices.
    fn size(part: &dyn Part) -> usize {
        let mut graph = Graph::new();
        let g: Vec<Id> = (0..part.element()).map(|i| graph.input(i)).collect();
        part.matrix(&mut graph, &g).rows()
    }
}

impl Part for Product {
    fn dim(&self) -> usize {
        self.0.iter().map(|part| part.dim()).sum()
    }

    fn element(&self) -> usize {
        self.0.iter().map(|part| part.element()).sum()
    }

    fn pull_back(&self, graph: &mut Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        self.factors()
            .into_iter()
            .flat_map(|Factor { part, own, .. }| part.pull_back(graph, &x[own.clone()], &mu[own]))
            .collect()
    }

    fn pull_back_with_derivative(
        &self,
        graph: &mut Graph,
        x: &[Id],
        mu: &[Id],
    ) -> (Vec<Id>, Matrix) {
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

    fn transport(&self, graph: &mut Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let mut moved = Moved { g: Vec::new(), mu: Vec::new() };
        for Factor { part, own, element } in self.factors() {
            let own_moved = part.transport(graph, &g[element], &x[own.clone()], &mu[own]);
            moved.g.extend(own_moved.g);
            moved.mu.extend(own_moved.mu);
        }
        moved
    }

    fn move_frame(&self, graph: &mut Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
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

    fn spatial(&self, graph: &mut Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id> {
        let factors = self.factors().into_iter();
        factors
            .flat_map(|Factor { part, own, element }| {
                part.spatial(graph, &g[element.clone()], &back[element], &mu[own])
            })
            .collect()
    }

    fn inverted(&self) -> Vec<(usize, usize)> {
        let factors = self.factors().into_iter();
        let shifted = |Factor { part, element, .. }: Factor<'_>| {
            let places = part.inverted().into_iter();
            places.map(|(at, rows)| (element.start + at, rows)).collect::<Vec<_>>()
        };
        factors.flat_map(shifted).collect()
    }

    fn estimated(&self) -> f64 {
        self.0.iter().map(|part| part.estimated()).fold(1.0, f64::min)
    }

    fn extent(&self, graph: &mut Graph, x: &[Id]) -> Id {
        let extents: Vec<Id> = self
            .factors()
            .into_iter()
            .map(|factor| factor.part.extent(graph, &x[factor.own]))
            .collect();
        // The larger of two may hide what is not a number; their sum does not.
        let (zero, mut sum) = (graph.zero(), graph.zero());
        for &extent in &extents {
            sum = graph.add(sum, extent);
        }
        let largest = largest(graph, &extents);
        let one = graph.constant(1.0);
        let huge = graph.constant(f64::MAX);
        let valid = graph.select(sum, huge, zero, one);
        // More than one where any is not a number.
        let beyond = graph.add(valid, valid);
        graph.add(largest, beyond)
    }

    fn defect(&self, graph: &mut Graph, g: &[Id]) -> Id {
        let mut sum = graph.zero();
        for Factor { part, element, .. } in self.factors() {
            let own = part.defect(graph, &g[element]);
            sum = graph.add(sum, own);
        }
        sum
    }

    fn matrix(&self, graph: &mut Graph, g: &[Id]) -> Matrix {
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
        let sizes: Vec<usize> = self.0.iter().map(|part| Self::size(part.as_ref())).collect();
        let size: usize = sizes.iter().sum();
        let mut start = 0;
        let mut element = Vec::new();
        for (part, rows) in self.0.iter().zip(sizes) {
            let entry = |at: usize| {
                let (row, column) = (start + at / rows, start + at % rows);
                matrix.get(row * size + column).copied().unwrap_or(0.0)
            };
            let block: Vec<f64> = (0..rows * rows).map(entry).collect();
            element.extend(part.element_of(&block));
            start += rows;
        }
        element
    }
}
