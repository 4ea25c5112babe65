//! The attribute `lie_poisson` on Hamiltonians that are no polynomials: steps by collocation.
#![allow(clippy::unwrap_used)]

use coadjoint::collocation::Collocation;
use coadjoint::nalgebra::{Vector3, Vector6};
use coadjoint::{Phase, SE3, SO3, StepError, lie_poisson};

/// A body at speeds near that of light.
#[lie_poisson(group = SO3)]
fn relativistic(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
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

/// A twist about the third axis whose rate grows; the time is not the last argument.
#[lie_poisson(group = SO3, truncation = 9, time = s)]
fn twist(mu: [f64; 3], s: f64, rate: f64) -> f64 {
    0.5 * mu[2] * mu[2] * (rate * s).exp()
}

/// ∂H/∂μ stays on the third axis, and turns μ backwards by its integral.
#[test]
fn the_time_is_an_argument_of_steps() {
    let (rate, start) = (0.3, [0.8, -0.5, 1.2]);
    let mut steps = Twist::new(0.1, rate).unwrap();
    let mut phase = Phase::<SO3>::at_identity(start);
    steps.advance_by(&mut phase, 0.0, 30).unwrap();
    steps.advance(&mut phase, 3.0).unwrap();
    let angle = 1.2 * ((rate * 3.1).exp() - 1.0) / rate;
    let (sin, cos) = angle.sin_cos();
    let expected = Vector3::new(0.8 * cos - 0.5 * sin, -0.8 * sin - 0.5 * cos, 1.2);
    assert!((phase.momentum - expected).norm() < 1e-12, "{}", phase.momentum - expected);
    let energy = steps.energy(3.1, &phase.momentum);
    assert!((energy - twist(expected.into(), 3.1, rate)).abs() < 1e-14);
}

#[test]
fn steps_are_those_of_closures() {
    let inertia = [1.5, 2.0, 2.5];
    let omega = Vector3::from(inertia).map(|inertia| 1.0 / inertia);
    let root = move |mu: &Vector3<f64>| (1.0 + mu.dot(&mu.component_mul(&omega))).sqrt();
    let energy = (
        move |_: f64, mu: &Vector3<f64>| root(mu),
        move |_: f64, mu: &Vector3<f64>| mu.component_mul(&omega) / root(mu),
    );
    let mut expected = Collocation::<_, _, 4>::new(SO3::new(), energy, 0.2).unwrap();
    let mut steps = Relativistic::new(0.2, inertia).unwrap();
    assert_eq!((Relativistic::ORDER, Relativistic::TRUNCATION), (8, 7));
    let start = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let (mut phase, mut other) = (start.clone(), start.clone());
    let before = steps.energy(&phase.momentum);
    assert!((before - root(&phase.momentum)).abs() < 1e-15);
    steps.advance_by(&mut phase, 500).unwrap();
    expected.advance_by(&mut other, 0.0, 500).unwrap();
    assert!((phase.momentum - other.momentum).norm() < 1e-12);
    let [a, b, c] = inertia;
    let (mut steps, mut other) = (fast_body::FastBody::new(0.2, a, b, c).unwrap(), start.clone());
    steps.advance_by(&mut other, 500).unwrap();
    assert!((phase.momentum - other.momentum).norm() < 1e-12);
    assert!((steps.energy(&phase.momentum) - before).abs() < 1e-11);
    let spatial = |phase: &Phase<SO3>| phase.spatial_momentum(&SO3::new());
    assert!((spatial(&phase) - spatial(&start)).norm() < 1e-13);
}

#[test]
fn order_is_the_truncation_and_one() {
    let end = |steps: u64| {
        let mut step = SixVariables::new(2.0 / steps as f64, 0.7).unwrap();
        let mut phase = Phase::<SE3>::at_identity([0.4, -0.5, 1.1, 0.3, 0.2, -0.9]);
        step.advance_by(&mut phase, steps).unwrap();
        phase.momentum
    };
    let exact: Vector6<f64> = end(64);
    let errors = [4, 8].map(|steps| (end(steps) - exact).norm());
    let order = (errors[0] / errors[1]).log2();
    assert!((order - SixVariables::ORDER as f64).abs() < 0.5, "{order}");
}

#[test]
fn refusals_name_the_expression_and_leave_the_state() {
    let mut steps = Well::new(0.1, 1.0).unwrap();
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
