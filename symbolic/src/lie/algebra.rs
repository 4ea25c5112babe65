//! Lie algebras by basis, structure constants or brackets.

use std::collections::BTreeMap;

use num_traits::Zero;

use crate::lie::{RationalMatrix, Span};
use crate::number::{Rational, nearest_float};
use crate::poly::Polynomial;

/// One nonzero structure constant: the component of \[e_i, e_j\] along e_k.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructureConstant {
    /// The first generator of the bracket, from zero.
    pub i: usize,
    /// The second generator of the bracket, from zero.
    pub j: usize,
    /// The generator along which the component is taken, from zero.
    pub k: usize,
    /// c_ij^k.
    pub value: Rational,
}

/// A finite-dimensional Lie algebra over ℚ with a chosen basis.
///
/// Antisymmetry and the Jacobi identity hold: they are checked at construction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LieAlgebra {
    name: String,
    generators: Vec<String>,
    structure: Vec<StructureConstant>,
    basis: Option<Vec<RationalMatrix>>,
}

type Table = BTreeMap<(usize, usize, usize), Rational>;

impl LieAlgebra {
    /// The most generators of an algebra by brackets alone: its group is the matrices of the
    /// adjoint representation, n² numbers whose product takes n³ operations, a tenth of a second for 512 generators.
    pub const MOST_BY_BRACKETS: usize = 512;

    /// Builds an algebra from all nonzero structure constants (i, j, k, c_ij^k), \[e_i, e_j\] = Σ_k c_ij^k e_k.
    ///
    /// Both c_ij^k and c_ji^k are to be given. Generators are called e1, e2, ….
    ///
    /// # Errors
    /// If an index is out of range, a constant is given twice with different values, or
    /// antisymmetry or the Jacobi identity fails.
    pub fn from_structure_constants(
        name: impl Into<String>,
        dimension: usize,
        entries: impl IntoIterator<Item = (usize, usize, usize, Rational)>,
    ) -> Result<Self, LieAlgebraError> {
        let generators = default_names(dimension);
        let mut table = Table::new();
        for (i, j, k, value) in entries {
            check_range(dimension, &[i, j, k])?;
            if let Some(old) = table.insert((i, j, k), value.clone())
                && old != value
            {
                return Err(inconsistent(&generators, i, j));
            }
        }
        table.retain(|_, value| !value.is_zero());
        Self::checked(name.into(), generators, table, None)
    }

    /// Builds an algebra from square rational matrices of one size; the bracket is their commutator.
    ///
    /// # Errors
    /// If a matrix is not square, sizes differ, a matrix depends on those before it, or a bracket
    /// leaves the span.
    pub fn from_basis(
        name: impl Into<String>,
        basis: Vec<RationalMatrix>,
    ) -> Result<Self, LieAlgebraError> {
        let generators = default_names(basis.len());
        Self::from_named_basis(name, generators, basis)
    }

    /// As [`from_basis`](Self::from_basis), with names for the generators (used in messages).
    ///
    /// # Errors
    /// As [`from_basis`](Self::from_basis).
    pub fn from_named_basis(
        name: impl Into<String>,
        mut generators: Vec<String>,
        basis: Vec<RationalMatrix>,
    ) -> Result<Self, LieAlgebraError> {
        fit_names(&mut generators, basis.len());
        let Some(first) = basis.first() else {
            return Err(LieAlgebraError::Empty);
        };
        for (matrix, generator) in basis.iter().zip(&generators) {
            if matrix.rows() != matrix.columns() {
                return Err(LieAlgebraError::NotSquare {
                    generator: generator.clone(),
                    rows: matrix.rows(),
                    columns: matrix.columns(),
                });
            }
            if matrix.rows() != first.rows() {
                return Err(LieAlgebraError::DifferentSizes {
                    generator: generator.clone(),
                    size: matrix.rows(),
                    expected: first.rows(),
                });
            }
        }
        let span = Span::new(&basis).map_err(|index| LieAlgebraError::Dependent {
            generator: generators[index].clone(),
            index,
        })?;
        let mut table = Table::new();
        for i in 0..basis.len() {
            for j in i + 1..basis.len() {
                let bracket = basis[i].commutator(&basis[j]);
                let Some(coordinates) = span.coordinates(&bracket) else {
                    return Err(LieAlgebraError::NotClosed {
                        first: generators[i].clone(),
                        second: generators[j].clone(),
                        indices: (i, j),
                    });
                };
                for (k, value) in coordinates {
                    table.insert((j, i, k), -value.clone());
                    table.insert((i, j, k), value);
                }
            }
        }
        Self::checked(name.into(), generators, table, Some(basis))
    }

