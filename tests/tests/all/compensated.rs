//! Compensated accumulation on every group that has it: the same motion, and less rounding.

use coadjoint::nalgebra::Vector6;
use coadjoint::{
    CompensatedPhase, Integrator, LieGroup, Phase, SE3, SO3, SU2, StepError, advance,
    advance_compensated, groups::CompensatedGroup, groups::Power, groups::Product, lie_poisson,
};

#[lie_poisson(group = SE3, truncation = 5)]
fn top(mu: [f64; 6]) -> f64 {
    (mu[0] * mu[0] + mu[1] * mu[1]) / 4.0 + mu[2] * mu[2] / 2.0 + mu[3]
}

#[lie_poisson(group = SO3, truncation = 5)]
fn body(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0
}

#[lie_poisson(group = SU2, truncation = 5)]
fn spinor(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0
}

#[lie_poisson(group = SO3^2, truncation = 3)]
fn spins(mu: [f64; 6]) -> f64 {
    let [a, b, c, d, e, f] = mu;
    a * d + b * e + c * f + a * a / 5.0 + d * d / 3.0
}

#[lie_poisson(group = SO3 * SE3, truncation = 3)]
fn coupled(mu: [f64; 9]) -> f64 {
    let [a, b, c, d, e, f, g, _, _] = mu;
    (a * a + b * b + c * c / 2.0 + d * d + e * e + f * f / 3.0) / 2.0 + g + (a * d + c * f) / 5.0
}

/// The largest change of the spatial momentum, relative to its largest coordinate, plain and
/// compensated; and how far the two end states are apart in momentum.
fn drifts<S>(step: &S, start: &Phase<S::Group>, steps: u32) -> Result<[f64; 3], StepError>
where
    S: Integrator,
    S::Group: CompensatedGroup + LieGroup<Scalar = f64>,
{
    let group = step.group();
    let mut plain = start.clone();
    let mut compensated = CompensatedPhase::new(group, start.clone());
    for _ in 0..steps {
        advance(step, &mut plain)?;
        advance_compensated(step, &mut compensated)?;
    }
    let compensated = compensated.into_phase();
    let dim = group.dim();
    let apart = |a: &<S::Group as LieGroup>::Vector, b: &<S::Group as LieGroup>::Vector| {
        let size = (0..dim).map(|i| b[i].abs()).fold(0.0, f64::max);
        (0..dim).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max) / size
    };
    let before = start.spatial_momentum(group);
    let drift = |phase: &Phase<S::Group>| apart(&phase.spatial_momentum(group), &before);
    let ends = apart(&plain.momentum, &compensated.momentum);
    Ok([drift(&plain), drift(&compensated), ends])
}

#[test]
fn a_top_on_se3_drifts_less() -> Result<(), StepError> {
    let start = Phase::<SE3>::new(
        SE3::new().exp(&Vector6::new(0.3, -0.2, 0.5, 1.0, 2.0, -1.0)),
        [2.0, 3.0, 4.0, 1.0, 0.0, 0.0],
    );
    let [plain, compensated, ends] = drifts(&Top::new(0.01)?, &start, 40_000)?;
    println!("{plain:e} {compensated:e} {ends:e}");
    // What is left is the rounding of x × RΓ far from the origin.
    assert!(compensated < 4e-15 && compensated < plain / 2.0, "{plain:e} {compensated:e}");
    assert!(ends < 1e-9, "{ends:e}");
    Ok(())
}

#[test]
fn so_do_rotations_and_their_double_cover() -> Result<(), StepError> {
    let mu = [2.0, 0.5, 1.0];
    let body = drifts(&Body::new(0.01)?, &Phase::<SO3>::at_identity(mu), 40_000)?;
    let spinor = drifts(&Spinor::new(0.01)?, &Phase::<SU2>::at_identity(mu), 40_000)?;
    println!("{body:?} {spinor:?}");
    for [plain, compensated, ends] in [body, spinor] {
        assert!(compensated < 1e-14 && compensated < plain / 10.0, "{plain:e} {compensated:e}");
        assert!(ends < 1e-10, "{ends:e}");
    }
    Ok(())
}

#[test]
fn so_do_products_and_powers() -> Result<(), StepError> {
    let mu = [0.6, 0.1, 0.8, -0.3, 0.8, 0.5];
    let spins = drifts(&Spins::new(0.01)?, &Phase::<Power<SO3, 2, 6>>::at_identity(mu), 4_000)?;
    let mu = [0.6, 0.1, 0.8, -0.3, 0.8, 0.5, 0.2, 0.9, 0.1];
    let start = Phase::<Product<SO3, SE3, 9>>::at_identity(mu);
    let coupled = drifts(&Coupled::new(0.01)?, &start, 4_000)?;
    println!("{spins:?} {coupled:?}");
    for [plain, compensated, ends] in [spins, coupled] {
        assert!(compensated < 1e-14 && compensated < plain / 5.0, "{plain:e} {compensated:e}");
        assert!(ends < 1e-9, "{ends:e}");
    }
    Ok(())
}
