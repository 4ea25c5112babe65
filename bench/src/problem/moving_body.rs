//! Bodies on T\*SE(3): H = ½ Σ Πᵢ²/Iᵢ + H(Γ), group element included.

use super::{Translation, VectorField, free_body};
use crate::{
    arithmetic::Vector,
    number::Number,
    state::{Rotation, State},
};

/// Π̇ = Π × Ω + Γ × V, Γ̇ = Γ × Ω, q̇ = ½ q (0, Ω), ẋ = R V with Ω = I⁻¹Π and V = ∂H/∂Γ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingBody<T> {
    /// 1/Iᵢ.
    pub inverse_inertia: Vector,
    /// H(Γ).
    pub translation: T,
}

impl<T: Translation> MovingBody<T> {
    /// The components (Π, Γ, q, x) of a state.
    #[must_use]
    pub fn pack(state: &State) -> [f64; 13] {
        let q = free_body::quaternion(&state.rotation);
        let (m, f, x) = (state.momentum, state.force, state.position);
        [m[0], m[1], m[2], f[0], f[1], f[2], q[0], q[1], q[2], q[3], x[0], x[1], x[2]]
    }

    /// The state with components (Π, Γ, q, x).
    #[must_use]
    pub fn unpack(y: &[f64; 13]) -> State {
        State {
            momentum: [y[0], y[1], y[2]],
            force: [y[3], y[4], y[5]],
            rotation: Rotation::Quaternion([y[6], y[7], y[8], y[9]]),
            position: [y[10], y[11], y[12]],
        }
    }
}

impl<T: Translation> VectorField<13> for MovingBody<T> {
    #[inline(always)]
    fn evaluate<U: Number>(&self, y: &[U; 13]) -> [U; 13] {
        let a = &self.inverse_inertia;
        let w = [y[0] * a[0], y[1] * a[1], y[2] * a[2]];
        let force = [y[3], y[4], y[5]];
        let q = [y[6], y[7], y[8], y[9]];
        let torque = self.translation.torque(&force);
        let rate = free_body::quaternion_rate(q, &w);
        let moved = self.translation.moved(&q, &force);
        [
            y[1] * (a[2] - a[1]) * y[2] + torque[0],
            y[2] * (a[0] - a[2]) * y[0] + torque[1],
            y[0] * (a[1] - a[0]) * y[1] + torque[2],
            force[1] * w[2] - force[2] * w[1],
            force[2] * w[0] - force[0] * w[2],
            force[0] * w[1] - force[1] * w[0],
            rate[0],
            rate[1],
            rate[2],
            rate[3],
            moved[0],
            moved[1],
            moved[2],
        ]
    }
}
