//! The attribute on the runtime's closed-form groups.
#![allow(clippy::unwrap_used)]

use coadjoint::groups::{Heisenberg, Product, SE2};
use coadjoint::solve::Integrator;
use coadjoint::steps::{Drift, Monitor, advance};
use coadjoint::{LieGroup, Phase, SO3, lie_poisson};
use nalgebra::{SVector, Vector3};

/// A planar body in an ideal fluid.
#[lie_poisson(group = SE2, truncation = 7)]
fn planar_body(mu: [f64; 3], inertia: f64, mass: [f64; 2]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia + mu[1] * mu[1] / mass[0] + mu[2] * mu[2] / mass[1])
}

/// A spin with a quartic anisotropy.
#[lie_poisson(group = SU2, truncation = 5)]
fn spin(mu: [f64; 3], field: f64) -> f64 {
    mu[0].powi(2) / 3.0 + mu[1].powi(4) / 8.0 + field * mu[2]
}

#[lie_poisson(group = SO3^2, truncation = 3)]
fn spins(mu: [f64; 6], coupling: f64) -> f64 {
    coupling * (mu[0] * mu[3] + mu[1] * mu[4] + mu[2] * mu[5]) + mu[2] * mu[2] / 3.0
}

/// The state after this many steps, and the drift on the way.
fn drift<S: Integrator, const N: usize>(
    step: &S,
    energy: impl Fn([f64; N]) -> f64,
    start: [f64; N],
    steps: u32,
) -> (Phase<S::Group>, Drift<f64>)
where
    S::Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    let mut state = Phase::<S::Group>::new(step.group().identity(), start);
    let energy = |state: &Phase<S::Group>| energy(state.momentum.into());
    let mut monitor = Monitor::new(step.group().clone(), &state, energy(&state));
    for _ in 0..steps {
        advance(step, &mut state).unwrap();
        monitor.observe(&state, energy(&state));
    }
    let drift = monitor.drift();
    (state, drift)
}

#[test]
fn coupled_spins_conserve() {
    let step = Spins::new(0.05, 0.8).unwrap();
    let start = [0.4, 0.8, -0.3, 0.1, 0.2, 0.9];
    let (state, drift) = drift(&step, |mu| spins(mu, 0.8), start, 1000);
    assert!(drift.spatial_momentum < 1e-13 && drift.casimirs < 1e-13, "{drift:?}");
    assert!(drift.energy < 1e-6, "{drift:?}");
    // The total spin along the third axis commutes with both terms.
    let total = state.momentum[2] + state.momentum[5];
    assert!((total - 0.6).abs() < 1e-12);
}

/// A charge in a homogeneous magnetic field of strength μ₃.
#[lie_poisson(group = Heisenberg, truncation = 7, chart = cayley)]
fn charge(mu: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] + mu[1] * mu[1])
}

#[test]
fn planar_body_conserves() {
    let step = PlanarBody::new(0.05, 1.0, [1.0, 2.0]).unwrap();
    let energy = |mu| planar_body(mu, 1.0, [1.0, 2.0]);
    let (state, drift) = drift(&step, energy, [0.4, 0.8, -0.3], 2000);
    // The body drifts away, and the spatial angular momentum is a difference of products with the
    // distance.
    let distance = state.group_element.translation.vector.norm().max(1.0);
    assert!(drift.spatial_momentum < 1e-13 * distance, "{drift:?}");
    assert!(drift.casimirs < 1e-13 && drift.energy < 1e-10, "{drift:?}");
}

#[test]
fn spin_conserves() {
    let step = Spin::new(0.05, 0.7).unwrap();
    let (_, drift) = drift(&step, |mu| spin(mu, 0.7), [0.4, 0.8, -0.3], 2000);
    assert!(drift.spatial_momentum < 1e-13 && drift.casimirs < 1e-13, "{drift:?}");
    assert!(drift.energy < 1e-9, "{drift:?}");
}

/// (μ₁, μ₂) turns at the rate μ₃: the end is known.
#[test]
fn charge_turns() {
    let step = Charge::new(0.1).unwrap();
    let mut state = Phase::<Heisenberg>::at_identity(Vector3::new(1.0, 0.0, 0.5));
    for _ in 0..100 {
        step.advance(&mut state).unwrap();
    }
    // μ̇₁ = −μ₂ μ₃, μ̇₂ = μ₁ μ₃
    let (sine, cosine) = 5.0_f64.sin_cos();
    let expected = Vector3::new(cosine, sine, 0.5);
    assert!((state.momentum - expected).amax() < 1e-12, "{}", state.momentum);
}

/// A body in space and one in the plane, side by side.
#[lie_poisson(group = SO3 * SE2, truncation = 5)]
fn side_by_side(mu: [f64; 6]) -> f64 {
    let [a, b, c, x, y, z] = mu;
    a * a / 2.0 + b * b / 3.0 + c * c / 4.0 + x * x / 2.0 + y * y / 2.0 + z * z / 4.0
}

#[lie_poisson(group = SO3, truncation = 5)]
fn alone(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / 2.0 + mu[1] * mu[1] / 3.0 + mu[2] * mu[2] / 4.0
}

/// The group of a product is the runtime's product of its closed forms, and without coupling each
/// factor moves as it does alone; in lanes as in scalars.
#[test]
fn a_product_moves_as_its_factors() {
    let start = [0.4, 0.8, -0.3, 0.2, -0.6, 0.5];
    let mut both = Phase::<Product<SO3, SE2, 6>>::at_identity(start);
    let mut first = Phase::<SO3>::at_identity([0.4, 0.8, -0.3]);
    let mut second = Phase::<SE2>::at_identity([0.2, -0.6, 0.5]);
    let step = SideBySide::new(0.05).unwrap();
    let one = Alone::new(0.05).unwrap();
    // Truncations 5 and 7 differ in the ninth digit here.
    let other = PlanarBody::new(0.05, 1.0, [1.0, 2.0]).unwrap();
    let (mut lanes, mut scalar) = (vec![both.clone(); 9], both.clone());
    for _ in 0..200 {
        step.advance(&mut both).unwrap();
        one.advance(&mut first).unwrap();
        other.advance(&mut second).unwrap();
    }
    assert!((both.momentum.fixed_rows::<3>(0) - first.momentum).amax() < 1e-13);
    assert!((both.momentum.fixed_rows::<3>(3) - second.momentum).amax() < 1e-8);
    assert!(both.group_element.0.angle_to(&first.group_element) < 1e-13);
    assert!(coadjoint::lanes::ensemble::advance_all(&step, &mut lanes, 200).is_empty());
    step.advance_by(&mut scalar, 200).unwrap();
    for lane in lanes {
        assert_eq!(lane.momentum, scalar.momentum);
    }
}
