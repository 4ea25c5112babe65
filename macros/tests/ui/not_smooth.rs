use coadjoint::lie_poisson;

#[lie_poisson(group = SO3)]
fn kink(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] + mu[0].sin().abs()
}

#[lie_poisson(group = SO3)]
fn jump(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / mu[1].max(1.0)
}

#[lie_poisson(group = SO3, truncation = 17)]
fn order(mu: [f64; 3]) -> f64 {
    mu[0].powi(-2)
}

#[lie_poisson(group = SO3, chart = cayley)]
fn chart(mu: [f64; 3]) -> f64 {
    mu[0].powf(1.5)
}

fn main() {}
