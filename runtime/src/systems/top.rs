//! Tops: a body with one point fixed, in uniform gravity, on se(3)*.
//!
//! The momentum is (Π, Γ): the angular momentum and the upward vertical in body axes,
//! Π̇ = Π × Ω + Γ × ∂H/∂Γ, Γ̇ = Γ × Ω (Marsden and Ratiu, *Introduction to Mechanics and Symmetry*,
//! § 15.10). Casimirs |Γ|² and Π·Γ.

use crate::lie_poisson;

/// The heavy top: H = ½ Σ Πᵢ²/Iᵢ + Γ·w.
///
/// `inertia`: principal moments about the fixed point, kg m²; `weight`: w = m g times the vector
/// from the fixed point to the centre of mass, N m.
#[lie_poisson(group = SE3, truncation = 5)]
pub fn heavy_top(mu: [f64; 6], inertia: [f64; 3], weight: [f64; 3]) -> f64 {
    let mut energy = 0.0;
    for i in 0..3 {
        energy += mu[i] * mu[i] / (2.0 * inertia[i]) + mu[i + 3] * weight[i];
    }
    energy
}

/// Lagrange's top: H = (Π₁² + Π₂²)/(2I₁) + Π₃²/(2I₃) + m g l Γ₃; Π₃ is an integral.
///
/// `transverse` I₁ and `axial` I₃ in kg m² about the tip, `mgl` in N m. In the comoving frame a
/// step may be as long as nutation allows, however fast the top spins.
#[lie_poisson(group = SE3, truncation = 5, frame = comoving)]
pub fn lagrange_top(mu: [f64; 6], transverse: f64, axial: f64, mgl: f64) -> f64 {
    let [x, y, z, _, _, w] = mu;
    (x * x + y * y) / (2.0 * transverse) + z * z / (2.0 * axial) + mgl * w
}

/// Kovalevskaya's top, I = (2, 2, 1): H = ¼(Π₁² + Π₂²) + ½Π₃² + cΓ₁.
///
/// Inertia in units of I₃, c = m g l/I₃ in 1/s². Fourth integral:
/// (¼(Π₁² − Π₂²) − cΓ₁)² + (½Π₁Π₂ − cΓ₂)². S. Kowalevski, Acta Math. 12 (1889) 177.
#[lie_poisson(group = SE3, truncation = 5)]
pub fn kovalevskaya_top(mu: [f64; 6], c: f64) -> f64 {
    let [x, y, z, u, _, _] = mu;
    (x * x + y * y) / 4.0 + z * z / 2.0 + c * u
}

/// The Goryachev–Chaplygin top, I = (4, 4, 1): H = (Π₁² + Π₂² + 4Π₃²)/8 + cΓ₁.
///
/// Inertia in units of I₃, c = m g l/I₃ in 1/s². Where Π·Γ = 0, Π₃(Π₁² + Π₂²) − 4cΠ₁Γ₃ is an
/// integral. S. A. Chaplygin, Trudy Otd. Fiz. Nauk 10 (1901) 32.
#[lie_poisson(group = SE3, truncation = 5)]
pub fn goryachev_chaplygin_top(mu: [f64; 6], c: f64) -> f64 {
    let [x, y, z, u, _, _] = mu;
    (x * x + y * y + 4.0 * z * z) / 8.0 + c * u
}
