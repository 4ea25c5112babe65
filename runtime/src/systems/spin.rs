//! Classical spins, on so(3)* × … × so(3)*.

use crate::lie_poisson;

/// A ring of four classical spins: H = −J Σ sᵢ·sᵢ₊₁ + D Σ (sᵢᶻ)² − B Σ sᵢᶻ, ṡᵢ = sᵢ × ∂H/∂sᵢ.
///
/// Coordinates spin by spin; `exchange` J, `anisotropy` D and `field` B in one unit of energy, time
/// in ħ over it. Each |sᵢ|² is a Casimir, and Σ sᵢᶻ is kept exactly.
/// M. Lakshmanan, Phil. Trans. R. Soc. A 369 (2011) 1280.
#[lie_poisson(group = SO3^4, truncation = 3)]
pub fn heisenberg_spin_ring(mu: [f64; 12], exchange: f64, anisotropy: f64, field: f64) -> f64 {
    let mut coupling = 0.0;
    for site in 0..3 {
        for axis in 0..3 {
            coupling += mu[3 * site + axis] * mu[3 * site + 3 + axis];
        }
    }
    for axis in 0..3 {
        coupling += mu[9 + axis] * mu[axis];
    }
    let mut energy = -exchange * coupling;
    for site in 0..4 {
        let z = mu[3 * site + 2];
        energy += anisotropy * z * z - field * z;
    }
    energy
}
