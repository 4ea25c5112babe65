//! Vectors and matrices of nodes.

use std::ops::Range;

use crate::graph::{Graph, Id};

/// Σ aᵢ bᵢ
pub(crate) fn dot(graph: &Graph, a: &[Id], b: &[Id]) -> Id {
    let mut sum = graph.zero();
    for (&a, &b) in a.iter().zip(b) {
        sum = graph.times_plus(a, b, sum);
    }
    sum
}

/// A matrix of nodes, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    columns: usize,
    entries: Vec<Id>,
}

impl Matrix {
    /// The matrix whose entry (row, column) is `entry(row, column)`.
    pub(crate) fn new(
        rows: usize,
        columns: usize,
        mut entry: impl FnMut(usize, usize) -> Id,
    ) -> Self {
        let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
        Self { columns, entries: places.map(|(i, j)| entry(i, j)).collect() }
    }

    /// A matrix of zeros.
    pub(crate) fn zeros(graph: &Graph, rows: usize, columns: usize) -> Self {
        let zero = graph.zero();
        Self { columns, entries: vec![zero; rows * columns] }
    }

    /// The identity of this many rows.
    pub(crate) fn identity(graph: &Graph, rows: usize) -> Self {
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        Self::new(rows, rows, |i, j| if i == j { one } else { zero })
    }

    /// The entry (row, column).
    pub(crate) fn at(&self, row: usize, column: usize) -> Id {
        self.entries[row * self.columns + column]
    }

    /// Sets the entry (row, column).
    pub(crate) fn set(&mut self, row: usize, column: usize, value: Id) {
        self.entries[row * self.columns + column] = value;
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.entries.len() / self.columns.max(1)
    }

    /// All entries, row by row.
    pub(crate) fn entries(&self) -> &[Id] {
        &self.entries
    }

    /// The transpose.
    pub(crate) fn transposed(&self) -> Self {
        Self::new(self.columns, self.rows(), |i, j| self.at(j, i))
    }

    /// self · v
    pub(crate) fn apply(&self, graph: &Graph, v: &[Id]) -> Vec<Id> {
        let row = |row: &[Id]| dot(graph, row, v);
        self.entries.chunks(self.columns.max(1)).map(row).collect()
    }

    /// self · other
    pub(crate) fn times(&self, graph: &Graph, other: &Self) -> Self {
        self.times_plus(graph, other, &Self::zeros(graph, self.rows(), other.columns))
    }

    /// self · other + rest
    pub(crate) fn times_plus(&self, graph: &Graph, other: &Self, rest: &Self) -> Self {
        Self::new(self.rows(), other.columns, |i, j| {
            let mut sum = rest.at(i, j);
            for k in 0..self.columns {
                sum = graph.times_plus(self.at(i, k), other.at(k, j), sum);
            }
            sum
        })
    }

    /// The inverse of up to three rows and columns: the adjugate, and the inverse of the determinant.
    fn inverse(&self, graph: &Graph) -> (Self, Id) {
        let (n, one) = (self.rows(), graph.constant(1.0));
        // The cofactor of entry (j, i): of three rows those after j, around the end, so that all signs are plus.
        let adjugate = Self::new(n, n, |i, j| match n {
            1 => one,
            2 if i == j => self.at(1 - i, 1 - i),
            2 => graph.neg(self.at(i, j)),
            _ => {
                let ([a, b], [c, d]) =
                    ([j + 1, j + 2].map(|k| k % 3), [i + 1, i + 2].map(|k| k % 3));
                let product = graph.mul(self.at(a, c), self.at(b, d));
                graph.times_plus(graph.neg(self.at(a, d)), self.at(b, c), product)
            }
        });
        let column: Vec<Id> = (0..n).map(|i| adjugate.at(i, 0)).collect();
        (adjugate, graph.div(one, dot(graph, &self.entries[..n], &column)))
    }

    /// self + s·other
    pub(crate) fn plus(&self, graph: &Graph, s: Id, other: &Self) -> Self {
        let entries = self.entries.iter().zip(&other.entries);
        let entries = entries.map(|(&a, &b)| graph.times_plus(b, s, a)).collect();
        Self { columns: self.columns, entries }
    }

    /// s·self
    pub(crate) fn scaled(&self, graph: &Graph, s: Id) -> Self {
        let entries = self.entries.iter().map(|&a| graph.mul(a, s)).collect();
        Self { columns: self.columns, entries }
    }

    /// True if every entry is the number 0, known without any input.
    pub(crate) fn is_zero(&self, graph: &Graph) -> bool {
        self.entries.iter().all(|&entry| graph.is_zero(entry))
    }
}

/// The most rows and columns of a pivot: a division waits for the one before it, and takes as long as many products.
const BLOCK: usize = 3;

