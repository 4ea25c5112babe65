//! The attribute `lie_poisson`: the function beside the steps, and refusals. `codegen/tests/all/rust_bodies.rs` has bodies people write.

use coadjoint::nalgebra::Vector3;
use coadjoint::{Phase, SO3, StepError, lie_poisson};

/// Free rigid body, written out.
#[lie_poisson(group = SO3, truncation = 5)]
fn indexed(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SO3, truncation = 5)]
fn vectors(mu: Vector3<f64>, inertia: Vector3<f64>) -> f64 {
    let omega = Vector3::new(mu.x / inertia.x, mu.y / inertia.y, mu.z / inertia.z);
    0.5 * mu.dot(&omega)
}

const INERTIA: [f64; 3] = [1.5, 2.0, 2.5];
const START: [f64; 3] = [2.0, 0.5, 1.0];

#[test]
fn the_function_stays_the_energy() -> Result<(), StepError> {
    let step = Indexed::new(0.1, INERTIA)?;
    let by_function = indexed(START, INERTIA);
    assert_eq!(by_function, vectors(START.into(), INERTIA.into()));
    assert!((step.energy(&START.into()) - by_function).abs() < 1e-15);
    let by_vectors = Vectors::new(0.1, INERTIA.into())?;
    assert!((by_vectors.energy(&START.into()) - by_function).abs() < 1e-15);
    Ok(())
}

#[lie_poisson(group = SO3)]
fn pushed_in_space(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    #[velocity_in_space]
    fn turn(rate: f64) -> [f64; 3] {
        [0.0, rate, 0.0]
    }
    #[torque_in_space]
    fn push(mu: [f64; 3]) -> [f64; 3] {
        [0.1, mu[0] / 8.0, 0.3]
    }
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SO3)]
fn pushed(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    #[velocity]
    fn turn(g: [[f64; 3]; 3], rate: f64) -> [f64; 3] {
        g[1].map(|entry| rate * entry)
    }
    #[torque]
    fn push(g: [[f64; 3]; 3], mu: [f64; 3]) -> [f64; 3] {
        let mut force = [0.0; 3];
        for i in 0..3 {
            force[i] = g[0][i] / 10.0 + mu[0] * g[1][i] / 8.0 + 3.0 * g[2][i] / 10.0;
        }
        force
    }
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[test]
fn forces_in_space_are_those_of_the_body_that_turn_against_it() {
    let [mut state, mut other] = [START; 2].map(Phase::<SO3>::at_identity);
    PushedInSpace::new(0.1, INERTIA, 0.25).unwrap().advance_by(&mut state, 100).unwrap();
    Pushed::new(0.1, INERTIA, 0.25).unwrap().advance_by(&mut other, 100).unwrap();
    assert!((state.momentum - other.momentum).amax() < 1e-13, "{state:?} {other:?}");
    assert!(state.group_element.angle_to(&other.group_element) < 1e-12);
}

#[lie_poisson(group = SO3, truncation = 1)]
fn awkward(mu: [f64; 3], coefficients: f64, symbols: [[f64; 2]; 2], unused: f64) -> f64 {
    let _ = unused;
    coefficients * mu[0] * mu[0] + symbols[1][0] * mu[1] * mu[2]
}

#[test]
fn parameters_may_have_the_names_of_the_constructor() -> Result<(), StepError> {
    let built = Awkward::new(0.1, 2.0, [[0.0, 0.0], [3.0, 0.0]], 0.0)?;
    let mu = [1.0, 2.0, 3.0];
    assert_eq!(built.energy(&mu.into()), awkward(mu, 2.0, [[0.0, 0.0], [3.0, 0.0]], 0.0));
    Ok(())
}

#[test]
fn wrong_steps_and_parameters_are_refused() {
    assert!(matches!(Indexed::new(0.0, INERTIA), Err(StepError::InvalidStep { step: 0.0 })));
    assert!(matches!(Indexed::new(f64::NAN, INERTIA), Err(StepError::InvalidStep { .. })));
    let refused = Indexed::new(0.1, [1.5, 0.0, 2.5]);
    let Err(StepError::InvalidParameter { name, .. }) = refused else {
        panic!("a zero moment of inertia was accepted");
    };
    assert!(name.contains("inertia[1]"), "{name}");
}

#[test]
fn a_state_that_is_not_finite_is_refused_and_kept() -> Result<(), StepError> {
    let step = Indexed::new(0.1, INERTIA)?;
    let mut body = Phase::<SO3>::at_identity([2.0, f64::NAN, 1.0]);
    assert_eq!(step.advance(&mut body), Err(StepError::NonFiniteState));
    assert_eq!(body.momentum[0], 2.0);

    // So large a momentum that the step leaves the chart: an error, and the state is as before.
    let mut fast = Phase::<SO3>::at_identity([2e3, 5e2, 1e3]);
    let refused = step.advance(&mut fast).unwrap_err();
    // The error says a step that works.
    let usable = refused.circumstances().and_then(|at| at.usable_step).unwrap();
    assert!(Indexed::new(usable, INERTIA)?.advance(&mut fast.clone()).is_ok(), "{refused}");
    assert_eq!(fast.momentum, Vector3::new(2e3, 5e2, 1e3));
    Ok(())
}
