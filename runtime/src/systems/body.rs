//! Bodies free of torque: on so(3)*, and Manakov's on so(4)*.

use crate::lie_poisson;

/// The free rigid body in principal axes: H = ½ Σ Πᵢ²/Iᵢ, Π̇ = Π × Ω, Ω = I⁻¹Π (Euler).
///
/// Π: angular momentum in body axes, kg m²/s; `inertia`: principal moments, kg m².
#[lie_poisson(group = SO3, truncation = 7, frame = comoving)]
pub fn free_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    let [x, y, z] = mu;
    let [i1, i2, i3] = inertia;
    0.5 * (x * x / i1 + y * y / i2 + z * z / i3)
}

/// The free rigid body with a full inertia tensor: H = ½ Π·I⁻¹Π, I⁻¹ by cofactors.
///
/// Π: angular momentum in body axes, kg m²/s; `moments`: I_xx, I_yy, I_zz, `products`: I_xy, I_xz,
/// I_yz as entries of the tensor (so usually negative of the integrals ∫xy dm), kg m².
#[lie_poisson(group = SO3, truncation = 7)]
pub fn free_body_full_inertia(mu: [f64; 3], moments: [f64; 3], products: [f64; 3]) -> f64 {
    let [x, y, z] = mu;
    let [xx, yy, zz] = moments;
    let [xy, xz, yz] = products;
    let determinant =
        xx * (yy * zz - yz * yz) - xy * (xy * zz - xz * yz) + xz * (xy * yz - xz * yy);
    let diagonal =
        (yy * zz - yz * yz) * x * x + (xx * zz - xz * xz) * y * y + (xx * yy - xy * xy) * z * z;
    let mixed =
        (xz * yz - xy * zz) * x * y + (xy * yz - xz * yy) * x * z + (xy * xz - xx * yz) * y * z;
    (0.5 * diagonal + mixed) / determinant
}

/// A gyrostat, or dual-spin spacecraft: H = Σ (Πᵢ − kᵢ)²/(2Iᵢ), Π̇ = Π × Ω, Ω = I⁻¹(Π − k).
///
/// Π: total angular momentum in platform axes, kg m²/s; `inertia`: principal moments without the
/// rotor's axial one, kg m²; `rotor`: the rotor's momentum k relative to the platform, kg m²/s.
/// V. Volterra, Acta Math. 22 (1899) 201; P. C. Hughes, *Spacecraft Attitude Dynamics* (1986), § 6.4.
#[lie_poisson(group = SO3, truncation = 7, frame = comoving)]
pub fn gyrostat(mu: [f64; 3], inertia: [f64; 3], rotor: [f64; 3]) -> f64 {
    let mut twice = 0.0;
    for i in 0..3 {
        twice += (mu[i] - rotor[i]) * (mu[i] - rotor[i]) / inertia[i];
    }
    twice / 2.0
}

/// Manakov's free body in four dimensions: H = ½ Σ_{a<b} M_ab²/(j_a + j_b), Ṁ = \[M, Ω\],
/// M = JΩ + ΩJ.
///
/// Coordinates M₁₂, M₁₃, M₁₄, M₂₃, M₂₄, M₃₄; besides H and two Casimirs, Σ (j_a² + j_b²) M_ab² is
/// an integral. S. V. Manakov, Funct. Anal. Appl. 10 (1976) 328. Dimensionless.
#[lie_poisson(group = SO4, truncation = 5)]
pub fn manakov_body(mu: [f64; 6], j: [f64; 4]) -> f64 {
    let [m12, m13, m14, m23, m24, m34] = mu;
    let first = m12 * m12 / (j[0] + j[1]) + m13 * m13 / (j[0] + j[2]) + m14 * m14 / (j[0] + j[3]);
    let rest = m23 * m23 / (j[1] + j[2]) + m24 * m24 / (j[1] + j[3]) + m34 * m34 / (j[2] + j[3]);
    (first + rest) / 2.0
}