    /// Builds an algebra from brackets (i, j, \[e_i, e_j\] as components (k, c_ij^k)).
    ///
    /// A bracket not given is zero, or the opposite of the one given in the other order.
    ///
    /// # Errors
    /// If there are more than [`MOST_BY_BRACKETS`](Self::MOST_BY_BRACKETS) generators, an index is out of range, a
    /// bracket is given twice with different values (also in the other order), \[e_i, e_i\] is not
    /// zero, or the Jacobi identity fails.
    pub fn from_brackets(
        name: impl Into<String>,
        generators: Vec<String>,
        brackets: impl IntoIterator<Item = (usize, usize, Vec<(usize, Rational)>)>,
    ) -> Result<Self, LieAlgebraError> {
        let dimension = generators.len();
        if dimension > Self::MOST_BY_BRACKETS {
            let limit = Self::MOST_BY_BRACKETS;
            return Err(LieAlgebraError::TooLarge { generators: dimension, limit });
        }
        let mut given: BTreeMap<(usize, usize), BTreeMap<usize, Rational>> = BTreeMap::new();
        for (i, j, components) in brackets {
            check_range(dimension, &[i, j])?;
            let mut value: BTreeMap<usize, Rational> = BTreeMap::new();
            for (k, c) in components {
                check_range(dimension, &[k])?;
                let c = if i <= j { c } else { -c };
                *value.entry(k).or_insert_with(Rational::zero) += c;
            }
            value.retain(|_, c| !c.is_zero());
            if i == j && !value.is_empty() {
                return Err(LieAlgebraError::SelfBracket {
                    generator: generators[i].clone(),
                    index: i,
                });
            }
            if let Some(old) = given.insert((i.min(j), i.max(j)), value.clone())
                && old != value
            {
                return Err(inconsistent(&generators, i, j));
            }
        }
        let mut table = Table::new();
        for ((i, j), value) in given {
            for (k, c) in value {
                table.insert((j, i, k), -c.clone());
                table.insert((i, j, k), c);
            }
        }
        Self::checked(name.into(), generators, table, None)
    }

    /// Builds an algebra from data known to define one.
    pub(super) fn from_parts(
        name: String,
        generators: Vec<String>,
        structure: Vec<StructureConstant>,
        basis: Option<Vec<RationalMatrix>>,
    ) -> Self {
        Self { name, generators, structure, basis }
    }

