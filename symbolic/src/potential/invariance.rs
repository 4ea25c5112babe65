//! The quantities that a potential leaves conserved.

use std::collections::BTreeMap;

use num_traits::Zero;

use super::Potential;
use crate::lie::{Echelon, RationalMatrix};
use crate::number::{Rational, integer};
use crate::poly::Polynomial;

/// The maximum number of multiplications in an elimination.
const OPERATIONS: u64 = 10_000_000;

impl Potential {
    /// A basis of the ξ ∈ 𝔤 with V(exp(sξ)g) = V(g), found as polynomials in the entries of any
    /// matrix g: by Noether's theorem ⟨J_L, ξ⟩ is conserved, by kicks exactly. Symmetries that
    /// rest on relations between the entries, such as orthogonality, are not found.
    #[must_use]
    pub fn symmetries(&self) -> Vec<Vec<Rational>> {
        // (e g)_ij = Σ_l e_il g_lj.
        let motion = |e: &RationalMatrix, i: usize, j: usize| {
            let row = e.entries().filter(|&(r, _, _)| r == i);
            row.map(|(_, l, value)| ((l, j), value.clone())).collect()
        };
        let slopes: Vec<Polynomial> =
            self.algebra.matrices().iter().map(|e| self.along(|i, j| motion(e, i, j))).collect();
        let mut rows: BTreeMap<Vec<u32>, BTreeMap<u32, Rational>> = BTreeMap::new();
        for (k, slope) in slopes.iter().enumerate() {
            for (exponents, value) in slope.terms() {
                rows.entry(exponents).or_default().insert(k as u32, value);
            }
        }
        let mut echelon = Echelon::new(OPERATIONS);
        for row in rows.into_values() {
            echelon.insert(row);
        }
        if echelon.within_limit().is_err() {
            return Vec::new();
        }
        let dense = |vector: BTreeMap<u32, Rational>| {
            let entry = |k: usize| vector.get(&(k as u32)).cloned().unwrap_or_else(Rational::zero);
            (0..slopes.len()).map(entry).collect()
        };
        echelon
            .kernel(slopes.len() as u32)
            .map_or_else(|_| Vec::new(), |kernel| kernel.into_iter().map(dense).collect())
    }

    /// Whether kicks by V conserve this function C of the momentum: Σ_k ∂C/∂μ_k τ_k(g) = 0 for all μ
    /// and g, τ the body torque.
    #[must_use]
    pub fn keeps(&self, casimir: &Polynomial) -> bool {
        let torque = self.torque();
        let mut sums: BTreeMap<(Vec<u32>, Vec<u32>), Rational> = BTreeMap::new();
        for (k, torque) in torque.iter().enumerate() {
            for (mu, slope) in casimir.derivative(k).terms() {
                for (g, value) in torque.terms() {
                    *sums.entry((mu.clone(), g)).or_insert_with(|| integer(0)) += &slope * value;
                }
            }
        }
        sums.values().all(Zero::is_zero)
    }
}
