//! Splitting an algebra into direct factors.

use std::collections::BTreeMap;

use num_traits::Zero;

use crate::lie::elimination::Row;
use crate::lie::{Echelon, LieAlgebra, LieAlgebraError, RationalMatrix, StructureConstant};
use crate::number::{Rational, integer};

impl LieAlgebra {
    /// The direct factors this algebra shows in its basis, in order: consecutive basis elements that
    /// span commuting ideals and whose matrices, where there are any, fill diagonal blocks of their
    /// own. SO3^64 has 64; an algebra that does not split is its own only factor.
    ///
    /// ```
    /// use coadjoint_symbolic::lie::catalogue::lookup;
    ///
    /// let factors = lookup("SO3^4").unwrap().factors();
    /// assert_eq!((factors.len(), factors[2].dim()), (4, 3));
    /// assert_eq!(lookup("SE3").unwrap().factors().len(), 1);
    /// ```
    pub fn factors(&self) -> Vec<Self> {
        let blocks = self.blocks();
        if blocks.len() <= 1 {
            return vec![self.clone()];
        }
        let mut structure: Vec<Vec<StructureConstant>> = vec![Vec::new(); blocks.len()];
        for c in self.structure() {
            let at = blocks.partition_point(|block| block.element <= c.i) - 1;
            let first = blocks[at].element;
            let (i, j, k) = (c.i - first, c.j - first, c.k - first);
            structure[at].push(StructureConstant { i, j, k, value: c.value.clone() });
        }
        let size = self.basis().and_then(<[_]>::first).map_or(0, RationalMatrix::rows);
        let ends = blocks.iter().skip(1).map(|block| (block.element, block.row));
        let ends = ends.chain([(self.dim(), size)]);
        blocks
            .iter()
            .zip(ends)
            .zip(structure)
            .map(|((block, (end, last_row)), structure)| {
                let basis = self.basis().map(|basis| {
                    let own = |matrix: &RationalMatrix| {
                        let entries = matrix.entries();
                        let entries =
                            entries.map(|(i, j, v)| (i - block.row, j - block.row, v.clone()));
                        let size = last_row - block.row;
                        RationalMatrix::from_entries(size, size, entries)
                    };
                    basis[block.element..end].iter().map(own).collect()
                });
                let generators = (1..=end - block.element).map(|i| format!("e{i}")).collect();
                // Equal factors are to be equal: the place in the product is not in the name.
                Self::from_parts(self.name().into(), generators, structure, basis)
            })
            .collect()
    }

    /// The number of the direct factor that each coordinate belongs to, ascending from 0.
    pub fn factor_of_coordinates(&self) -> Vec<u32> {
        let starts: Vec<usize> = self.blocks().iter().map(|block| block.element).collect();
        let factor = |i| starts.partition_point(|&start| start <= i).saturating_sub(1) as u32;
        (0..self.dim()).map(factor).collect()
    }

    /// The first index of each factor.
    fn blocks(&self) -> Vec<Stretch> {
        let mut blocks: Vec<Stretch> = Vec::new();
        // The last element, and the last row, that what came before has.
        for ideal in self.ideals() {
            let (first, last) = (ideal[0], ideal[ideal.len() - 1]);
            let rows = |index: &usize| {
                let matrix = self.basis().map(|basis| &basis[*index]);
                matrix.into_iter().flat_map(RationalMatrix::entries).flat_map(|(i, j, _)| [i, j])
            };
            let rows: Vec<usize> = ideal.iter().flat_map(rows).collect();
            let none = self.basis().is_none();
            let mut block = Stretch {
                element: first,
                last_element: last,
                row: rows.iter().copied().min().unwrap_or(if none { first } else { 0 }),
                last_row: rows.iter().copied().max().unwrap_or(if none { last } else { 0 }),
            };
            // Overlapping blocks are merged.
            while let Some(before) = blocks.pop_if(|before| {
                before.last_element >= block.element || before.last_row >= block.row
            }) {
                block.element = block.element.min(before.element);
                block.last_element = block.last_element.max(before.last_element);
                block.row = block.row.min(before.row);
                block.last_row = block.last_row.max(before.last_row);
            }
            blocks.push(block);
        }
        // Rows that no matrix touches go with the block before, or the first.
        if let Some(first) = blocks.first_mut() {
            first.row = 0;
        }
        blocks
    }
}

/// Consecutive basis elements, and the rows of their matrices.
struct Stretch {
    element: usize,
    last_element: usize,
    row: usize,
    last_row: usize,
}

