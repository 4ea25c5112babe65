//! Systems on su(3)* and su(5)*.
//!
//! su(3)* is identified with su(3) by ⟨M, ξ⟩ = −½ tr Mξ; the coordinates are Re M₁₂, Im M₁₂,
//! Re M₁₃, Im M₁₃, Re M₂₃, Im M₂₃, and ½(d₁ − d₂), ½(d₂ − d₃) for the diagonal i(d₁, d₂, d₃).

use crate::lie_poisson;

/// A free "rigid body" whose configurations are SU(3): H = ½ Σ μⱼ²/Iⱼ, Ṁ = \[M, ∂H/∂M\].
///
/// The spectrum of M is constant: Casimirs of degree 2 and 3. Dimensionless.
/// V. I. Arnold, Ann. Inst. Fourier 16 (1966) 319.
#[lie_poisson(group = SU3, truncation = 3)]
pub fn su3_body(mu: [f64; 8], inertia: [f64; 8]) -> f64 {
    let mut twice = 0.0;
    for i in 0..8 {
        twice += mu[i] * mu[i] / inertia[i];
    }
    twice / 2.0
}

/// The resonant three-wave interaction: q̇₁ = s₁q₃q̄₂, q̇₂ = s₂q₃q̄₁, q̇₃ = −(s₁ + s₂)q₁q₂.
///
/// M₁₂ = q₁, M₂₃ = q₂, M₁₃ = q₃, diagonal zero; H = ½ (f₁|q₁|² + f₂|q₂|² + f₃|q₃|²) with
/// s₁ = f₃ − f₂, s₂ = f₁ − f₃ in 1/time, the parameters being f₁, f₂, f₃. Manley–Rowe:
/// |q₁|²/s₁ − |q₂|²/s₂ and |q₁|²/s₁ + |q₃|²/(s₁ + s₂) are integrals.
/// M. S. Alber, G. G. Luther, J. E. Marsden, J. M. Robbins, Physica D 123 (1998) 271.
#[lie_poisson(group = SU3, truncation = 3)]
pub fn three_wave_interaction(mu: [f64; 8], f: [f64; 3]) -> f64 {
    let [x1, y1, x3, y3, x2, y2, _, _] = mu;
    0.5 * (f[0] * (x1 * x1 + y1 * y1) + f[1] * (x2 * x2 + y2 * y2) + f[2] * (x3 * x3 + y3 * y3))
}

/// Zeitlin's truncation of two-dimensional ideal flow on a torus, N = 3: H = ½ Σ |ω_m|²/|m|².
///
/// The modes are ω_m = tr(M T_m†)/√3 with the clock and shift matrices T_m, m₁, m₂ = −1, 0, 1; so on
/// each diagonal H is a circulant form with the coefficients Σ_m₁ cos(2πm₁n/3)/(m₁² + m₂²): 2 and
/// ½ off the main diagonal. Dimensionless. V. Zeitlin, Physica D 49 (1991) 353.
#[lie_poisson(group = SU3, truncation = 3)]
pub fn zeitlin_vorticity_3(mu: [f64; 8]) -> f64 {
    let [r12, q12, r13, q13, r23, q23, h1, h2] = mu;
    // The entries of the first diagonal: M₁₂, M₂₃, M₃₁ = −M̄₁₃.
    let squares = r12 * r12 + q12 * q12 + r23 * r23 + q23 * q23 + r13 * r13 + q13 * q13;
    let neighbours = r12 * r23 + q12 * q23 - r23 * r13 + q23 * q13 - r13 * r12 + q13 * q12;
    // Main diagonal, Σ dᵢ = 0: |ω₍₁,₀₎|² = ⅓ (Σ dᵢ² − Σ dᵢdᵢ₊₁) = ½ Σ dᵢ².
    let (d1, d2, d3) =
        ((4.0 * h1 + 2.0 * h2) / 3.0, (2.0 * h2 - 2.0 * h1) / 3.0, (-2.0 * h1 - 4.0 * h2) / 3.0);
    let diagonal = d1 * d1 + d2 * d2 + d3 * d3;
    diagonal / 2.0 + (2.0 * squares + neighbours) / 3.0
}

/// Zeitlin's truncation of two-dimensional ideal flow on a torus, N = 5, modes m₁, m₂ = −2 … 2:
/// H = ½ Σ |ω_m|²/|m|², ω_m = tr(M T_m†)/√5.
///
/// su(5)* as su(3)* above: Re M_ab, Im M_ab for a < b in lexicographic order, then ½(d_a − d_a+1). On
/// the m₂-th diagonal H is a circulant form with the coefficients
/// Σ_m₁ cos(2πm₁n/5)/(m₁² + m₂²), cos 72° = (√5 − 1)/4. Casimirs tr Mᵏ, k = 2 … 5: the vorticity's
/// moments. Dimensionless. V. Zeitlin, Physica D 49 (1991) 353.
#[lie_poisson(group = SU5, truncation = 3)]
pub fn zeitlin_vorticity_5(mu: [f64; 24]) -> f64 {
    let root = 2.2360679774997896964;
    let [r12, q12, r13, q13, r14, q14, r15, q15, r23, q23, r24, q24, ..] = mu;
    let [.., r25, q25, r34, q34, r35, q35, r45, q45, h1, h2, h3, h4] = mu;
    // Entries below the main diagonal: M_ba = −M̄_ab.
    let first = [[r12, q12], [r23, q23], [r34, q34], [r45, q45], [-r15, q15]];
    let second = [[r13, q13], [r24, q24], [r35, q35], [-r14, q14], [-r25, q25]];
    // 5/2 of the main diagonal.
    let top = 4.0 * h1 + 3.0 * h2 + 2.0 * h3 + h4;
    let main = [
        top,
        top - 5.0 * h1,
        top - 5.0 * (h1 + h2),
        top - 5.0 * (h1 + h2 + h3),
        top - 5.0 * (h1 + h2 + h3 + h4),
    ];
    let mut energy = 0.0;
    for a in 0..5 {
        let (b, c) = ((a + 1) % 5, (a + 2) % 5);
        for part in 0..2 {
            let [x, y, z] = [first[a][part], first[b][part], first[c][part]];
            energy += 12.0 / 25.0 * x * x
                + (13.0 + 3.0 * root) / 50.0 * x * y
                + (13.0 - 3.0 * root) / 50.0 * x * z;
            let [x, y, z] = [second[a][part], second[b][part], second[c][part]];
            energy += 9.0 / 50.0 * x * x
                + (7.0 + 3.0 * root) / 200.0 * x * y
                + (7.0 - 3.0 * root) / 200.0 * x * z;
        }
        let [x, y, z] = [main[a], main[b], main[c]];
        energy +=
            x * x / 25.0 + (3.0 * root - 5.0) / 250.0 * x * y - (3.0 * root + 5.0) / 250.0 * x * z;
    }
    energy
}