    /// Changes the name.
    #[must_use]
    pub fn renamed(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    pub(super) fn checked(
        name: String,
        generators: Vec<String>,
        table: Table,
        basis: Option<Vec<RationalMatrix>>,
    ) -> Result<Self, LieAlgebraError> {
        if generators.is_empty() {
            return Err(LieAlgebraError::Empty);
        }
        check_antisymmetry(&generators, &table)?;
        check_jacobi(&generators, &table)?;
        let structure = table
            .into_iter()
            .map(|((i, j, k), value)| StructureConstant { i, j, k, value })
            .collect();
        Ok(Self { name, generators, structure, basis })
    }

    /// The dimension.
    pub fn dim(&self) -> usize {
        self.generators.len()
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The names of the basis elements, used in messages.
    pub fn generators(&self) -> &[String] {
        &self.generators
    }

    /// The nonzero structure constants, ascending by (i, j, k); both orders of i and j occur.
    pub fn structure(&self) -> &[StructureConstant] {
        &self.structure
    }

    /// The structure constants (i, j, k, c_ij^k) as floating-point numbers.
    pub fn constants(&self) -> Vec<(usize, usize, usize, f64)> {
        self.structure.iter().map(|c| (c.i, c.j, c.k, nearest_float(&c.value))).collect()
    }

    /// The matrices of the basis; none if the algebra is known by its brackets alone.
    pub fn basis(&self) -> Option<&[RationalMatrix]> {
        self.basis.as_deref()
    }

    /// The rows of [`Self::matrices`].
    pub fn matrix_size(&self) -> usize {
        self.basis().and_then(<[_]>::first).map_or(self.dim(), RationalMatrix::rows)
    }

    /// The matrices of the basis, or those of ad where only the brackets are known: entry (k, j) of that of e_i is c_ij^k.
    pub fn matrices(&self) -> Vec<RationalMatrix> {
        let n = self.dim();
        let adjoint = |i: usize| {
            let own = self.structure.iter().filter(|c| c.i == i);
            RationalMatrix::from_entries(n, n, own.map(|c| (c.k, c.j, c.value.clone())))
        };
        self.basis.clone().unwrap_or_else(|| (0..n).map(adjoint).collect())
    }

    /// Matrices Dₖ in the span of the [matrices](Self::matrices) Eₗ with ⟨Dₖ, Eₗ⟩ = δₖₗ; `None` where these are linearly dependent.
    pub(crate) fn dual_matrices(&self) -> Option<Vec<RationalMatrix>> {
        let (basis, n, size) = (self.matrices(), self.dim(), self.matrix_size());
        let mut gram = Vec::new();
        for (k, a) in basis.iter().enumerate() {
            for (l, b) in basis.iter().enumerate() {
                gram.extend(a.entries().map(|(i, j, value)| (k, l, value * b.get(i, j))));
            }
        }
        let mut dual = vec![RationalMatrix::zero(size, size); n];
        for (k, l, weight) in RationalMatrix::from_entries(n, n, gram).inverse()?.entries() {
            dual[k] = dual[k].plus(&basis[l], weight);
        }
        Some(dual)
    }
}

fn default_names(dimension: usize) -> Vec<String> {
    (1..=dimension).map(|i| format!("e{i}")).collect()
}

fn fit_names(names: &mut Vec<String>, dimension: usize) {
    names.truncate(dimension);
    for i in names.len()..dimension {
        names.push(format!("e{}", i + 1));
    }
}

fn check_range(dimension: usize, indices: &[usize]) -> Result<(), LieAlgebraError> {
    match indices.iter().find(|&&index| index >= dimension) {
        Some(&index) => Err(LieAlgebraError::OutOfRange { index, dimension }),
        None => Ok(()),
    }
}

fn inconsistent(generators: &[String], i: usize, j: usize) -> LieAlgebraError {
    LieAlgebraError::Inconsistent {
        first: generators[i].clone(),
        second: generators[j].clone(),
        indices: (i, j),
    }
}

fn names(generators: &[String], i: usize, j: usize, k: usize) -> Box<[String; 3]> {
    Box::new([generators[i].clone(), generators[j].clone(), generators[k].clone()])
}

fn check_antisymmetry(generators: &[String], table: &Table) -> Result<(), LieAlgebraError> {
    for (&(i, j, k), forward) in table {
        if i == j {
            let generator = generators[i].clone();
            return Err(LieAlgebraError::SelfBracket { generator, index: i });
        }
        let backward = table.get(&(j, i, k)).cloned().unwrap_or_else(Rational::zero);
        if *forward != -&backward {
            return Err(LieAlgebraError::NotAntisymmetric {
                generators: names(generators, i, j, k),
                forward: Box::new(forward.clone()),
                backward: Box::new(backward),
                indices: (i, j, k),
            });
        }
    }
    Ok(())
}

/// The Jacobiator is totally antisymmetric once the bracket is, so triples i < j < k suffice:
/// \[\[i,j\],k\] + \[\[j,k\],i\] − \[\[i,k\],j\] = 0. Only nonzero brackets are visited.
fn check_jacobi(generators: &[String], table: &Table) -> Result<(), LieAlgebraError> {
    let mut sums: BTreeMap<(usize, usize, usize, usize), Rational> = BTreeMap::new();
    for (&(i, j, l), c) in table.iter().filter(|((i, j, _), _)| i < j) {
        for (&(_, k, m), d) in table.range((l, 0, 0)..(l + 1, 0, 0)) {
            let (triple, positive) = if k > j {
                ((i, j, k), true)
            } else if k < i {
                ((k, i, j), true)
            } else if k > i && k < j {
                ((i, k, j), false)
            } else {
                continue;
            };
            let value = if positive { c * d } else { -(c * d) };
            *sums.entry((triple.0, triple.1, triple.2, m)).or_insert_with(Rational::zero) += value;
        }
    }
    match sums.into_iter().find(|(_, value)| !value.is_zero()) {
        None => Ok(()),
        Some(((i, j, k, m), value)) => Err(LieAlgebraError::Jacobi {
            generators: names(generators, i, j, k),
            indices: (i, j, k),
            along: generators[m].clone(),
            value: Box::new(value),
        }),
    }
}

/// Reasons for which data do not define a Lie algebra. Every message is one line and names generators.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LieAlgebraError {
    /// There are no generators.
    #[error("a Lie algebra needs at least one generator; give its basis or its brackets")]
    Empty,
    /// More generators than brackets alone are of use for.
    #[error(
        "{generators} generators are known by their brackets alone; at most {limit} are: the matrices of such an algebra are those of its adjoint representation, {generators} tables of {generators} × {generators}. Write it as a product of smaller groups, or give a matrix basis"
    )]
    TooLarge {
        /// The number of generators.
        generators: usize,
        /// The most there may be.
        limit: usize,
    },
    /// The bracket of a generator with itself is given and not zero.
    #[error(
        "[{generator}, {generator}] = 0 always, but a value is given for it; leave it out, or name two generators"
    )]
    SelfBracket {
        /// The name of the generator.
        generator: String,
        /// Its index, from zero.
        index: usize,
    },
    /// A basis matrix is not square.
    #[error("basis matrix {generator} is {rows} × {columns}; every basis matrix must be square")]
    NotSquare {
        /// The name of the generator.
        generator: String,
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// Basis matrices differ in size.
    #[error(
        "basis matrix {generator} is {size} × {size} but the first is {expected} × {expected}; all must have one size"
    )]
    DifferentSizes {
        /// The name of the generator.
        generator: String,
        /// Its size.
        size: usize,
        /// The size of the first.
        expected: usize,
    },
    /// A basis matrix is a combination of those before it.
    #[error(
        "basis matrix {generator} is a linear combination of those before it; leave it out or replace it"
    )]
    Dependent {
        /// The name of the generator.
        generator: String,
        /// Its index, from zero.
        index: usize,
    },
    /// A bracket leaves the span of the basis.
    #[error(
        "the bracket [{first}, {second}] is not a combination of the basis; add the matrices that close it"
    )]
    NotClosed {
        /// The name of the first generator.
        first: String,
        /// The name of the second generator.
        second: String,
        /// Their indices, from zero.
        indices: (usize, usize),
    },
    /// An index is at or beyond the dimension.
    #[error(
        "generator index {index} is out of range; there are {dimension} generators, counted from 0"
    )]
    OutOfRange {
        /// The index.
        index: usize,
        /// The dimension.
        dimension: usize,
    },
    /// A bracket or structure constant is given twice with different values.
    #[error("the bracket [{first}, {second}] is given twice with different values; keep one")]
    Inconsistent {
        /// The name of the first generator.
        first: String,
        /// The name of the second generator.
        second: String,
        /// Their indices, from zero.
        indices: (usize, usize),
    },
    /// c_ij^k and c_ji^k do not add up to zero.
    #[error(
        "[{a}, {b}] and [{b}, {a}] must be opposite, but their components along {c} are {forward} and {backward} (i, j, k = {i}, {j}, {k})",
        a = .generators[0], b = .generators[1], c = .generators[2], i = .indices.0, j = .indices.1, k = .indices.2
    )]
    NotAntisymmetric {
        /// The names of the generators i, j and k.
        generators: Box<[String; 3]>,
        /// c_ij^k.
        forward: Box<Rational>,
        /// c_ji^k.
        backward: Box<Rational>,
        /// (i, j, k), from zero.
        indices: (usize, usize, usize),
    },
    /// The Jacobi identity fails.
    #[error(
        "the Jacobi identity fails for {a}, {b}, {c} (i, j, k = {i}, {j}, {k}): [[{a}, {b}], {c}] + cyclic has component {value} along {along}",
        a = .generators[0], b = .generators[1], c = .generators[2], i = .indices.0, j = .indices.1, k = .indices.2
    )]
    Jacobi {
        /// The names of the generators i, j and k.
        generators: Box<[String; 3]>,
        /// (i, j, k), from zero.
        indices: (usize, usize, usize),
        /// The generator along which the sum does not vanish.
        along: String,
        /// The component of the sum along it.
        value: Box<Rational>,
    },
}

impl LieAlgebra {
    /// ad\*_{∂H/∂μ} μ, component by component: how each coordinate of the momentum moves. Variables
    /// of `hamiltonian` beyond the dimension are constants.
    pub(crate) fn hamiltonian_field(&self, hamiltonian: &Polynomial) -> Vec<Polynomial> {
        let dim = self.dim();
        let variables = hamiltonian.variables();
        let omega = hamiltonian.gradient(dim);
        let mut field = vec![Polynomial::zero(variables); dim];
        for constant in self.structure() {
            let momentum = Polynomial::variable(variables, constant.k);
            let product = (&omega[constant.i] * &momentum).scale(&constant.value);
            field[constant.j] = &field[constant.j] + &product;
        }
        field
    }
}
