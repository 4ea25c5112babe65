//! `frame = comoving`: what is uniform in a motion follows each step, and the series knows nothing of it.
#![allow(clippy::unwrap_used)]

use coadjoint::generating::Reversed;
use coadjoint::lanes::ensemble;
use coadjoint::nalgebra::{SVector, Vector3, Vector6};
use coadjoint::steps::{advance, poisson_map};
use coadjoint::{GeneratingFunction, LieGroup, Phase, SE3, SO3, StepError, laws, lie_poisson};
use coadjoint_codegen::system::{Options, read};
use coadjoint_tests::matrix_free::MatrixFree;
use coadjoint_tests::reference::{end_state, numbers};

/// A free symmetric body. S₃ vanishes, which K = 1 would not tell.
#[lie_poisson(group = SO3, truncation = 3, frame = comoving)]
fn dumbbell(mu: [f64; 3], transverse: f64, axial: f64) -> f64 {
    let [x, y, z] = mu;
    (x * x + y * y) / (2.0 * transverse) + z * z / (2.0 * axial)
}

/// A symmetric top in a frame that turns about its axis: a linear term, too.
#[lie_poisson(group = SE3, truncation = 7, frame = comoving)]
fn top(mu: [f64; 6], transverse: f64, axial: f64, weight: f64, frame: f64) -> f64 {
    let [x, y, z, _, v, _] = mu;
    (x * x + z * z) / (2.0 * transverse) + y * y / (2.0 * axial) + weight * v - frame * y
}

/// `top` in the fixed frame.
#[lie_poisson(group = SE3, truncation = 7)]
fn whole(mu: [f64; 6], transverse: f64, axial: f64, weight: f64, frame: f64) -> f64 {
    let [x, y, z, _, v, _] = mu;
    (x * x + z * z) / (2.0 * transverse) + y * y / (2.0 * axial) + weight * v - frame * y
}

/// `top` with a short series, which takes less to compile in lanes and for the laws.
#[lie_poisson(group = SE3, truncation = 3, frame = comoving)]
fn short(mu: [f64; 6], transverse: f64, axial: f64, weight: f64, frame: f64) -> f64 {
    let [x, y, z, _, v, _] = mu;
    (x * x + z * z) / (2.0 * transverse) + y * y / (2.0 * axial) + weight * v - frame * y
}

/// A free body, in the frame that turns along with it, as far as that is uniform.
#[lie_poisson(group = SO3, truncation = 11, frame = comoving)]
fn wobble(mu: [f64; 3], inverse: [f64; 3]) -> f64 {
    0.5 * (inverse[0] * mu[0] * mu[0] + inverse[1] * mu[1] * mu[1] + inverse[2] * mu[2] * mu[2])
}

/// `wobble` in the fixed frame.
#[lie_poisson(group = SO3, truncation = 11)]
fn tumbling(mu: [f64; 3], inverse: [f64; 3]) -> f64 {
    0.5 * (inverse[0] * mu[0] * mu[0] + inverse[1] * mu[1] * mu[1] + inverse[2] * mu[2] * mu[2])
}

/// A body in a fluid that is symmetric: both a spin and a Casimir move the frame.
#[lie_poisson(group = SE3, truncation = 3, frame = comoving)]
fn torpedo(mu: [f64; 6], inertia: [f64; 2], mass: [f64; 2]) -> f64 {
    let [x, y, z, u, v, w] = mu;
    (x * x + y * y) / (2.0 * inertia[0])
        + z * z / (2.0 * inertia[1])
        + (u * u + v * v) / (2.0 * mass[0])
        + w * w / (2.0 * mass[1])
}

/// `torpedo` in the fixed frame.
#[lie_poisson(group = SE3, truncation = 5)]
fn torpedo_at_rest(mu: [f64; 6], inertia: [f64; 2], mass: [f64; 2]) -> f64 {
    let [x, y, z, u, v, w] = mu;
    (x * x + y * y) / (2.0 * inertia[0])
        + z * z / (2.0 * inertia[1])
        + (u * u + v * v) / (2.0 * mass[0])
        + w * w / (2.0 * mass[1])
}

