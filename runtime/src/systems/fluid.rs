//! A body in an ideal, irrotational fluid at rest at infinity, on se(3)* (Kirchhoff).
//!
//! The momentum is (Π, P): angular and linear impulse of body and fluid in body axes,
//! Π̇ = Π × ∂H/∂Π + P × ∂H/∂P, Ṗ = P × ∂H/∂Π. Casimirs |P|² and Π·P.

use crate::lie_poisson;

/// Kirchhoff's body with three planes of symmetry: H = ½ Σ (Πᵢ²/Jᵢ + Pᵢ²/Mᵢ).
///
/// `inertia` J in kg m² and `mass` M in kg, both with what the fluid adds.
/// G. Kirchhoff, J. reine angew. Math. 71 (1870) 237; H. Lamb, *Hydrodynamics*, §§ 124–126.
#[lie_poisson(group = SE3, truncation = 5, frame = comoving)]
pub fn kirchhoff_body(mu: [f64; 6], inertia: [f64; 3], mass: [f64; 3]) -> f64 {
    let mut twice = 0.0;
    for i in 0..3 {
        twice += mu[i] * mu[i] / inertia[i] + mu[i + 3] * mu[i + 3] / mass[i];
    }
    twice / 2.0
}

/// Clebsch's integrable case of Kirchhoff's equations: H = ½ Σ (aᵢΠᵢ² + k a₁a₂a₃/aᵢ Pᵢ²).
///
/// Σ (Πᵢ² − k aᵢPᵢ²) is an integral. `a` in 1/(kg m²), k such that k a² is in 1/kg.
/// A. Clebsch, Math. Ann. 3 (1871) 238.
#[lie_poisson(group = SE3, truncation = 5)]
pub fn clebsch_case(mu: [f64; 6], a: [f64; 3], k: f64) -> f64 {
    let [x, y, z, px, py, pz] = mu;
    let turning = a[0] * x * x + a[1] * y * y + a[2] * z * z;
    let moving = a[1] * a[2] * px * px + a[2] * a[0] * py * py + a[0] * a[1] * pz * pz;
    (turning + k * moving) / 2.0
}
