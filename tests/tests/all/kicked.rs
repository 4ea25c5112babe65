//! Kicks composed with generated flows: order, symplecticity, and a satellite in orbit.
#![allow(clippy::unwrap_used)]

use coadjoint::generating::PolynomialFunction;
use coadjoint::groups::Exponential;
use coadjoint::laws::{measured_order, symplectic_defect_of};
use coadjoint::steps::{Kicked, Splitting};
use coadjoint::{LieGroup, Phase, SO3, StepError};
use coadjoint_codegen::hamilton_jacobi::{GeneratingSeries, TermLimit, derive};
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_tests::bridge::series_function;
use nalgebra::{UnitQuaternion, Vector3};

use crate::potential;

const INERTIA: [f64; 3] = [1.0, 1.25, 1.5];
type Attitude = UnitQuaternion<f64>;
type Flow = PolynomialFunction<SO3, Exponential>;
type Torque = fn(f64, &Attitude) -> Vector3<f64>;

/// The torque below, and the one derived from the potential of a satellite.
const TORQUES: [Torque; 2] = [torque, potential::torque];

/// S₁ … S₇ of the free body, with a quartic term for a Hamiltonian that is not quadratic.
fn series(quartic: bool) -> GeneratingSeries {
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let mut terms = vec![
        (vec![2, 0, 0], ratio(1, 2)),
        (vec![0, 2, 0], ratio(2, 5)),
        (vec![0, 0, 2], ratio(1, 3)),
    ];
    if quartic {
        terms.push((vec![1, 0, 3], ratio(1, 20)));
    }
    let h = Polynomial::from_terms(3, terms);
    derive(&lookup("SO3").unwrap(), Chart::Exponential, &h, 7, TermLimit::default()).unwrap()
}

fn flow(series: &GeneratingSeries, h: f64) -> Result<Flow, StepError> {
    Ok(series_function(SO3::new(), Exponential, series, h).unwrap())
}

/// The body torque of V = c·(third axis in body coordinates) plus a quadratic in it, which no
/// symmetry simplifies, with a part that changes in time.
fn torque(time: f64, attitude: &Attitude) -> Vector3<f64> {
    let up = attitude.inverse() * Vector3::z();
    let slope = Vector3::new(0.3, -0.2, 0.8)
        + up.component_mul(&Vector3::new(0.2, 0.5, -0.4))
        + Vector3::new(0.1 * time.cos(), 0.0, 0.0);
    // V(up): up changes by up×ξ, so dV·ξ = slope·(up×ξ) and the torque is up×slope.
    up.cross(&slope)
}

fn start() -> Phase<SO3> {
    Phase::new(SO3::new().exp(&Vector3::new(0.4, -0.7, 0.2)), Vector3::new(0.7, -0.4, 0.9))
}

#[track_caller]
fn has_its_order(splitting: Splitting, series: &GeneratingSeries, torque: Torque, steps: u32) {
    let order = measured_order(&SO3::new(), &start(), 2.0, steps, |h, steps, state| {
        let step = Kicked::new(splitting, h, torque, |part| flow(series, part))?;
        (0..steps).try_for_each(|n| step.advance(state, f64::from(n) * h))
    });
    let (order, expected) = (order.unwrap(), splitting.order());
    assert!((order - f64::from(expected)).abs() < 0.3, "order {order:.2}, not {expected}");
}

#[test]
fn orders_for_quadratic_hamiltonians() {
    let series = series(false);
    for torque in TORQUES {
        has_its_order(Splitting::Strang, &series, torque, 40);
        has_its_order(Splitting::Rkn4, &series, torque, 16);
        has_its_order(Splitting::Rkn6, &series, torque, 6);
    }
    has_its_order(Splitting::Prk4, &series, torque, 8);
    has_its_order(Splitting::Prk6, &series, torque, 6);
}

#[test]
fn orders_for_other_hamiltonians() {
    let series = series(true);
    has_its_order(Splitting::Strang, &series, torque, 40);
    has_its_order(Splitting::Prk4, &series, torque, 8);
    has_its_order(Splitting::Prk6, &series, torque, 6);
}

