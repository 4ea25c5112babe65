use coadjoint::lie_poisson;

#[lie_poisson(group = SO3)]
struct NotAFunction;

#[lie_poisson(group = SO3)]
async fn awaited<const N: usize>(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0]
}

fn main() {}
