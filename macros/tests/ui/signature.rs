use coadjoint::lie_poisson;

#[lie_poisson(group = SE3)]
fn wrong_dimension(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

#[lie_poisson(group = SO3)]
fn out_of_range(mu: [f64; 3]) -> f64 {
    mu[3] * mu[3]
}

/// Neither group nor argument can be read.
#[lie_poisson(group = Nowhere)]
fn neither(mu: u8) -> f64 {
    0.0
}

#[lie_poisson(group = SO3)]
struct NotAFunction;

#[lie_poisson(group = SO3)]
async fn awaited<const N: usize>(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

fn main() {}