impl LieAlgebra {
    /// True if the lower central series 𝔤, \[𝔤, 𝔤\], \[𝔤, \[𝔤, 𝔤\]\], … ends at zero. Every ad_x is then nilpotent, and d
    /// exp is invertible at every x.
    ///
    /// ```
    /// use coadjoint_symbolic::lie::catalogue::lookup;
    ///
    /// assert!(lookup("Heisenberg").unwrap().is_nilpotent());
    /// assert!(!lookup("SE2").unwrap().is_nilpotent());
    /// ```
    pub fn is_nilpotent(&self) -> bool {
        // The brackets of e_i with e_j, for each i and j.
        let mut brackets: BTreeMap<usize, Vec<(usize, usize, &Rational)>> = BTreeMap::new();
        for c in self.structure() {
            brackets.entry(c.j).or_default().push((c.i, c.k, &c.value));
        }
        let one = |j: usize| Row::from([(j as u32, crate::number::integer(1))]);
        let mut term: Vec<Row> = (0..self.dim()).map(one).collect();
        loop {
            let mut next = Echelon::new(u64::MAX);
            let mut rows = Vec::new();
            for vector in &term {
                let mut images: BTreeMap<usize, Row> = BTreeMap::new();
                for (&j, factor) in vector {
                    for &(i, k, value) in brackets.get(&(j as usize)).into_iter().flatten() {
                        let image = images.entry(i).or_default();
                        *image.entry(k as u32).or_insert_with(Rational::zero) += factor * value;
                    }
                }
                for mut image in images.into_values() {
                    image.retain(|_, value| !value.is_zero());
                    rows.extend(next.insert(image));
                }
            }
            if rows.is_empty() {
                return true;
            }
            if rows.len() == term.len() {
                return false;
            }
            term = rows;
        }
    }
}

impl LieAlgebra {
    /// The direct product; its basis is the bases one after the other, its matrices block
    /// diagonal. Without factors it would be no algebra, so one factor at least is expected.
    pub(crate) fn direct_product(factors: &[Self]) -> Self {
        let mut structure = Vec::new();
        let mut generators = Vec::new();
        let mut name = String::new();
        let mut offset = 0;
        for factor in factors {
            if !name.is_empty() {
                name.push_str(" * ");
            }
            if factor.name().contains(" * ") || factor.name().contains(" |x ") {
                name.push_str(&format!("({})", factor.name()));
            } else {
                name.push_str(factor.name());
            }
            structure.extend(factor.structure().iter().map(|c| StructureConstant {
                i: c.i + offset,
                j: c.j + offset,
                k: c.k + offset,
                value: c.value.clone(),
            }));
            offset += factor.dim();
        }
        for i in 0..offset {
            generators.push(format!("e{}", i + 1));
        }
        Self::from_parts(name, generators, structure, block_diagonal(factors))
    }

    /// The finest splitting of the basis into sets that span commuting ideals, each ascending, in
    /// order of their first elements.
    pub(crate) fn ideals(&self) -> Vec<Vec<usize>> {
        let mut parent: Vec<usize> = (0..self.dim()).collect();
        fn root(parent: &mut [usize], mut i: usize) -> usize {
            while parent[i] != i {
                parent[i] = parent[parent[i]];
                i = parent[i];
            }
            i
        }
        for c in self.structure() {
            for other in [c.j, c.k] {
                let (a, b) = (root(&mut parent, c.i), root(&mut parent, other));
                parent[a.max(b)] = a.min(b);
            }
        }
        let mut sets: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for i in 0..self.dim() {
            sets.entry(root(&mut parent, i)).or_default().push(i);
        }
        sets.into_values().collect()
    }

    /// The ideal spanned by some basis elements, as an algebra of its own.
    pub(crate) fn restricted(&self, indices: &[usize]) -> Self {
        let place: BTreeMap<usize, usize> =
            indices.iter().enumerate().map(|(new, &old)| (old, new)).collect();
        let structure = self
            .structure()
            .iter()
            .filter_map(|c| {
                let (i, j, k) = (*place.get(&c.i)?, *place.get(&c.j)?, *place.get(&c.k)?);
                Some(StructureConstant { i, j, k, value: c.value.clone() })
            })
            .collect();
        let generators = (1..=indices.len()).map(|i| format!("e{i}")).collect();
        Self::from_parts(self.name().into(), generators, structure, None)
    }

    /// The direct product of equal factors, one at least.
    pub(crate) fn power(&self, count: usize) -> Self {
        if count <= 1 {
            return self.clone();
        }
        let product = Self::direct_product(&vec![self.clone(); count]);
        let base = match self.name().contains(' ') {
            true => format!("({})", self.name()),
            false => self.name().to_owned(),
        };
        product.renamed(format!("{base}^{count}"))
    }

