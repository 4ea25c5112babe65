//! Every mistake is reported at once, at its place.
use coadjoint::lie_poisson;

#[lie_poisson(group = SO3, truncation = 4, chart = expo)]
fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    mu[0] * mu[0] / inertai[0] + mu[1].sin() + mu[2].abs()
}

fn main() {
    // The function and the integrator's name stay usable: no further errors.
    let _ = Body::new(0.1, [1.0, 2.0, 3.0]);
}
