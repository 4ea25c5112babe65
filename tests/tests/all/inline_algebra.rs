//! An algebra written into the attribute, by basis and by brackets.

use coadjoint::{Phase, lie_poisson};

/// sl(2, R) by its matrices h, x, y.
#[lie_poisson(
    group = algebra(
        generators = [h, x, y],
        basis = [[[1, 0], [0, -1]], [[0, 1], [0, 0]], [[0, 0], [1, 0]]]
    ),
    truncation = 5
)]
fn by_basis(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / 4.0 + (mu[1] + mu[2]).powi(2) / 3.0 + (mu[1] - mu[2]).powi(2) / 10.0
}

/// sl(2, R) by its brackets; group elements are adjoint matrices.
#[lie_poisson(
    group = algebra(
        generators = [h, x, y],
        brackets = ["[h, x] = 2*x", "[h, y] = -2*y", "[x, y] = h"]
    ),
    truncation = 5
)]
fn by_brackets(mu: [f64; 3]) -> f64 {
    let [h, x, y] = mu;
    h * h / 4.0 + (x + y).powi(2) / 3.0 + (x - y).powi(2) / 10.0
}

/// Both are the same system: the momenta agree, and both keep momentum and the Casimir
/// μ_h² + 4 μ_x μ_y (the determinant form of sl(2)).
#[test]
fn basis_and_brackets_give_the_same_integrator() {
    let start = [0.4, 0.3, -0.5];
    let first = ByBasis::new(0.05).unwrap();
    let second = ByBrackets::new(0.05).unwrap();
    let group = ByBasisGroup::new();
    let mut a = Phase::<ByBasisGroup>::at_identity(start);
    let mut b = Phase::<ByBracketsGroup>::at_identity(start);
    let casimir = |mu: &[f64]| mu[0] * mu[0] + 4.0 * mu[1] * mu[2];
    let before = a.spatial_momentum(&group);
    for _ in 0..200 {
        first.advance(&mut a).unwrap();
        second.advance(&mut b).unwrap();
    }
    assert!((a.momentum - b.momentum).amax() < 1e-13);
    assert!((a.spatial_momentum(&group) - before).amax() < 1e-13);
    assert!((casimir(a.momentum.as_slice()) - casimir(&start)).abs() < 1e-14);
    assert!((by_basis(a.momentum.into()) - by_basis(start)).abs() < 1e-8);
    assert_eq!(by_basis(start), by_brackets(start));
}