    /// The semidirect product 𝔤 ⋉ V^copies, \[e_i, v_a\] = Σ_b ρ(e_i)_ba v_b, with one matrix of the representation ρ on V
    /// for every generator. The basis is that of 𝔤, then the first copy of V, then the second, ….
    ///
    /// If ρ is given by the matrices of 𝔤 themselves, the result consists of affine matrices ((ξ, v), (0, 0)), v having one
    /// column for each copy; otherwise ((ρ(ξ), v), (0, 0)) stands beside ξ as a block of its own.
    ///
    /// # Errors
    /// Fails if a matrix is missing or not square, or ρ is no representation (the Jacobi identity fails).
    pub fn semidirect_product(
        name: impl Into<String>,
        algebra: &Self,
        representation: &[RationalMatrix],
        copies: usize,
    ) -> Result<Self, LieAlgebraError> {
        let n = algebra.dim();
        let size = representation.first().map_or(0, RationalMatrix::rows);
        if representation.len() != n {
            return Err(LieAlgebraError::OutOfRange { index: representation.len(), dimension: n });
        }
        let mut table: BTreeMap<(usize, usize, usize), Rational> =
            algebra.structure().iter().map(|c| ((c.i, c.j, c.k), c.value.clone())).collect();
        for (i, matrix) in representation.iter().enumerate() {
            if matrix.rows() != size || matrix.columns() != size {
                return Err(LieAlgebraError::NotSquare {
                    generator: algebra.generators()[i].clone(),
                    rows: matrix.rows(),
                    columns: matrix.columns(),
                });
            }
            for (b, a, value) in matrix.entries() {
                for copy in 0..copies {
                    let shift = n + copy * size;
                    table.insert((i, shift + a, shift + b), value.clone());
                    table.insert((shift + a, i, shift + b), -value.clone());
                }
            }
        }
        let generators = (1..=n + copies * size).map(|i| format!("e{i}")).collect();
        let basis = algebra.basis().map(|b| affine(b, representation, size, copies));
        Self::checked(name.into(), generators, table, basis)
    }
}

fn block_diagonal(factors: &[LieAlgebra]) -> Option<Vec<RationalMatrix>> {
    let bases: Vec<&[RationalMatrix]> =
        factors.iter().map(LieAlgebra::basis).collect::<Option<_>>()?;
    let size = |basis: &[RationalMatrix]| basis.first().map_or(0, RationalMatrix::rows);
    let total = bases.iter().map(|basis| size(basis)).sum();
    let mut result = Vec::new();
    let mut offset = 0;
    for basis in bases {
        for matrix in basis {
            result.push(placed(matrix, total, offset));
        }
        offset += size(basis);
    }
    Some(result)
}

/// A matrix as a diagonal block of a larger one.
fn placed(matrix: &RationalMatrix, size: usize, offset: usize) -> RationalMatrix {
    let entries = matrix.entries().map(|(i, j, v)| (i + offset, j + offset, v.clone()));
    RationalMatrix::from_entries(size, size, entries)
}

fn affine(
    basis: &[RationalMatrix],
    representation: &[RationalMatrix],
    size: usize,
    copies: usize,
) -> Vec<RationalMatrix> {
    let own = if basis == representation { 0 } else { basis.first().map_or(0, |m| m.rows()) };
    let total = own + size + copies;
    let mut result = Vec::new();
    for (matrix, image) in basis.iter().zip(representation) {
        let block = placed(image, total, own);
        result.push(match own {
            0 => block,
            _ => block.plus(&placed(matrix, total, 0), &integer(1)),
        });
    }
    for copy in 0..copies {
        for a in 0..size {
            let entry = (own + a, own + size + copy, integer(1));
            result.push(RationalMatrix::from_entries(total, total, [entry]));
        }
    }
    result
}

/// The action S ↦ ξS + Sξᵀ on symmetric matrices, in the basis E_aa and E_ab + E_ba for a < b, in
/// lexicographic order of (a, b), a ≤ b.
pub(crate) fn symmetric_square(matrix: &RationalMatrix) -> RationalMatrix {
    let n = matrix.rows();
    let index = |a: usize, b: usize| {
        let (a, b) = (a.min(b), a.max(b));
        a * n - a * a.saturating_sub(1) / 2 - a + b
    };
    let mut entries = Vec::new();
    // E_ca takes E_ab + E_ba to E_cb + E_bc, which is twice the basis element if c = b; and the
    // same holds for E_aa.
    for (c, a, value) in matrix.entries() {
        for b in 0..n {
            let value = if b == c { value * integer(2) } else { value.clone() };
            entries.push((index(c, b), index(a, b), value));
        }
    }
    let dimension = n * (n + 1) / 2;
    RationalMatrix::from_entries(dimension, dimension, entries)
}

#[cfg(test)]
mod tests {
    use super::super::catalogue::lookup;

    #[test]
    fn factors_multiply_to_the_algebra() {
        for (name, count) in [
            ("SO3^3", 3),
            ("SO3 * SE2", 2),
            ("SO3", 1),
            ("SE3", 1),
            ("SO4", 1),
            ("(SO3 |x R3) * SU2", 2),
        ] {
            let algebra = lookup(name).unwrap();
            let factors = algebra.factors();
            assert_eq!(factors.len(), count, "{name}");
            let product = super::LieAlgebra::direct_product(&factors);
            assert_eq!(product.structure(), algebra.structure(), "{name}");
            assert_eq!(product.basis(), algebra.basis(), "{name}");
        }
    }

    #[test]
    fn commuting_directions_in_one_block_stay_together() {
        // Translations of the plane share the column of the affine matrices.
        let translations = lookup("R2").unwrap();
        assert_eq!(translations.factors().len(), 1);
    }
}
