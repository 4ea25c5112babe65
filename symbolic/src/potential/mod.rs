//! Potentials V(g), polynomials in the matrix entries of the group element, and what follows from
//! them exactly: the body torque −g⁻¹dV(g), the symmetry that is left, the Casimirs that survive.

mod invariance;

use crate::lie::{LieAlgebra, RationalMatrix};
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
