//! The free rigid body on T\*SO(3), attitude included.

use super::VectorField;
use crate::{
    arithmetic::{Quaternion, Vector},
    number::Number,
    state::{Rotation, State},
};

/// Π̇ = Π × I⁻¹Π and q̇ = ½ q (0, I⁻¹Π), with H = ½ Σ Πᵢ²/Iᵢ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeBody {
    /// The principal moments.
    pub inertia: Vector,
    /// Their reciprocals.
    pub inverse_inertia: Vector,
}

impl FreeBody {
    /// A body with these principal moments.
    #[must_use]
    pub fn new(inertia: Vector) -> Self {
        Self { inertia, inverse_inertia: inertia.map(f64::recip) }
    }

    /// The components (Π, q) of a state.
    #[must_use]
    pub fn pack(state: &State) -> [f64; 7] {
        let q = quaternion(&state.rotation);
        let m = state.momentum;
        [m[0], m[1], m[2], q[0], q[1], q[2], q[3]]
    }

    /// The state with components (Π, q).
    #[must_use]
    pub fn unpack(y: &[f64; 7]) -> State {
        Self::state([y[0], y[1], y[2]], Rotation::Quaternion([y[3], y[4], y[5], y[6]]))
    }

    /// A state without translation.
    #[must_use]
    pub fn state(momentum: Vector, rotation: Rotation) -> State {
        State { momentum, force: [0.0; 3], rotation, position: [0.0; 3] }
    }
}

/// The quaternion of a rotation; a matrix is turned into one by its trace (the initial states here are not half turns).
pub(super) fn quaternion(rotation: &Rotation) -> Quaternion {
    match rotation {
        Rotation::Quaternion(q) => *q,
        Rotation::Matrix(r) => {
            let w = 0.5 * (1.0 + r[0][0] + r[1][1] + r[2][2]).sqrt();
            let s = 0.25 / w;
            [w, s * (r[2][1] - r[1][2]), s * (r[0][2] - r[2][0]), s * (r[1][0] - r[0][1])]
        }
    }
}

/// ½ q (0, ω).
#[inline(always)]
pub(super) fn quaternion_rate<T: Number>(q: [T; 4], w: &[T; 3]) -> [T; 4] {
    let w = w.map(|component| component * 0.5);
    [
        -q[1] * w[0] - q[2] * w[1] - q[3] * w[2],
        q[0] * w[0] + q[2] * w[2] - q[3] * w[1],
        q[0] * w[1] + q[3] * w[0] - q[1] * w[2],
        q[0] * w[2] + q[1] * w[1] - q[2] * w[0],
    ]
}

impl VectorField<7> for FreeBody {
    #[inline(always)]
    fn evaluate<T: Number>(&self, y: &[T; 7]) -> [T; 7] {
        let a = &self.inverse_inertia;
        let rate =
            quaternion_rate([y[3], y[4], y[5], y[6]], &[y[0] * a[0], y[1] * a[1], y[2] * a[2]]);
        [
            y[1] * (a[2] - a[1]) * y[2],
            y[2] * (a[0] - a[2]) * y[0],
            y[0] * (a[1] - a[0]) * y[1],
            rate[0],
            rate[1],
            rate[2],
            rate[3],
        ]
    }
}
