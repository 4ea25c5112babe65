//! A satellite under gravity gradient on a circular orbit, tumbling out of the orbital plane.
//!
//! Units: the orbital rate is 1, moments of inertia in multiples of the least. The potential is
//! V = 3/2 r·Ir with r the direction to the Earth in body coordinates (P. C. Hughes, *Spacecraft
//! Attitude Dynamics*, 1986, section 9.1). The radius turns with the orbit, so that V depends on
//! time; the Jacobi integral H + V − (angular momentum normal to the orbit) is conserved.
//!
//! `cargo run --release -p coadjoint --example satellite`

use coadjoint::nalgebra::{UnitQuaternion, Vector3};
use coadjoint::steps::{Kicked, Splitting};
use coadjoint::{LieGroup, Phase, SO3, lie_poisson, potential};

const INERTIA: [f64; 3] = [1.0, 1.25, 1.5];

/// The satellite's rotation without torque.
#[lie_poisson(group = SO3, truncation = 7)]
fn satellite(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

/// The potential for the direction `earth` to the Earth, in space.
#[potential(group = SO3)]
fn gravity_gradient(g: [[f64; 3]; 3], inertia: [f64; 3], earth: [f64; 3]) -> f64 {
    let mut sum = 0.0;
    for i in 0..3 {
        // The direction in body axes is gᵀ·earth.
        let r = g[0][i] * earth[0] + g[1][i] * earth[1] + g[2][i] * earth[2];
        sum += 1.5 * inertia[i] * r * r;
    }
    sum
}

/// The direction to the Earth, seen from the body.
fn nadir(time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
    attitude.inverse() * Vector3::new(time.cos(), time.sin(), 0.0)
}

fn torque(time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
    let earth = [time.cos(), time.sin(), 0.0];
    // Finite parameters cannot fail; if one were not, the step would say so.
    GravityGradient::new(INERTIA, earth)
        .map_or(Vector3::repeat(f64::NAN), |potential| potential.torque(attitude))
}

fn jacobi(time: f64, state: &Phase<SO3>) -> f64 {
    let r = nadir(time, &state.group_element);
    satellite(state.momentum.into(), INERTIA)
        + 1.5 * r.dot(&Vector3::from(INERTIA).component_mul(&r))
        - state.spatial_momentum(&SO3::new()).z
}

fn main() -> Result<(), coadjoint::StepError> {
    let orbit = std::f64::consts::TAU;
    for steps_per_orbit in [25_u32, 50, 100] {
        let h = orbit / f64::from(steps_per_orbit);
        let step = Kicked::new(Splitting::Rkn6, h, torque, |part| Satellite::new(part, INERTIA))?;
        let mut state = Phase::<SO3>::new(
            SO3::new().exp(&Vector3::new(0.3, 0.4, 0.2)),
            Vector3::new(0.1, -0.2, 1.6),
        );
        let start = jacobi(0.0, &state);
        let mut worst = 0.0_f64;
        for n in 0..100 * steps_per_orbit {
            let time = f64::from(n) * h;
            step.advance(&mut state, time)?;
            worst = worst.max((jacobi(time + h, &state) - start).abs());
        }
        println!(
            "{steps_per_orbit:4} steps per orbit, 100 orbits: Jacobi integral within {worst:.1e}"
        );
    }
    Ok(())
}
