//! Vectors and matrices of nodes.

use crate::graph::{Graph, Id};

/// A vector of three nodes.
pub(crate) type V3 = [Id; 3];

/// The three entries from `at` on.
pub(crate) fn three(list: &[Id], at: usize) -> V3 {
    [list[at], list[at + 1], list[at + 2]]
}

/// a × b
pub(crate) fn cross(graph: &mut Graph, a: &V3, b: &V3) -> V3 {
    let mut entry = |i: usize, j: usize| {
        let product = graph.mul(a[i], b[j]);
        let minus = graph.neg(a[j]);
        graph.times_plus(minus, b[i], product)
    };
    [entry(1, 2), entry(2, 0), entry(0, 1)]
}

/// Σ aᵢ bᵢ
pub(crate) fn dot(graph: &mut Graph, a: &[Id], b: &[Id]) -> Id {
    let mut sum = graph.zero();
    for (&a, &b) in a.iter().zip(b) {
        sum = graph.times_plus(a, b, sum);
    }
    sum
}

/// a + s·b
pub(crate) fn plus(graph: &mut Graph, a: &V3, s: Id, b: &V3) -> V3 {
    [0, 1, 2].map(|i| graph.times_plus(b[i], s, a[i]))
}

/// a + b
pub(crate) fn sum(graph: &mut Graph, a: &V3, b: &V3) -> V3 {
    [0, 1, 2].map(|i| graph.add(a[i], b[i]))
}

/// a − b
pub(crate) fn difference(graph: &mut Graph, a: &V3, b: &V3) -> V3 {
    [0, 1, 2].map(|i| graph.sub(a[i], b[i]))
}

/// s·a
pub(crate) fn scaled(graph: &mut Graph, s: Id, a: &V3) -> V3 {
    [0, 1, 2].map(|i| graph.mul(a[i], s))
}

/// −a
pub(crate) fn minus(graph: &mut Graph, a: &V3) -> V3 {
    a.map(|entry| graph.neg(entry))
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
    pub(crate) fn zeros(graph: &mut Graph, rows: usize, columns: usize) -> Self {
        let zero = graph.zero();
        Self { columns, entries: vec![zero; rows * columns] }
    }

    /// The entry (row, column).
    pub(crate) fn at(&self, row: usize, column: usize) -> Id {
        self.entries[row * self.columns + column]
    }

    /// Sets the entry (row, column).
    pub(crate) fn set(&mut self, row: usize, column: usize, value: Id) {
        self.entries[row * self.columns + column] = value;
    }

    /// How many rows.
    pub(crate) fn rows(&self) -> usize {
        self.entries.len() / self.columns.max(1)
    }

    /// All entries, row by row.
    pub(crate) fn entries(&self) -> &[Id] {
        &self.entries
    }

    /// self · v
    pub(crate) fn apply(&self, graph: &mut Graph, v: &[Id]) -> Vec<Id> {
        let row = |row: &[Id]| dot(graph, row, v);
        self.entries.chunks(self.columns.max(1)).map(row).collect()
    }

    /// self · other
    pub(crate) fn times(&self, graph: &mut Graph, other: &Self) -> Self {
        Self::new(self.rows(), other.columns, |i, j| {
            let mut sum = graph.zero();
            for k in 0..self.columns {
                sum = graph.times_plus(self.at(i, k), other.at(k, j), sum);
            }
            sum
        })
    }

    /// self + s·other
    pub(crate) fn plus(&self, graph: &mut Graph, s: Id, other: &Self) -> Self {
        let entries = self.entries.iter().zip(&other.entries);
        let entries = entries.map(|(&a, &b)| graph.times_plus(b, s, a)).collect();
        Self { columns: self.columns, entries }
    }

    /// Whether every entry is the number 0, known without any input.
    pub(crate) fn is_zero(&self, graph: &Graph) -> bool {
        self.entries.iter().all(|&entry| graph.is_zero(entry))
    }
}

