use coadjoint::lie_poisson;

#[lie_poisson(group = SO3)]
fn sine(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] + mu[0].sin()
}

#[lie_poisson(group = SO3)]
fn quotient(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / mu[1]
}

#[lie_poisson(group = SO3)]
fn negative_power(mu: [f64; 3]) -> f64 {
    mu[0].powi(-2)
}

#[lie_poisson(group = SO3)]
fn fractional_power(mu: [f64; 3]) -> f64 {
    mu[0].powf(1.5)
}

fn main() {}
