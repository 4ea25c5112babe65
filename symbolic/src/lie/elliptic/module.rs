//! Representations of a Lie algebra, their submodules and quotients.

use super::form::QuadraticForm;
use super::subspace::{Subspace, Vector};
use crate::lie::{LieAlgebra, RationalMatrix};
use crate::number::{Rational, integer, ratio};
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;

/// Vectors that may be looked at in search of a submodule; beyond, a module counts as irreducible.
const LOOK: usize = 20_000;
/// The largest module whose commuting maps are looked for.
const COMMUTING: usize = 8;

/// A representation: a square matrix for each generator.
pub(super) struct Module {
    dim: usize,
    matrices: Vec<RationalMatrix>,
}

impl Module {
    pub(super) fn adjoint(algebra: &LieAlgebra) -> Self {
        let dim = algebra.dim();
        let mut entries = vec![Vec::new(); dim];
        for c in algebra.structure() {
            entries[c.i].push((c.k, c.j, c.value.clone()));
        }
        let matrices = entries
            .into_iter()
            .map(|entries| RationalMatrix::from_entries(dim, dim, entries))
            .collect();
        Self { dim, matrices }
    }

    pub(super) fn new(matrices: &[RationalMatrix]) -> Self {
        let dim = matrices.first().map_or(0, RationalMatrix::rows);
        Self { dim, matrices: matrices.to_vec() }
    }

    pub(super) fn dim(&self) -> usize {
        self.dim
    }

    pub(super) fn matrices(&self) -> &[RationalMatrix] {
        &self.matrices
    }

    pub(super) fn is_trivial(&self) -> bool {
        self.matrices.iter().all(RationalMatrix::is_zero)
    }

    /// Every matrix less its trace over the dimension: the imaginary parts of eigenvalues stay.
    pub(super) fn traceless(&self) -> Self {
        let identity = |value: &Rational| {
            RationalMatrix::from_entries(
                self.dim,
                self.dim,
                (0..self.dim).map(|i| (i, i, value.clone())),
            )
        };
        let size = integer(self.dim.max(1) as i64);
        let matrices = self.matrices.iter().map(|matrix| {
            let mean = trace(matrix) / &size;
            if mean.is_zero() {
                matrix.clone()
            } else {
                matrix.plus(&identity(&-mean), &integer(1))
            }
        });
        Self { dim: self.dim, matrices: matrices.collect() }
    }

    /// The factors of a chain of submodules, as fine as it was found. A matrix of the module has
    /// the eigenvalues of its factors' together.
    pub(super) fn factors(self) -> Vec<Self> {
        let (mut open, mut done) = (vec![self], Vec::new());
        while let Some(module) = open.pop() {
            match module.submodule() {
                Some(sub) => open.extend(module.split(&sub)),
                None => done.push(module),
            }
        }
        done
    }

    /// The quotient by a submodule, and the submodule.
    fn split(&self, sub: &Subspace) -> [Self; 2] {
        let pivots = sub.pivots();
        let rest: Vec<usize> = (0..self.dim).filter(|i| pivots.binary_search(i).is_err()).collect();
        let place = |list: &[usize]| -> BTreeMap<usize, usize> {
            list.iter().enumerate().map(|(new, old)| (*old, new)).collect()
        };
        let (inner, outer) = (place(&pivots), place(&rest));
        let quotient = self.matrices.iter().map(|matrix| {
            let columns = columns(matrix);
            let images = rest
                .iter()
                .enumerate()
                .filter_map(|(new, old)| Some((new, sub.reduced(columns.get(old)?))));
            from_columns(rest.len(), images, &outer)
        });
        let restricted = self.matrices.iter().map(|matrix| {
            let columns = columns(matrix);
            let images = sub.rows().map(|row| apply(&columns, row)).enumerate();
            from_columns(pivots.len(), images, &inner)
        });
        [
            Self { dim: rest.len(), matrices: quotient.collect() },
            Self { dim: pivots.len(), matrices: restricted.collect() },
        ]
    }