/// A matrix eliminated without exchanges of rows: for matrices near the identity, which those of a step's equation are
/// where it is accepted.
#[derive(Clone, Debug)]
pub(crate) struct Eliminated {
    /// Above the diagonal the rows that are left, below it what multiples of rows were added to others.
    rows: Matrix,
    /// The inverses of the pivots.
    inverses: Vec<Id>,
}

impl Eliminated {
    /// Eliminates a square matrix.
    pub(crate) fn new(graph: &mut Graph, matrix: &Matrix) -> Self {
        let n = matrix.rows();
        let mut a = matrix.clone();
        let one = graph.constant(1.0);
        let mut inverses = Vec::with_capacity(n);
        for pivot in 0..n {
            let inverse = graph.div(one, a.at(pivot, pivot));
            inverses.push(inverse);
            for row in pivot + 1..n {
                if graph.is_zero(a.at(row, pivot)) {
                    continue;
                }
                let factor = graph.mul(a.at(row, pivot), inverse);
                let factor = graph.neg(factor);
                a.set(row, pivot, factor);
                for column in pivot + 1..n {
                    let value = graph.times_plus(factor, a.at(pivot, column), a.at(row, column));
                    a.set(row, column, value);
                }
            }
        }
        Self { rows: a, inverses }
    }

    /// The solution y of `matrix` · y = b.
    pub(crate) fn solve(&self, graph: &mut Graph, b: &[Id]) -> Vec<Id> {
        let n = b.len();
        let mut y = b.to_vec();
        for pivot in 0..n {
            for row in pivot + 1..n {
                y[row] = graph.times_plus(self.rows.at(row, pivot), y[pivot], y[row]);
            }
        }
        for row in (0..n).rev() {
            let mut rest = y[row];
            for column in row + 1..n {
                let minus = graph.neg(self.rows.at(row, column));
                rest = graph.times_plus(minus, y[column], rest);
            }
            y[row] = graph.mul(rest, self.inverses[row]);
        }
        y
    }

    /// The same with other names for the numbers it is made of.
    pub(crate) fn map(&self, mut rename: impl FnMut(Id) -> Id) -> Self {
        let n = self.inverses.len();
        // The diagonal is not used.
        let entry = |i: usize, j: usize| {
            let entry = self.rows.at(i, j);
            if i == j { entry } else { rename(entry) }
        };
        let rows = Matrix::new(n, n, entry);
        let inverses = self.inverses.iter().map(|&inverse| rename(inverse)).collect();
        Self { rows, inverses }
    }
}

/// The solution of `matrix` · y = b by [elimination](Eliminated).
pub(crate) fn solve(graph: &mut Graph, matrix: &Matrix, b: &[Id]) -> Vec<Id> {
    Eliminated::new(graph, matrix).solve(graph, b)
}

/// The largest |entry|.
pub(crate) fn largest(graph: &mut Graph, list: &[Id]) -> Id {
    let mut largest = graph.zero();
    for &entry in list {
        let size = graph.abs(entry);
        largest = if graph.is_zero(largest) { size } else { graph.max(largest, size) };
    }
    largest
}

/// Zero where all entries are finite, else not a number.
pub(crate) fn finite(graph: &mut Graph, list: &[Id]) -> Id {
    let mut sum = graph.zero();
    for &entry in list {
        let nothing = graph.sub(entry, entry);
        sum = graph.add(sum, nothing);
    }
    sum
}

/// The smaller of 1 and 0: 1 where every pair (a, b) has a ≤ b.
pub(crate) fn all_at_most(graph: &mut Graph, pairs: &[(Id, Id)]) -> Id {
    let (zero, one) = (graph.zero(), graph.constant(1.0));
    let mut verdict = one;
    for &(a, b) in pairs.iter().rev() {
        verdict = graph.select(a, b, verdict, zero);
    }
    verdict
}
