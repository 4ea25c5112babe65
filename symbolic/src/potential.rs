//! Potentials V(g), polynomials in the matrix entries of the group element, and what follows from
//! them exactly: the body torque −g⁻¹dV(g), the symmetry that is left, the Casimirs that survive.

use std::collections::BTreeMap;

use num_traits::Zero;

use crate::lie::{Echelon, LieAlgebra, RationalMatrix};
use crate::number::{Rational, integer};
use crate::poly::Polynomial;
use crate::problem::{Parameter, Symbol};

/// A potential on a Lie group.
///
/// V is a polynomial over ℚ in the entries of the group element's matrix, row by row (the first
/// `size`² variables), and the [`Symbol`]s (the variables after them). The matrix is that of the
/// algebra's basis, or the adjoint matrix where only brackets are known.
#[derive(Clone, Debug)]
pub struct Potential {
    /// The name of the potential.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: LieAlgebra,
    /// The polynomial V.
    pub energy: Polynomial,
    /// The opaque coefficients of `energy`.
    pub symbols: Vec<Symbol>,
    /// The parameters the symbols are made of.
    pub parameters: Vec<Parameter>,
    /// The potential as the user wrote it.
    pub source: String,
}

impl Potential {
    /// The size d of group elements, which are d × d matrices.
    #[must_use]
    pub fn size(&self) -> usize {
        self.algebra.matrix_size()
    }

    /// The body torque: component k is −d/ds V(g·exp(s e_k)) at s = 0, which is
    /// −Σ ∂V/∂g_ij (g e_k)_ij.
    #[must_use]
    pub fn torque(&self) -> Vec<Polynomial> {
        // (g e)_ij = Σ_l g_il e_lj.
        let motion = |e: &RationalMatrix, i: usize, j: usize| {
            let column = e.entries().filter(|&(_, c, _)| c == j);
            column.map(|(l, _, value)| ((i, l), -value.clone())).collect()
        };
        self.algebra.matrices().iter().map(|e| self.along(|i, j| motion(e, i, j))).collect()
    }

    /// Σ ∂V/∂g_ij m_ij with m_ij linear in g, given by its terms ((row, column), coefficient).
    fn along(
        &self,
        motion: impl Fn(usize, usize) -> Vec<((usize, usize), Rational)>,
    ) -> Polynomial {
        let size = self.size();
        let mut terms = Vec::new();
        for (exponents, value) in self.energy.terms() {
            // A variable is an entry of the matrix, number row · size + column.
            for at in (0..size * size).filter(|&at| exponents[at] > 0) {
                for ((row, column), by) in motion(at / size, at % size) {
                    let mut exponents = exponents.clone();
                    let power = integer(i64::from(exponents[at]));
                    exponents[at] -= 1;
                    exponents[row * size + column] += 1;
                    terms.push((exponents, &value * power * by));
                }
            }
        }
        Polynomial::from_terms(self.energy.variables(), terms)
    }
}

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
