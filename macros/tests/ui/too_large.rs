use coadjoint::lie_poisson;

#[lie_poisson(group = SO3, truncation = 31)]
fn too_large(mu: [f64; 3], a: [f64; 10]) -> f64 {
    let [x, y, z] = mu;
    a[0] * x * x * x + a[1] * x * x * y + a[2] * x * y * y + a[3] * y * y * y + a[4] * z * z * z
        + a[5] * z * z * x + a[6] * x * y * z + a[7] * x * x + a[8] * y * y + a[9] * z * z
}

fn main() {}
