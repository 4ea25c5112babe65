//! Forces on a body in orbit, for the kicks of [`Kicked`](crate::steps::Kicked).

use crate::potential;

/// The potential of gravity on a rigid body on a circular orbit: V = 3/2 n² r·Ir, r = gᵀ·`earth`.
///
/// `inertia`: principal moments, kg m²; `rate`: the orbital rate n, 1/s; `earth`: the unit vector to
/// the Earth in space at the time of the kick. The torque is 3n² r × Ir; beside the flow of
/// [`FreeBody`](super::FreeBody) it makes a satellite, whose small pitch oscillations have the rate
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