#[test]
fn kicked_steps_are_symplectic() {
    fn defect(splitting: Splitting, torque: Torque) -> f64 {
        let series = series(false);
        let step = Kicked::new(splitting, 0.2, torque, |part| flow(&series, part)).unwrap();
        let mut map = |state: &mut Phase<SO3>| step.advance(state, 0.3);
        symplectic_defect_of(&SO3::new(), &start(), &mut map).unwrap().unwrap()
    }
    for defect in [defect(Splitting::Rkn4, torque), defect(Splitting::Rkn6, potential::torque)] {
        assert!(defect < 1e-10, "{defect:e}");
    }
    // A torque without potential is not, and the measure sees it.
    assert!(defect(Splitting::Rkn4, |_, g| g.inverse() * Vector3::z()) > 1e-3);
}

#[test]
fn a_failed_step_leaves_the_state() {
    let series = series(false);
    let burst = |_: f64, _: &Attitude| Vector3::repeat(f64::NAN);
    let step = Kicked::new(Splitting::Strang, 0.2, burst, |part| flow(&series, part)).unwrap();
    let mut state = Phase::<SO3>::at_identity(Vector3::new(1.0, 2.0, 3.0));
    assert!(step.advance(&mut state, 0.0).is_err());
    assert_eq!(state.momentum, Vector3::new(1.0, 2.0, 3.0));
}

/// A satellite on a circular orbit, orbital rate 1, its axis of least inertia near the radius:
/// V = 3/2 r·Ir with r the direction to the Earth in the body (P. C. Hughes, *Spacecraft Attitude
/// Dynamics*, 1986, section 9.1). In the orbital plane it librates at √(3 (I₂ − I₁)/I₃).
#[test]
fn satellite_under_gravity_gradient() {
    let series = series(false);
    let inertia = Vector3::from(INERTIA);
    let gravity = |time: f64, attitude: &Attitude| {
        let r = attitude.inverse() * Vector3::new(time.cos(), time.sin(), 0.0);
        r.cross(&inertia.component_mul(&r)) * 3.0
    };
    let h = 0.02;
    let step = Kicked::new(Splitting::Rkn4, h, gravity, |part| flow(&series, part)).unwrap();

    // A small pitch, at rest in the orbiting frame.
    let pitch = 1e-3;
    let mut state = Phase::new(
        SO3::new().exp(&Vector3::new(0.0, 0.0, pitch)),
        Vector3::new(0.0, 0.0, INERTIA[2]),
    );
    let pitch_of = |state: &Phase<SO3>, time: f64| {
        let axis = state.group_element * Vector3::x();
        let angle = axis.y.atan2(axis.x) - time;
        angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
    };
    let mut previous = pitch;
    let mut crossings = Vec::new();
    for n in 1..=1500_u32 {
        let before = f64::from(n - 1) * h;
        step.advance(&mut state, before).unwrap();
        let now = pitch_of(&state, before + h);
        if previous > 0.0 && now <= 0.0 {
            crossings.push(before + h * previous / (previous - now));
        }
        previous = now;
    }
    let period = (crossings.last().unwrap() - crossings[0]) / (crossings.len() - 1) as f64;
    let rate = (3.0 * (INERTIA[1] - INERTIA[0]) / INERTIA[2]).sqrt();
    let expected = std::f64::consts::TAU / rate;
    assert!((period / expected - 1.0).abs() < 1e-5, "{period} against {expected}");

    // A large motion out of the plane: the Jacobi integral H + V − (momentum normal to the orbit)
    // stays within what order 4 allows.
    let jacobi = |state: &Phase<SO3>, time: f64| {
        let r = state.group_element.inverse() * Vector3::new(time.cos(), time.sin(), 0.0);
        let mu = state.momentum;
        0.5 * mu.component_div(&inertia).dot(&mu) + 1.5 * r.dot(&inertia.component_mul(&r))
            - state.spatial_momentum(&SO3::new()).z
    };
    let drift = |h: f64| {
        let step = Kicked::new(Splitting::Rkn4, h, gravity, |part| flow(&series, part)).unwrap();
        let mut state =
            Phase::new(SO3::new().exp(&Vector3::new(0.3, 0.4, 0.2)), Vector3::new(0.1, -0.2, 1.6));
        let start = jacobi(&state, 0.0);
        let steps = (20.0 / h).round() as u32;
        (0..steps).fold(0.0_f64, |worst, n| {
            let time = f64::from(n) * h;
            step.advance(&mut state, time).unwrap();
            worst.max((jacobi(&state, time + h) - start).abs())
        })
    };
    let (coarse, fine) = (drift(0.1), drift(0.05));
    assert!(coarse < 1e-4, "{coarse:e}");
    assert!((coarse / fine).log2() > 3.5, "{coarse:e} {fine:e}");
}