    /// A submodule other than nothing and everything, if one is found.
    fn submodule(&self) -> Option<Subspace> {
        if self.dim < 2 || self.is_trivial() {
            return None;
        }
        let proper = |space: &Subspace| (1..self.dim).contains(&space.dim());
        let active: Vec<BTreeMap<usize, Vector>> =
            self.matrices.iter().filter(|m| !m.is_zero()).map(columns).collect();
        // 𝔤V, and what 𝔤 annihilates.
        let mut image = Subspace::default();
        let mut conditions = Subspace::default();
        for matrix in &active {
            matrix.values().for_each(|column| {
                image.insert(column);
            });
        }
        if proper(&image) {
            return Some(image);
        }
        for matrix in &self.matrices {
            rows(matrix).values().for_each(|row| {
                conditions.insert(row);
            });
        }
        let fixed = conditions.annihilator(self.dim);
        if proper(&fixed) {
            return Some(fixed);
        }
        // The ideal that one vector generates.
        let mut looked = 0;
        for start in 0..self.dim {
            let mut space = Subspace::default();
            let mut queue = vec![Vector::from([(start, integer(1))])];
            space.insert(&queue[0]);
            while let Some(vector) = queue.pop() {
                for columns in &active {
                    looked += 1;
                    let next = apply(columns, &vector);
                    if space.insert(&next) {
                        queue.push(next);
                    }
                }
                if space.dim() == self.dim || looked > LOOK {
                    break;
                }
            }
            if looked > LOOK {
                return None;
            }
            if proper(&space) {
                return Some(space);
            }
        }
        self.eigenspace().filter(proper)
    }

    /// The eigenspace of a rational eigenvalue of a map that commutes with every matrix. The
    /// rotations of four-space split in two by it: the dual of a plane is that map.
    fn eigenspace(&self) -> Option<Subspace> {
        let n = self.dim;
        if n > COMMUTING {
            return None;
        }
        // T A = A T, an equation for each entry of each matrix, in the n² entries of T.
        let mut conditions = Subspace::default();
        for matrix in self.matrices.iter().filter(|m| !m.is_zero()) {
            for i in 0..n {
                for j in 0..n {
                    let mut row = Vector::new();
                    for l in 0..n {
                        for (at, value) in
                            [(i * n + l, matrix.get(l, j)), (l * n + j, -matrix.get(i, l))]
                        {
                            *row.entry(at).or_insert_with(Rational::zero) += value;
                        }
                    }
                    row.retain(|_, value| !value.is_zero());
                    conditions.insert(&row);
                }
            }
        }
        let commuting = conditions.annihilator(n * n);
        for row in commuting.rows() {
            let entries = row.iter().map(|(at, value)| (at / n, at % n, value.clone()));
            let map = RationalMatrix::from_entries(n, n, entries);
            for value in quadratic_roots(&map).into_iter().flatten() {
                let shifted = (0..n).map(|i| (i, i, -value.clone()));
                let shifted = map.plus(&RationalMatrix::from_entries(n, n, shifted), &integer(1));
                let mut conditions = Subspace::default();
                rows(&shifted).values().for_each(|row| {
                    conditions.insert(row);
                });
                let space = conditions.annihilator(n);
                if (1..n).contains(&space.dim()) {
                    return Some(space);
                }
            }
        }
        None
    }

    /// The form Σ x_i x_j tr(A_i A_j), which is tr A(x)².
    pub(super) fn trace_form(&self) -> QuadraticForm {
        self.gram(|row, column| (column, row))
    }

    /// The form Σ x_i x_j ⟨A_i, A_j⟩, which is the square of A(x) in Frobenius' norm.
    pub(super) fn frobenius_form(&self) -> QuadraticForm {
        self.gram(|row, column| (row, column))
    }

    fn gram(&self, partner: impl Fn(usize, usize) -> (usize, usize)) -> QuadraticForm {
        let mut at: BTreeMap<(usize, usize), Vec<(usize, &Rational)>> = BTreeMap::new();
        for (index, matrix) in self.matrices.iter().enumerate() {
            for (i, j, value) in matrix.entries() {
                at.entry((i, j)).or_default().push((index, value));
            }
        }
        let mut sums: BTreeMap<(usize, usize), Rational> = BTreeMap::new();
        for (&(i, j), here) in &at {
            for (a, left) in here {
                for (b, right) in at.get(&partner(i, j)).into_iter().flatten() {
                    *sums.entry((*a, *b)).or_insert_with(Rational::zero) += *left * *right;
                }
            }
        }
        QuadraticForm::from_entries(sums.into_iter().map(|((i, j), value)| (i, j, value)))
    }

    /// The form q with A(x)² = −q(x)·1, if there is one.
    pub(super) fn square(&self) -> Option<QuadraticForm> {
        if self.dim == 0 || self.dim % 2 == 1 {
            return None;
        }
        let active: Vec<(usize, &RationalMatrix)> =
            self.matrices.iter().enumerate().filter(|(_, m)| !m.is_zero()).collect();
        let mut entries = Vec::new();
        for (position, (i, left)) in active.iter().enumerate() {
            for (j, right) in &active[position..] {
                let sum = left.times(right).plus(&right.times(left), &integer(1));
                let value = sum.get(0, 0);
                let scalar = (0..self.dim).map(|k| (k, k, value.clone()));
                if sum != RationalMatrix::from_entries(self.dim, self.dim, scalar) {
                    return None;
                }
                let half = if i == j { ratio(-1, 2) } else { integer(-1) };
                entries.push((*i, *j, value * half));
            }
        }
        Some(QuadraticForm::from_entries(entries))
    }

