//! The attribute `lie_poisson` on Hamiltonians that are no polynomials: steps by collocation.
#![allow(clippy::unwrap_used)]

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::lanes::F64x4;
use coadjoint::nalgebra::{SimdValue, Vector3};
use coadjoint::{Phase, SE3, SO3, StepError, lie_poisson};

/// A body at speeds near that of light.
#[lie_poisson(group = SO3)]
pub fn relativistic(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    let mut sum = 1.0;
    for i in 0..3 {
        sum += mu[i] * mu[i] / inertia[i];
    }
    sum.sqrt()
}

/// `relativistic`, from a system file by a build script.
mod fast_body {
    include!(concat!(env!("OUT_DIR"), "/fast_body.rs"));
}

#[lie_poisson(group = SE3, truncation = 5)]
fn six_variables(mu: [f64; 6], stiffness: f64) -> f64 {
    let [x, y, z, p, q, r] = mu;
    let root = (1.0 + x * x + 2.0 * y * y + z * z).sqrt();
    root + 1.0 / (2.0 + p * p + q * q).sqrt() + (-stiffness * r * r).exp()
}

#[lie_poisson(group = SO3, truncation = 3)]
fn well(mu: [f64; 3], height: f64) -> f64 {
    (height - mu[0]).ln() + mu[1] * mu[1] + 0.1 * mu[2].tanh()
}

/// One node, on which a step of 2 from (2, 0, 0.1) goes beyond a quarter turn.
#[lie_poisson(group = SO3, truncation = 1)]
fn one_node(mu: [f64; 3]) -> f64 {
    (1.0 + mu[0] * mu[0] + 0.999 * (mu[1] * mu[1] + mu[2] * mu[2])).sqrt()
}

/// The steps of `relativistic` by closures.
fn by_closures(h: f64) -> Collocation<SO3, impl Energy<Vector3<f64>>, 4> {
    let omega = Vector3::new(1.0 / 1.5, 0.5, 0.4);
    let root = move |mu: &Vector3<f64>| (1.0 + mu.dot(&mu.component_mul(&omega))).sqrt();
    let energy = (
        move |_: f64, mu: &Vector3<f64>| root(mu),
        move |_: f64, mu: &Vector3<f64>| mu.component_mul(&omega) / root(mu),
    );
    Collocation::new(SO3::new(), energy, h).unwrap()
}

#[test]
fn steps_are_those_of_closures() {
    let inertia = [1.5, 2.0, 2.5];
    let mut expected = by_closures(0.2);
    let steps = Relativistic::new(0.2, inertia).unwrap();
    assert_eq!((Relativistic::<f64>::ORDER, Relativistic::<f64>::TRUNCATION), (8, 7));
    let start = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let (mut phase, mut other) = (start.clone(), start.clone());
    let before = steps.energy(&phase.momentum);
    assert!((before - relativistic(phase.momentum.into(), inertia)).abs() < 1e-15);
    steps.advance_by(&mut phase, 500).unwrap();
    expected.advance_by(&mut other, 0.0, 500).unwrap();
    assert!((phase.momentum - other.momentum).norm() < 1e-12);
    let [a, b, c] = inertia;
    let (steps, mut other) = (fast_body::FastBody::new(0.2, a, b, c).unwrap(), start.clone());
    steps.advance_by(&mut other, 500).unwrap();
    assert!((phase.momentum - other.momentum).norm() < 1e-12);
    assert!((steps.energy(&phase.momentum) - before).abs() < 1e-11);
    let spatial = |phase: &Phase<SO3>| phase.spatial_momentum(&SO3::new());
    assert!((spatial(&phase) - spatial(&start)).norm() < 1e-13);
}

#[test]
fn refusals_name_the_expression_and_leave_the_state() {
    let steps = Well::new(0.1, 1.0).unwrap();
    let start = Phase::<SO3>::at_identity([1.5, 0.2, 0.3]);
    let mut phase = start.clone();
    match steps.advance(&mut phase).unwrap_err() {
        StepError::Undefined { expression, argument, time, .. } => {
            assert_eq!((expression, argument), ("ln(height - mu[0])", -0.5));
            assert!((0.0..=0.1).contains(&time));
        }
        error => panic!("{error}"),
    }
    assert_eq!(phase.momentum, start.momentum);
    let infinite = Well::new(0.1, f64::INFINITY).map(|_| ()).unwrap_err();
    assert!(matches!(infinite, StepError::InvalidParameter { name: "height", .. }), "{infinite}");
    let still = Well::new(0.0, 1.0).map(|_| ()).unwrap_err();
    assert!(matches!(still, StepError::InvalidStep { .. }), "{still}");
}

/// Steps longer than programs take are made by the runtime: those of closures to the bit, in each kind of number.
#[test]
fn refused_steps_are_those_of_the_runtime() {
    let inertia = [1.5, 2.0, 2.5];
    let start = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let (mut phase, mut other) = (start.clone(), start.clone());
    Relativistic::new(2.6, inertia).unwrap().advance(&mut phase).unwrap();
    let mut expected = by_closures(2.6);
    expected.advance(&mut other, 0.0).unwrap();
    assert!((phase.momentum - other.momentum).norm() < 1e-13);

    let mut single = Phase::<SO3<f32>>::at_identity([2.0, 0.5, 1.0]);
    let steps = Relativistic::<f32>::new(2.6, inertia.map(|i| i as f32)).unwrap();
    steps.advance(&mut single).unwrap();
    assert!((single.momentum.cast::<f64>() - phase.momentum).norm() < 1e-6);

    let four = |value: f64| F64x4::splat(value);
    let mut lanes = Phase::<SO3<F64x4>>::at_identity([2.0, 0.0, 0.1].map(four));
    OneNode::new(four(2.0)).unwrap().advance(&mut lanes).unwrap();
    let mut alone = Phase::<SO3>::at_identity([2.0, 0.0, 0.1]);
    OneNode::new(2.0).unwrap().advance(&mut alone).unwrap();
    assert_eq!(lanes.momentum.map(|entry| entry.extract(3)), alone.momentum);

    // No step is that long; a shorter one is named.
    let error = Relativistic::new(50.0, inertia).unwrap().advance(&mut phase).unwrap_err();
    let usable = error.circumstances().unwrap().usable_step.unwrap();
    Relativistic::new(usable, inertia).unwrap().advance(&mut phase).unwrap();
}

#[test]
fn numbers_of_32_bits_keep_momentum_to_their_rounding() {
    let steps = SixVariables::<f32>::new(0.1, 0.7).unwrap();
    let mut phase = Phase::<SE3<f32>>::at_identity([0.4, -0.5, 1.1, 0.3, 0.2, -0.9]);
    let spatial = phase.spatial_momentum(&SE3::new());
    let energy = steps.energy(&phase.momentum);
    steps.advance_by(&mut phase, 200).unwrap();
    assert!((phase.spatial_momentum(&SE3::new()) - spatial).norm() < 3e-5);
    assert!((steps.energy(&phase.momentum) - energy).abs() < 1e-4);
    let mut double = Phase::<SE3>::at_identity([0.4, -0.5, 1.1, 0.3, 0.2, -0.9]);
    SixVariables::new(0.1, 0.7).unwrap().advance_by(&mut double, 200).unwrap();
    let apart = phase.momentum.cast::<f64>() - double.momentum;
    assert!(apart.norm() > 0.0 && apart.norm() < 1e-3, "{apart}");
}
