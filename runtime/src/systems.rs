//! Systems people study, ready to integrate (feature `systems`).
//!
//! Each is the plain function of its Hamiltonian and, beside it, the integrator that
//! [`lie_poisson`] makes of it. The files of `examples/` hold the same systems
//! with numbers, and say what is known about them in closed form. Free and symmetric bodies are
//! integrated in the comoving frame.
//!
//! ```
//! use coadjoint::systems::LagrangeTop;
//! use coadjoint::{Phase, SE3};
//!
//! # fn main() -> Result<(), coadjoint::StepError> {
//! // Moments 0.5 and 0.3 kg m² about the tip, m g l = 1.2 N m.
//! let step = LagrangeTop::new(0.05, 0.5, 0.3, 1.2)?;
//! let mut top = Phase::<SE3>::at_identity([0.1, 0.0, 1.5, 0.6, 0.0, 0.8]);
//! for _ in 0..200 {
//!     step.advance(&mut top)?;
//! }
//! assert!((top.momentum[2] - 1.5).abs() < 1e-13); // Π₃ is an integral
//! # Ok(())
//! # }
//! ```
//!
//! | system | group | integrator |
//! |---|---|---|
//! | free rigid body, principal axes | SO3 | [`FreeBody`] |
//! | free rigid body, full inertia tensor | SO3 | [`FreeBodyFullInertia`] |
//! | gyrostat, dual-spin spacecraft | SO3 | [`Gyrostat`] |
//! | heavy top | SE3 | [`HeavyTop`] |
//! | Lagrange's top | SE3 | [`LagrangeTop`] |
//! | Kovalevskaya's top | SE3 | [`KovalevskayaTop`] |
//! | Goryachev–Chaplygin top | SE3 | [`GoryachevChaplyginTop`] |
//! | Kirchhoff's body in a fluid | SE3 | [`KirchhoffBody`] |
//! | Clebsch's case | SE3 | [`ClebschCase`] |
//! | Manakov's body | SO4 | [`ManakovBody`] |
//! | quadratic Hamiltonian on su(3)* | SU3 | [`Su3Body`] |
//! | three-wave interaction | SU3 | [`ThreeWaveInteraction`] |
//! | Zeitlin's vorticity, N = 3 | SU3 | [`ZeitlinVorticity3`] |
//! | Zeitlin's vorticity, N = 5 | SU5 | [`ZeitlinVorticity5`] |
//! | Heisenberg spin ring | SO3^4 | [`HeisenbergSpinRing`] |
//! | Toda's lattice, four particles | by brackets | [`TodaLattice`] |
//! | gravity gradient on a satellite, a potential | SO3 | [`GravityGradient`] |
//!
//! For tops on se(3)* the momentum is (Π, Γ): the angular momentum and the upward vertical in body axes,
//! Π̇ = Π × Ω + Γ × ∂H/∂Γ, Γ̇ = Γ × Ω (Marsden and Ratiu, *Introduction to Mechanics and Symmetry*,
//! § 15.10), with the Casimirs |Γ|² and Π·Γ. For bodies in an ideal, irrotational fluid at rest at infinity (Kirchhoff) it
//! is (Π, P): angular and linear impulse of body and fluid in body axes, Π̇ = Π × ∂H/∂Π + P × ∂H/∂P, Ṗ = P × ∂H/∂Π, with
//! the Casimirs |P|² and Π·P. su(3)* is identified with su(3) by ⟨M, ξ⟩ = −½ tr Mξ; the coordinates are Re M₁₂, Im M₁₂,
//! Re M₁₃, Im M₁₃, Re M₂₃, Im M₂₃, and ½(d₁ − d₂), ½(d₂ − d₃) for the diagonal i(d₁, d₂, d₃).

use crate::{lie_poisson, potential};

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

/// The potential of gravity on a rigid body on a circular orbit: V = 3/2 n² r·Ir, r = gᵀ·`earth`.
///
/// `inertia`: principal moments, kg m²; `rate`: the orbital rate n, 1/s; `earth`: the unit vector to
/// the Earth in space at the time of the kick. The torque is 3n² r × Ir; beside the flow of
/// [`FreeBody`] it makes a satellite, whose small pitch oscillations have the rate
/// n √(3 (I₂ − I₁)/I₃), axis 1 being the radius and 3 the orbit normal.
/// P. C. Hughes, *Spacecraft Attitude Dynamics* (1986), § 9.1.
#[potential(group = SO3)]
pub fn gravity_gradient(g: [[f64; 3]; 3], inertia: [f64; 3], rate: f64, earth: [f64; 3]) -> f64 {
    let mut sum = 0.0;
    for i in 0..3 {
        let r = g[0][i] * earth[0] + g[1][i] * earth[1] + g[2][i] * earth[2];
        sum += inertia[i] * r * r;
    }
    1.5 * rate * rate * sum
}

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