/// Two symmetric bodies with their axes coupled: both spins are integrals.
#[lie_poisson(group = SO3 * SO3, truncation = 1, frame = comoving)]
fn pair(mu: [f64; 6], transverse: f64, axial: [f64; 2]) -> f64 {
    let [a, b, c, d, e, f] = mu;
    (a * a + b * b + d * d + e * e) / (2.0 * transverse)
        + c * c / (2.0 * axial[0])
        + f * f / (2.0 * axial[1])
        + c * f / 3.0
}

const MU: [f64; 6] = [0.3, -1.7, 0.8, 0.2, 0.9, -0.4];

/// A top that spins slowly: the moments of inertia, the weight, and the rate of the frame.
const SLOW: [f64; 4] = [0.9, 0.7, 0.6, 0.4];

fn slow(step: f64) -> Result<Short, StepError> {
    let [transverse, axial, weight, frame] = SLOW;
    Short::new(step, transverse, axial, weight, frame)
}

#[test]
fn a_free_symmetric_body_is_exact_however_long_the_step() -> Result<(), StepError> {
    let (transverse, axial) = (2.0, 0.3);
    let start = Vector3::new(0.6, -0.3, 1.1);
    // The spherical rest turns by at most a half turn in a step; the spin, by as much as it likes.
    for step in [0.1, 1.0, 4.5] {
        let mut body = Phase::<SO3>::at_identity(start);
        Dumbbell::new(step, transverse, axial)?.advance_by(&mut body, 3)?;
        // g(t) = exp(t Π/I₁)·exp(t (1/I₃ − 1/I₁) Π₃ e₃), the solution in Euler's angles.
        let time = 3.0 * step;
        let group = SO3::new();
        let nutation = group.exp(&(start * (time / transverse)));
        let spin = Vector3::z() * (time * (1.0 / axial - 1.0 / transverse) * start.z);
        let exact = group.compose(&nutation, &group.exp(&spin));
        let angle = body.group_element.angle_to(&exact);
        assert!(angle < 1e-14 * (1.0 + 10.0 * step), "{step}: {angle:e}");
        let momentum = group.coadjoint(&group.inverse(&exact), &start);
        assert!((body.momentum - momentum).amax() < 1e-14 * (1.0 + 10.0 * step));
    }
    Ok(())
}

/// Brüls' top spins at 150 rad/s; its axis moves at 7 rad/s, and steps need only follow that.
#[test]
fn a_fast_top_takes_steps_of_its_nutation() -> Result<(), StepError> {
    let entry = end_state("heavy top (Bruels)");
    let start = SVector::<f64, 6>::from_vec(numbers(&entry.momentum0));
    let end = SVector::<f64, 6>::from_vec(numbers(&entry.momentum));
    let element: Vec<f64> = entry.group_element.iter().flat_map(|row| numbers(row)).collect();
    let mut errors = Vec::new();
    for steps in [25, 50] {
        let step = Top::new(1.0 / steps as f64, 15.234_375, 0.468_75, 147.15, 0.0)?;
        let mut top = Phase::<SE3>::at_identity(start);
        step.advance_by(&mut top, steps)?;
        let group = SE3::new();
        let entries = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        let attitude = entries
            .map(|(i, j)| {
                let own = group.matrix_entry(&top.group_element, i, j);
                (own - element[4 * i + j]).abs()
            })
            .fold(0.0, f64::max);
        errors.push((top.momentum - end).amax() / 100.0 + attitude);
    }
    println!("{errors:?}");
    assert!(errors[1] < 1e-10, "{errors:?}");
    // Order 8.
    assert!((errors[0] / errors[1]).log2() > 7.5, "{errors:?}");
    Ok(())
}

const INVERSE: [f64; 3] = [1.0 / 1.5, 0.5, 0.4];

