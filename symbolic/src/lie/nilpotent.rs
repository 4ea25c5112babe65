//! Whether an algebra is nilpotent, so that exp is regular everywhere.

use num_traits::Zero;
use std::collections::BTreeMap;

use super::{Echelon, LieAlgebra};
use crate::number::Rational;

type Row = BTreeMap<u32, Rational>;

impl LieAlgebra {
    /// Whether the lower central series 𝔤, \[𝔤, 𝔤\], \[𝔤, \[𝔤, 𝔤\]\], … ends at zero. Every ad_x is then
    /// nilpotent, and d exp is invertible at every x.
    ///
    /// ```
    /// use coadjoint_symbolic::lie::catalogue::lookup;
    ///
    /// assert!(lookup("Heisenberg").unwrap().is_nilpotent());
    /// assert!(!lookup("SE2").unwrap().is_nilpotent());
    /// ```
    #[must_use]
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