/// A matrix eliminated without exchanges of rows, by pivots of up to [`BLOCK`] rows and columns: for matrices near the
/// identity, which those of a step's equation are where it is accepted.
#[derive(Clone, Debug)]
pub(crate) struct Eliminated {
    /// Above the pivots the rows that are left, below them what multiples of rows were added to others.
    rows: Matrix,
    /// The inverse of each pivot: its adjugate, and the inverse of its determinant.
    inverses: Vec<(Matrix, Id)>,
}

impl Eliminated {
    /// Eliminates a square matrix.
    pub(crate) fn new(graph: &Graph, matrix: &Matrix) -> Self {
        let n = matrix.rows();
        let mut a = matrix.clone();
        let mut inverses = Vec::new();
        for pivot in blocks(n) {
            let (first, size) = (pivot.start, pivot.len());
            let block = Matrix::new(size, size, |i, j| a.at(first + i, first + j));
            let (adjugate, scale) = block.inverse(graph);
            for row in pivot.end..n {
                let entries: Vec<Id> = pivot.clone().map(|column| a.at(row, column)).collect();
                for (j, column) in pivot.clone().enumerate() {
                    let by: Vec<Id> = (0..size).map(|i| adjugate.at(i, j)).collect();
                    a.set(row, column, graph.neg(graph.mul(dot(graph, &entries, &by), scale)));
                }
                for column in pivot.end..n {
                    let mut value = a.at(row, column);
                    for k in pivot.clone() {
                        value = graph.times_plus(a.at(row, k), a.at(k, column), value);
                    }
                    a.set(row, column, value);
                }
            }
            inverses.push((adjugate, scale));
        }
        Self { rows: a, inverses }
    }

    /// The solution y of `matrix` · y = b.
    pub(crate) fn solve(&self, graph: &Graph, b: &[Id]) -> Vec<Id> {
        let n = b.len();
        let mut y = b.to_vec();
        for pivot in blocks(n) {
            for row in pivot.end..n {
                for k in pivot.clone() {
                    y[row] = graph.times_plus(self.rows.at(row, k), y[k], y[row]);
                }
            }
        }
        for (pivot, (adjugate, scale)) in blocks(n).zip(&self.inverses).rev() {
            let mut rest = |row: usize| {
                (pivot.end..n).fold(y[row], |rest, column| {
                    graph.times_plus(graph.neg(self.rows.at(row, column)), y[column], rest)
                })
            };
            let rest: Vec<Id> = pivot.clone().map(&mut rest).collect();
            let solved = adjugate.apply(graph, &rest);
            for (row, entry) in pivot.zip(solved) {
                y[row] = graph.mul(entry, *scale);
            }
        }
        y
    }

    /// Renames the numbers it is made of.
    pub(crate) fn map(&self, mut rename: impl FnMut(Id) -> Id) -> Self {
        let n = self.rows.rows();
        // The pivots are not used.
        let entry = |i: usize, j: usize| {
            let entry = self.rows.at(i, j);
            if i / BLOCK == j / BLOCK { entry } else { rename(entry) }
        };
        let rows = Matrix::new(n, n, entry);
        let mut inverse = |(adjugate, scale): &(Matrix, Id)| {
            let size = adjugate.rows();
            (Matrix::new(size, size, |i, j| rename(adjugate.at(i, j))), rename(*scale))
        };
        let inverses = self.inverses.iter().map(&mut inverse).collect();
        Self { rows, inverses }
    }
}

/// The rows of the pivots of an elimination.
fn blocks(n: usize) -> impl DoubleEndedIterator<Item = Range<usize>> + ExactSizeIterator {
    (0..n.div_ceil(BLOCK)).map(move |block| block * BLOCK..n.min((block + 1) * BLOCK))
}

/// The solution of `matrix` · y = b by [elimination](Eliminated).
pub(crate) fn solve(graph: &Graph, matrix: &Matrix, b: &[Id]) -> Vec<Id> {
    Eliminated::new(graph, matrix).solve(graph, b)
}

/// The largest |entry|.
pub(crate) fn largest(graph: &Graph, list: &[Id]) -> Id {
    let mut largest = graph.zero();
    for &entry in list {
        let size = graph.abs(entry);
        largest = if graph.is_zero(largest) { size } else { graph.max(largest, size) };
    }
    largest
}

/// Zero where all entries are finite, else not a number.
pub(crate) fn finite(graph: &Graph, list: &[Id]) -> Id {
    let mut sum = graph.zero();
    for &entry in list {
        sum = graph.add(sum, graph.sub(entry, entry));
    }
    sum
}

/// The smaller of 1 and 0: 1 where every pair (a, b) has a ≤ b.
pub(crate) fn all_at_most(graph: &Graph, pairs: &[(Id, Id)]) -> Id {
    let (zero, one) = (graph.zero(), graph.constant(1.0));
    let mut verdict = one;
    for &(a, b) in pairs.iter().rev() {
        verdict = graph.select(a, b, verdict, zero);
    }
    verdict
}
