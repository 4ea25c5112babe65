use coadjoint::potential;

#[potential(group = SO3)]
fn momentum_instead_of_matrix(mu: [f64; 3]) -> f64 {
    mu[2]
}

#[potential(group = SE3)]
fn matrix_of_another_size(g: [[f64; 3]; 3], weight: f64) -> f64 {
    weight * g[2][2]
}

#[potential(group = SO3)]
fn not_a_matrix(g: f64) -> f64 {
    g
}

#[potential(group = SO3)]
fn with_a_kink(g: [[f64; 3]; 3]) -> f64 {
    g[2][2].abs()
}

#[potential(group = SO3)]
fn torque_instead_of_potential(g: [[f64; 3]; 3]) -> [f64; 3] {
    [g[2][1], -g[2][0], 0.0]
}

#[potential]
fn no_group(g: [[f64; 3]; 3]) -> f64 {
    g[2][2]
}

#[potential(group = SO3, truncation = 3)]
fn unknown_key(g: [[f64; 3]; 3]) -> f64 {
    g[2][2]
}

#[potential(group = SO3)]
fn out_of_range(g: [[f64; 3]; 3]) -> f64 {
    g[3][3]
}

#[potential(group = SO3)]
fn one_index(g: [[f64; 3]; 3]) -> f64 {
    g[2]
}

fn main() {
    // The names stay usable: no further errors.
    let _ = WithAKink::<f64>::new();
}
