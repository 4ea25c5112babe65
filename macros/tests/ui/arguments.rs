use coadjoint::lie_poisson;

#[lie_poisson(group = SO4D, truncation = 3)]
fn unknown_group(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

#[lie_poisson(group = SO3, truncation = 6)]
fn even_truncation(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

#[lie_poisson(group = SO3, trunctation = 3)]
fn unknown_argument(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

#[lie_poisson(truncation = 3)]
fn no_group(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

#[lie_poisson(group = SU3, chart = cayley, truncation = 3)]
fn no_cayley(mu: [f64; 8]) -> f64 {
    mu[0] * mu[0]
}

#[lie_poisson(group = SE3, frame = comoving)]
fn no_frame(mu: [f64; 6], inertia: [f64; 3]) -> f64 {
    mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2] + mu[3]
}

#[lie_poisson(group = SO3, frame = moving)]
fn unknown_frame(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

fn main() {}
