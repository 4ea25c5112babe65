//! The tail of the series, summed for a motion: smaller errors, the same geometry.

use coadjoint::{
    Phase, SO3, StepError, generating::Reversed, lanes::F64x4, lanes::Lanes, laws, lie_poisson,
};

#[lie_poisson(group = SO3, truncation = 9)]
fn ninth(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SO3, truncation = 3)]
fn third(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

const INERTIA: [f64; 3] = [1.5, 2.0, 2.5];
const START: [f64; 3] = [2.0, 0.5, 1.0];
const TIME: f64 = 40.0;

/// The error at the end in momentum and attitude, against a step so small that rounding rules.
fn error(step: &Ninth) -> Result<f64, StepError> {
    let run = |step: &Ninth| -> Result<Phase<SO3>, StepError> {
        let mut body = Phase::<SO3>::at_identity(START);
        for _ in 0..(TIME / step.step()).round() as usize {
            step.advance(&mut body)?;
        }
        Ok(body)
    };
    let (found, exact) = (run(step)?, run(&Ninth::new(0.05, INERTIA)?)?);
    let attitude = (found.group_element.coords - exact.group_element.coords).amax();
    Ok(attitude.max((found.momentum - exact.momentum).amax()))
}

#[test]
fn errors_fall_by_more_than_five_and_the_order_stays() -> Result<(), StepError> {
    let mut tuned_errors = Vec::new();
    for h in [0.4, 0.8] {
        let plain = error(&Ninth::new(h, INERTIA)?)?;
        let tuned = error(&Ninth::tuned(h, INERTIA, [START])?)?;
        println!("h = {h}: {plain:.1e}, tuned {tuned:.1e}");
        assert!(tuned < plain / 5.0, "h = {h}: {plain:e}, tuned {tuned:e}");
        tuned_errors.push(tuned);
    }
    let order = (tuned_errors[1] / tuned_errors[0]).log2();
    assert!(order > 9.5, "{order}");
    Ok(())
}

#[test]
fn every_law_holds_for_the_tuned_map() -> Result<(), StepError> {
    let step = Ninth::tuned(0.5, INERTIA, [START, [1.2, 2.5, 0.6]])?;
    let points = [
        Phase::<SO3>::at_identity(START),
        // Far from what it was tuned to.
        Phase::<SO3>::at_identity([-0.3, 1.9, 0.8]),
    ];
    for law in laws::check(&step, None, &points)? {
        assert!(law.pass(), "{law:?}");
    }
    let mut body = points[0].clone();
    step.advance(&mut body)?;
    coadjoint::advance(&Reversed(&step), &mut body)?;
    assert!((body.momentum - points[0].momentum).amax() < 1e-14);
    Ok(())
}

#[test]
fn it_keeps_to_the_series_where_there_is_nothing_to_tell() -> Result<(), StepError> {
    let mu = START.into();
    // Too few terms; and no motion at all.
    let (plain, tuned) = (Third::new(0.2, INERTIA)?, Third::tuned(0.2, INERTIA, [START])?);
    assert_eq!(plain.poisson_map(&mu)?, tuned.poisson_map(&mu)?);
    for momenta in [vec![], vec![[0.0; 3]]] {
        let (plain, tuned) = (Ninth::new(0.2, INERTIA)?, Ninth::tuned(0.2, INERTIA, momenta)?);
        assert_eq!(plain.poisson_map(&mu)?, tuned.poisson_map(&mu)?);
    }
    Ok(())
}

#[test]
fn lanes_are_tuned_alike() -> Result<(), StepError> {
    let step = Ninth::tuned(0.5, INERTIA, [START])?;
    let packed = step.splat::<F64x4>();
    let single = step.poisson_map(&START.into())?;
    let lanes =
        packed.poisson_map(&START.map(<F64x4 as coadjoint::nalgebra::SimdValue>::splat).into())?;
    for i in 0..3 {
        let lane = <F64x4 as coadjoint::nalgebra::SimdValue>::extract(&lanes[i], 2);
        assert_eq!(lane, single[i]);
    }
    Ok(())
}

#[test]
fn a_momentum_that_is_not_finite_is_refused() {
    let refused = Ninth::tuned(0.2, INERTIA, [[f64::NAN, 0.0, 1.0]]);
    assert!(matches!(refused, Err(StepError::NonFiniteState)));
}
