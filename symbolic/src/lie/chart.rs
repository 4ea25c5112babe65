//! Charts of a group near the identity.

use super::{LieAlgebra, RationalMatrix, Span};
use crate::number::Rational;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// A chart τ: 𝔤 → G near the identity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Chart {
    /// τ = exp; exists for every algebra.
    #[default]
    Exponential,
    /// τ(x) = (1 − x/2)⁻¹(1 + x/2) in a matrix representation; needs xξx ∈ 𝔤.
    Cayley,
}

/// Reasons for which an algebra does not have a chart.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ChartError {
    /// The product xξx leaves the algebra.
    #[error(
        "{algebra} has no Cayley chart: xξx leaves the algebra for x = {first} + {third}, ξ = {second}; use the exponential chart (exp)"
    )]
    LeavesAlgebra {
        /// The algebra.
        algebra: String,
        /// First generator of x.
        first: String,
        /// The generator ξ.
        second: String,
        /// Second generator of x (may equal the first).
        third: String,
    },
    /// Only brackets are known, so there is no matrix product.
    #[error(
        "{algebra} is known by its brackets alone, without a matrix product, so it has no Cayley chart; use the exponential chart (exp) or give a matrix basis"
    )]
    NoMatrices {
        /// The algebra.
        algebra: String,
    },
}

/// One component of x ξ x in the basis: x_first · x_second · ξ_argument · value along `result`,
/// with first ≤ second.
#[derive(Clone, Debug)]
pub(crate) struct CubicEntry {
    pub(crate) first: usize,
    pub(crate) second: usize,
    pub(crate) argument: usize,
    pub(crate) result: usize,
    pub(crate) value: Rational,
}

impl Chart {
    /// Checks that this algebra has the chart.
    ///
    /// # Errors
    /// Returns the reason if it does not.
    pub fn check(self, algebra: &LieAlgebra) -> Result<(), ChartError> {
        match self {
            Self::Exponential => Ok(()),
            Self::Cayley => cubic(algebra).map(|_| ()),
        }
    }

    /// The name in files and attributes: `exp` or `cayley`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exponential => "exp",
            Self::Cayley => "cayley",
        }
    }
}

impl fmt::Display for Chart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The map (x, ξ) ↦ xξx in coordinates, by polarisation: e_a e_b e_c + e_c e_b e_a for a < c and
/// e_a e_b e_a. It closes on the algebra exactly if all of these do.
pub(crate) fn cubic(algebra: &LieAlgebra) -> Result<Vec<CubicEntry>, ChartError> {
    let Some(basis) = algebra.basis() else {
        return Err(ChartError::NoMatrices { algebra: algebra.name().into() });
    };
    let Ok(span) = Span::new(basis) else {
        return Err(ChartError::NoMatrices { algebra: algebra.name().into() });
    };
    let one = crate::number::integer(1);
    let neighbours = Neighbours::new(basis);
    let mut entries = Vec::new();
    for a in 0..basis.len() {
        // Generators that multiply with e_a to something, on either side.
        for b in neighbours.of([&basis[a]]) {
            let left = basis[a].times(&basis[b]);
            let right = basis[b].times(&basis[a]);
            for c in neighbours.of([&left, &right]).into_iter().filter(|&c| c >= a) {
                let mut product = left.times(&basis[c]);
                if c > a {
                    product = product.plus(&basis[c].times(&right), &one);
                }
                if product.is_zero() {
                    continue;
                }
                let Some(coordinates) = span.coordinates(&product) else {
                    let names = algebra.generators();
                    return Err(ChartError::LeavesAlgebra {
                        algebra: algebra.name().into(),
                        first: names[a].clone(),
                        second: names[b].clone(),
                        third: names[c].clone(),
                    });
                };
                for (result, value) in coordinates {
                    entries.push(CubicEntry { first: a, second: c, argument: b, result, value });
                }
            }
        }
    }
    Ok(entries)
}

/// Which basis matrices have entries in a row or column, so that products in large direct powers
/// are found without trying all.
struct Neighbours {
    rows: BTreeMap<usize, Vec<usize>>,
    columns: BTreeMap<usize, Vec<usize>>,
}

impl Neighbours {
    fn new(basis: &[RationalMatrix]) -> Self {
        let (mut rows, mut columns) = (BTreeMap::new(), BTreeMap::new());
        for (index, matrix) in basis.iter().enumerate() {
            for (i, j, _) in matrix.entries() {
                rows.entry(i).or_insert_with(Vec::new).push(index);
                columns.entry(j).or_insert_with(Vec::new).push(index);
            }
        }
        Self { rows, columns }
    }

    /// The generators whose product with one of the matrices, on either side, may not vanish.
    fn of<const N: usize>(&self, matrices: [&RationalMatrix; N]) -> BTreeSet<usize> {
        let mut result = BTreeSet::new();
        for (i, j, _) in matrices.iter().flat_map(|matrix| matrix.entries()) {
            result.extend(self.rows.get(&j).into_iter().flatten());
            result.extend(self.columns.get(&i).into_iter().flatten());
        }
        result
    }
}