/// The distance of two bodies, in momentum and attitude.
fn apart(a: &Phase<SO3>, b: &Phase<SO3>) -> f64 {
    (a.momentum - b.momentum).amax().max(a.group_element.angle_to(&b.group_element))
}

#[test]
fn a_tumbling_body_takes_steps_of_its_wobble() -> Result<(), StepError> {
    let start = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let (mut wobble, mut tumbling, mut exact) = (start.clone(), start.clone(), start);
    Wobble::new(1.25, INVERSE)?.advance_by(&mut wobble, 80)?;
    Tumbling::new(1.25, INVERSE)?.advance_by(&mut tumbling, 80)?;
    Tumbling::new(0.125, INVERSE)?.advance_by(&mut exact, 800)?;
    let (comoving, fixed) = (apart(&wobble, &exact), apart(&tumbling, &exact));
    println!("{comoving:e} {fixed:e}");
    assert!(comoving < 1e-8 && comoving < fixed / 1e3, "{comoving:e} {fixed:e}");
    Ok(())
}

/// Parameters may make the rest vanish: a ball only moves with the frame.
#[test]
fn a_ball_is_exact() -> Result<(), StepError> {
    let start = Vector3::new(2.0, 0.5, 1.0);
    let mut ball = Phase::<SO3>::at_identity(start);
    Wobble::new(3.0, [0.7; 3])?.advance_by(&mut ball, 4)?;
    let exact = SO3::new().exp(&(start * (12.0 * 0.7)));
    assert!(ball.group_element.angle_to(&exact) < 1e-13);
    assert!((ball.momentum - start).amax() < 1e-14);
    Ok(())
}

#[test]
fn a_spin_and_a_casimir_move_one_frame() -> Result<(), StepError> {
    let (inertia, mass) = ([0.7, 0.4], [2.0, 1.1]);
    let step = Torpedo::new(0.05, inertia, mass)?;
    // The Casimir |P|² leaves one square of the masses, the spin an isotropic inertia.
    let momentum = Vector6::from(MU);
    assert!(step.frame(1, &momentum).is_some() && step.frame(2, &momentum).is_none());
    let mut exact = Phase::<SE3>::at_identity(MU);
    TorpedoAtRest::new(0.005, inertia, mass)?.advance_by(&mut exact, 2000)?;
    let error = |steps: u32| -> Result<f64, StepError> {
        let mut found = Phase::<SE3>::at_identity(MU);
        Torpedo::new(10.0 / f64::from(steps), inertia, mass)?
            .advance_by(&mut found, steps.into())?;
        let (a, b) = (&found.group_element, &exact.group_element);
        let moved = (a.translation.vector - b.translation.vector).amax();
        let turned = a.rotation.angle_to(&b.rotation);
        Ok((found.momentum - exact.momentum).amax().max(moved).max(turned))
    };
    let (coarse, fine) = (error(200)?, error(400)?);
    println!("{coarse:e} {fine:e}");
    // Order 4, and attitude and place are right, too.
    assert!(fine < 1e-6 && (coarse / fine).log2() > 3.5, "{coarse:e} {fine:e}");
    let points = [Phase::at_identity(MU), Phase::at_identity(MU.map(|m| 0.7 - m))];
    for law in laws::check(&step, Some(&Torpedo::new(-0.05, inertia, mass)?), &points)? {
        assert!(law.pass(), "{law:?}");
    }
    Ok(())
}

