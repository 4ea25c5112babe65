//! Splitting an algebra into direct factors.

use super::{LieAlgebra, RationalMatrix, StructureConstant};

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
    #[must_use]
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
    #[must_use]
    pub fn factor_of_coordinates(&self) -> Vec<u32> {
        let starts: Vec<usize> = self.blocks().iter().map(|block| block.element).collect();
        let factor = |i| starts.partition_point(|&start| start <= i).saturating_sub(1) as u32;
        (0..self.dim()).map(factor).collect()
    }

    /// Where the factors begin.
    fn blocks(&self) -> Vec<Block> {
        let mut blocks: Vec<Block> = Vec::new();
        // The last element, and the last row, that what came before has.
        for ideal in self.ideals() {
            let (first, last) = (ideal[0], ideal[ideal.len() - 1]);
            let rows = |index: &usize| {
                let matrix = self.basis().map(|basis| &basis[*index]);
                matrix.into_iter().flat_map(RationalMatrix::entries).flat_map(|(i, j, _)| [i, j])
            };
            let rows: Vec<usize> = ideal.iter().flat_map(rows).collect();
            let none = self.basis().is_none();
            let mut block = Block {
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
struct Block {
    element: usize,
    last_element: usize,
    row: usize,
    last_row: usize,
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
