//! Lattices on the duals of solvable algebras.

use crate::lie_poisson;

/// The open Toda lattice of four particles in Flaschka's variables:
/// H = 2 Σ bᵢ² + 4 Σ aᵢ² = Σ ½ pᵢ² + Σ exp(qᵢ − qᵢ₊₁), aᵢ = ½ exp((qᵢ − qᵢ₊₁)/2), bᵢ = −½ pᵢ.
///
/// ȧᵢ = aᵢ (bᵢ₊₁ − bᵢ), ḃᵢ = 2 (aᵢ² − aᵢ₋₁²); coordinates a₁ a₂ a₃ b₁ b₂ b₃ b₄, the bracket
/// {aᵢ, bᵢ} = −¼ aᵢ, {aᵢ, bᵢ₊₁} = ¼ aᵢ. Casimir Σ bᵢ; the eigenvalues of the tridiagonal matrix with
/// diagonal b beside a are integrals, and b tends to them, sorted. Units: mass and length of the
/// lattice. H. Flaschka, Phys. Rev. B 9 (1974) 1924; J. Moser, Lect. Notes Phys. 38 (1975) 467.
#[lie_poisson(
    group = algebra(
        generators = [A1, A2, A3, B1, B2, B3, B4],
        brackets = [
            "[A1, B1] = 1/4*A1", "[A1, B2] = -1/4*A1", "[A2, B2] = 1/4*A2",
            "[A2, B3] = -1/4*A2", "[A3, B3] = 1/4*A3", "[A3, B4] = -1/4*A3"
        ]
    ),
    truncation = 5
)]
pub fn toda_lattice(mu: [f64; 7]) -> f64 {
    let [a1, a2, a3, b1, b2, b3, b4] = mu;
    2.0 * (b1 * b1 + b2 * b2 + b3 * b3 + b4 * b4) + 4.0 * (a1 * a1 + a2 * a2 + a3 * a3)
}