#[test]
fn it_is_the_same_flow_as_without() -> Result<(), StepError> {
    let (mut split, mut straight) = (Phase::<SE3>::at_identity(MU), Phase::at_identity(MU));
    let [transverse, axial, weight, frame] = SLOW;
    let step = Top::new(0.01, transverse, axial, weight, frame)?;
    step.advance_by(&mut split, 300)?;
    Whole::new(0.01, transverse, axial, weight, frame)?.advance_by(&mut straight, 300)?;
    assert!((split.momentum - straight.momentum).amax() < 1e-12);
    let (a, b) = (split.group_element, straight.group_element);
    assert!(a.rotation.angle_to(&b.rotation) < 1e-12);
    assert!((a.translation.vector - b.translation.vector).amax() < 1e-12);
    // The energy is that of the whole Hamiltonian.
    let energy = whole(MU, transverse, axial, weight, frame);
    assert!((step.energy(&MU.into()) - energy).abs() < 1e-15);
    Ok(())
}

#[test]
fn every_law_holds() -> Result<(), StepError> {
    let (forward, backward) = (slow(0.3)?, slow(-0.3)?);
    let group = SE3::new();
    let point =
        |shift: f64| Phase::new(group.exp(&(Vector6::from(MU) * shift)), MU.map(|m| m - shift));
    for law in laws::check(&forward, Some(&backward), &[point(0.2), point(-0.4)])? {
        assert!(law.pass(), "{law:?}");
    }
    Ok(())
}

#[test]
fn every_way_to_step_moves_the_frame() -> Result<(), StepError> {
    let step = slow(0.2)?;
    let start = Phase::<SE3>::at_identity(MU);
    // More steps than the frame makes at once.
    let (mut one, mut many) = (start.clone(), start.clone());
    for _ in 0..300 {
        step.advance(&mut one)?;
    }
    step.advance_by(&mut many, 300)?;
    let close = |a: &Phase<SE3>, b: &Phase<SE3>| {
        (a.momentum - b.momentum).amax() < 1e-12
            && a.group_element.rotation.angle_to(&b.group_element.rotation) < 1e-12
    };
    assert!(close(&one, &many), "{one:?} {many:?}");

    let mut packed = vec![start.clone(); 11];
    assert!(ensemble::advance_all(&step, &mut packed, 300).is_empty());
    assert!(
        packed
            .iter()
            .all(|state| state.momentum == many.momentum
                && state.group_element == many.group_element),
        "lanes must equal scalars"
    );

    let mut next = start.clone();
    advance(&step, &mut next)?;
    let moved = poisson_map(&step, &start.momentum)?;
    assert!((moved - next.momentum).amax() < 1e-15);
    let back = poisson_map(&Reversed(&step), &moved)?;
    assert!((back - start.momentum).amax() < 1e-14);
    let matrix_free = poisson_map(&MatrixFree(step), &start.momentum)?;
    assert!((matrix_free - moved).amax() < 1e-14);
    Ok(())
}

#[test]
fn several_spins_are_split_off() -> Result<(), StepError> {
    let mu = SVector::<f64, 6>::from([0.4, -0.2, 0.9, 0.1, 0.7, -1.2]);
    let step = Pair::new(0.1, 1.5, [0.4, 0.6])?;
    let turn = step.frame(0, &mu).unwrap();
    for (i, (axial, own)) in [(2, (0.4, 0.9)), (5, (0.6, -1.2))] {
        assert!((turn[i] - 0.1 * (1.0 / axial - 1.0 / 1.5) * own).abs() < 1e-16, "{turn}");
    }
    assert!([0, 1, 3, 4].iter().all(|&i| turn[i] == 0.0));
    Ok(())
}

#[test]
fn where_there_is_none_a_file_is_told_so() {
    let text = "group = \"SE3\"\ncoordinates = [\"x\", \"y\", \"z\", \"u\", \"v\", \"w\"]\nhamiltonian = \"x^2 + 2*y^2 + 3*z^2 + u\"\n[integrator]\nframe = \"comoving\"\n";
    let message = read(text, Options::default()).unwrap_err().render("body.toml", text);
    assert!(message.contains("no comoving frame") && message.contains("body.toml:5"), "{message}");
    let text = text.replace("comoving", "moving");
    let message = read(&text, Options::default()).unwrap_err().render("body.toml", &text);
    assert!(message.contains("did you mean `comoving`"), "{message}");
}
