//! Hamiltonians that are no polynomials, for the steps of collocation.

use coadjoint::collocation::Energy;
use nalgebra::{Vector3, Vector6};

/// 1/I of the bodies here, in the inverse of kg m².
pub const INVERSE_INERTIA: [f64; 3] = [1.0 / 1.5, 0.5, 0.4];

/// Momenta from which the systems on so(3)\* and se(3)\* start.
pub const THREE: [f64; 3] = [2.0, 0.5, 1.0];
pub const SIX: [f64; 6] = [0.8, -0.5, 0.6, 0.3, 0.7, -0.4];

/// √(1 + Σ wᵢ μᵢ²) + μ₂³/10: a relativistic body.
#[derive(Clone, Copy, Debug)]
pub struct Root;

/// 3/5 μ₀ + 3/10 exp(4/5 μ₂) + 1/5 exp(−μ₁/2): a spin with exponential anisotropy.
#[derive(Clone, Copy, Debug)]
pub struct Spin;

/// [`Root`] with cos(3t) and sin(2t), between the middle and the ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Modulated;

/// Six variables with 1/√ and exp.
#[derive(Clone, Copy, Debug)]
pub struct Six;

/// A heavy top with gravity between its axes.
#[derive(Clone, Copy, Debug)]
pub struct Top;

/// √(1 + Σ (i + 1) μᵢ²/n) + exp(μ₀/4)/3 in any dimension.
#[derive(Clone, Copy, Debug)]
pub struct Any;

fn root(m: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let velocity = m.component_mul(&Vector3::from(INVERSE_INERTIA));
    let root = (1.0 + velocity.dot(m)).sqrt();
    (root, velocity / root)
}

impl Energy<Vector3<f64>> for Root {
    fn value(&self, _time: f64, m: &Vector3<f64>) -> f64 {
        root(m).0 + 0.1 * m.z * m.z * m.z
    }

    #[inline]
    fn gradient(&self, _time: f64, m: &Vector3<f64>) -> Vector3<f64> {
        root(m).1 + Vector3::new(0.0, 0.0, 0.3 * m.z * m.z)
    }
}

impl Energy<Vector3<f64>> for Spin {
    fn value(&self, _time: f64, m: &Vector3<f64>) -> f64 {
        0.6 * m.x + 0.3 * (0.8 * m.z).exp() + 0.2 * (-0.5 * m.y).exp()
    }

    #[inline]
    fn gradient(&self, _time: f64, m: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(0.6, -0.1 * (-0.5 * m.y).exp(), 0.24 * (0.8 * m.z).exp())
    }
}

impl Energy<Vector3<f64>> for Modulated {
    fn value(&self, t: f64, m: &Vector3<f64>) -> f64 {
        let driven = 0.3 * (3.0 * t).cos() * m.x + 0.25 * (2.0 * t).sin() * m.y * m.y;
        root(m).0 + driven + 0.1 * m.z * m.z * m.z * t.cos()
    }

    #[inline]
    fn gradient(&self, t: f64, m: &Vector3<f64>) -> Vector3<f64> {
        let [x, y] = [0.3 * (3.0 * t).cos(), 0.5 * (2.0 * t).sin() * m.y];
        root(m).1 + Vector3::new(x, y, 0.3 * m.z * m.z * t.cos())
    }
}

impl Energy<Vector6<f64>> for Six {
    fn value(&self, _time: f64, q: &Vector6<f64>) -> f64 {
        let r = (1.0 + q[3] * q[3] + q[4] * q[4] * 2.0 / 3.0 + q[5] * q[5] * 1.5).sqrt();
        let squares = q[0] * q[0] / 3.0 + q[1] * q[1] / 4.0 + q[2] * q[2] / 5.0 + q[0] * q[3] / 7.0;
        squares + 2.0 / 3.0 / r + (q[5] / 9.0 + q[2] / 11.0).exp() * r
    }

    #[inline]
    fn gradient(&self, _time: f64, q: &Vector6<f64>) -> Vector6<f64> {
        let r = (1.0 + q[3] * q[3] + q[4] * q[4] * (2.0 / 3.0) + q[5] * q[5] * 1.5).sqrt();
        let (i, e) = (1.0 / r, (q[5] * (1.0 / 9.0) + q[2] * (1.0 / 11.0)).exp());
        let f = (e - i * i * (2.0 / 3.0)) * i;
        Vector6::new(
            q[0] * (2.0 / 3.0) + q[3] * (1.0 / 7.0),
            q[1] * 0.5,
            q[2] * 0.4 + e * r * (1.0 / 11.0),
            f * q[3] + q[0] * (1.0 / 7.0),
            f * q[4] * (2.0 / 3.0),
            f * q[5] * 1.5 + e * r * (1.0 / 9.0),
        )
    }
}

impl Energy<Vector6<f64>> for Top {
    fn value(&self, _time: f64, m: &Vector6<f64>) -> f64 {
        let squares: f64 = (0..3).map(|i| INVERSE_INERTIA[i] * m[i] * m[i]).sum();
        0.5 * squares + m[3] / 7.0 + m[5] * 2.0 / 3.0
    }

    #[inline]
    fn gradient(&self, _time: f64, m: &Vector6<f64>) -> Vector6<f64> {
        let [a, b, c] = INVERSE_INERTIA;
        Vector6::new(a * m[0], b * m[1], c * m[2], 1.0 / 7.0, 0.0, 2.0 / 3.0)
    }
}

impl<V: coadjoint::groups::Coordinates<f64>> Energy<V> for Any {
    fn value(&self, _time: f64, m: &V) -> f64 {
        let n = m.dim();
        let squares: f64 = (0..n).map(|i| (i + 1) as f64 / n as f64 * m[i] * m[i]).sum();
        (1.0 + squares).sqrt() + (m[0] / 4.0).exp() / 3.0
    }

    fn gradient(&self, _time: f64, m: &V) -> V {
        let n = m.dim();
        let weight = |i: usize| (i + 1) as f64 / n as f64 * m[i];
        let root = (1.0 + (0..n).map(|i| weight(i) * m[i]).sum::<f64>()).sqrt();
        let grows = (m[0] / 4.0).exp() / 12.0;
        V::from_entries(n, |i| weight(i) / root + if i == 0 { grows } else { 0.0 })
    }
}