    /// Whether tr A(x)³ vanishes for every x.
    pub(super) fn cubes_are_traceless(&self) -> bool {
        let active: Vec<&RationalMatrix> = self.matrices.iter().filter(|m| !m.is_zero()).collect();
        let cube = |a: &RationalMatrix, b: &RationalMatrix, c| trace(&a.times(b).times(c));
        (0..active.len()).all(|i| {
            (i..active.len()).all(|j| {
                (j..active.len()).all(|k| {
                    let [a, b, c] = [active[i], active[j], active[k]];
                    (cube(a, b, c) + cube(a, c, b)).is_zero()
                })
            })
        })
    }

    /// Whether every matrix is skew.
    pub(super) fn is_skew(&self) -> bool {
        self.matrices
            .iter()
            .all(|matrix| matrix.entries().all(|(i, j, value)| matrix.get(j, i) == -value))
    }

    /// The vectors that act as zero.
    pub(super) fn kernel(&self) -> Subspace {
        let mut conditions: BTreeMap<(usize, usize), Vector> = BTreeMap::new();
        for (index, matrix) in self.matrices.iter().enumerate() {
            for (i, j, value) in matrix.entries() {
                conditions.entry((i, j)).or_default().insert(index, value.clone());
            }
        }
        let mut space = Subspace::default();
        for row in conditions.values() {
            space.insert(row);
        }
        space.annihilator(self.matrices.len())
    }

    /// The adjoint representation of 𝔤 modulo an ideal: the quotient of the adjoint representation
    /// by it, for the generators that are left.
    pub(super) fn modulo(&self, ideal: &Subspace) -> Self {
        let pivots = ideal.pivots();
        let [quotient, _] = self.split(ideal);
        let left = quotient.matrices.into_iter().enumerate();
        let left = left.filter(|(i, _)| pivots.binary_search(i).is_err());
        Self { dim: quotient.dim, matrices: left.map(|(_, matrix)| matrix).collect() }
    }
}

fn trace(matrix: &RationalMatrix) -> Rational {
    (0..matrix.rows()).map(|i| matrix.get(i, i)).fold(Rational::zero(), |sum, v| sum + v)
}

/// λ for a map with T² = aT + b that is no multiple of the identity, if they are rational.
fn quadratic_roots(map: &RationalMatrix) -> Option<[Rational; 2]> {
    let n = map.rows();
    let square = map.times(map);
    let place = (0..n)
        .flat_map(|i| (0..n).map(move |j| (i, j)))
        .find(|&(i, j)| i != j && !map.get(i, j).is_zero())?;
    let a = square.get(place.0, place.1) / map.get(place.0, place.1);
    let rest = square.plus(map, &-a.clone());
    let b = rest.get(0, 0);
    let scalar = RationalMatrix::from_entries(n, n, (0..n).map(|i| (i, i, b.clone())));
    if rest != scalar {
        return None;
    }
    let discriminant = &a * &a + integer(4) * b;
    if discriminant.is_negative() {
        return None;
    }
    let root = Rational::new(discriminant.numer().sqrt(), discriminant.denom().sqrt());
    (&root * &root == discriminant).then(|| [(&a + &root) / integer(2), (&a - &root) / integer(2)])
}

fn columns(matrix: &RationalMatrix) -> BTreeMap<usize, Vector> {
    let mut result: BTreeMap<usize, Vector> = BTreeMap::new();
    for (i, j, value) in matrix.entries() {
        result.entry(j).or_default().insert(i, value.clone());
    }
    result
}

fn rows(matrix: &RationalMatrix) -> BTreeMap<usize, Vector> {
    let mut result: BTreeMap<usize, Vector> = BTreeMap::new();
    for (i, j, value) in matrix.entries() {
        result.entry(i).or_default().insert(j, value.clone());
    }
    result
}

fn apply(columns: &BTreeMap<usize, Vector>, vector: &Vector) -> Vector {
    let mut result = Vector::new();
    for (at, factor) in vector {
        for (i, value) in columns.get(at).into_iter().flatten() {
            *result.entry(*i).or_insert_with(Rational::zero) += value * factor;
        }
    }
    result.retain(|_, value| !value.is_zero());
    result
}

/// A matrix from its columns, rows being those of `place`.
fn from_columns(
    size: usize,
    columns: impl Iterator<Item = (usize, Vector)>,
    place: &BTreeMap<usize, usize>,
) -> RationalMatrix {
    let entries = columns.flat_map(|(j, column)| {
        let own = column.into_iter();
        own.filter_map(move |(i, value)| Some((*place.get(&i)?, j, value))).collect::<Vec<_>>()
    });
    RationalMatrix::from_entries(size, size, entries)
}
