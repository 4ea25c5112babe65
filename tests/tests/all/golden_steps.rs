//! The committed emitted code, compiled and run against the interpreter.

#![allow(clippy::unwrap_used)]

use coadjoint::nalgebra::SVector;
use coadjoint::{GeneratingFunction, Phase, SO3, StepError};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_tests::{from_function, golden};

mod rigid_body {
    include!("../../golden/rigid_body.rs");
}
mod cayley_body {
    include!("../../golden/cayley_body.rs");
}
mod heavy_top {
    include!("../../golden/heavy_top.rs");
}
mod comoving_body {
    include!("../../golden/comoving_body.rs");
}
mod three_wave {
    include!("../../golden/three_wave.rs");
}

fn built(source: (&str, &str)) -> Integrator {
    from_function(source.0, source.1).unwrap()
}

/// Compares every function of a compiled step with the interpreter's, at a few points.
fn against_interpreter<const N: usize, S>(
    integrator: &Integrator,
    compiled: &S,
    energy: impl Fn(&SVector<f64, N>) -> f64,
    step: f64,
    parameters: &[f64],
) where
    S: GeneratingFunction,
    S::Group: coadjoint::LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    let symbols: Vec<f64> =
        integrator.problem.symbols.iter().map(|s| s.expr.evaluate(parameters)).collect();
    let slots = integrator.coefficients.fold(step, &symbols);
    let mut scratch = Vec::new();
    let mut run = |program: &coadjoint_codegen::graph::Program, p: &SVector<f64, N>| {
        let mut outputs = vec![f64::NAN; program.outputs().len()];
        coadjoint_codegen::graph::run(program, p.as_slice(), &slots, &mut scratch, &mut outputs);
        outputs
    };
    for point in 0..5 {
        let p = SVector::<f64, N>::from_fn(|i, _| ((1 + point) as f64 * (1.3 + i as f64)).sin());
        let close = |compiled: f64, interpreted: f64| {
            let bound = 1e-14 * (1.0 + interpreted.abs());
            assert!((compiled - interpreted).abs() <= bound, "{compiled} {interpreted}");
        };
        close(compiled.value(&p), run(&integrator.value, &p)[0]);
        close(energy(&p), run(&integrator.energy, &p)[0]);
        let hessian = run(integrator.hessian.as_ref().unwrap(), &p);
        let gradient = compiled.gradient(&p);
        let (by_hessian, full) = compiled.gradient_and_hessian(&p);
        for (part, program) in integrator.frame.iter().enumerate() {
            let (own, interpreted) = (compiled.frame(part, &p).unwrap(), run(program, &p));
            (0..N).for_each(|i| close(own[i], interpreted[i]));
        }
        assert!(compiled.frame(integrator.frame.len(), &p).is_none());
        let mut entry = N;
        for i in 0..N {
            close(gradient[i], hessian[i]);
            close(by_hessian[i], hessian[i]);
            for j in i..N {
                close(full[(i, j)], hessian[entry]);
                assert_eq!(full[(i, j)], full[(j, i)]);
                entry += 1;
            }
        }
    }
}

#[test]
fn compiled_steps_equal_the_interpreter() -> Result<(), StepError> {
    let h = 0.3;
    let step = rigid_body::RigidBody::new(h)?;
    against_interpreter(&built(golden::RIGID_BODY), &step, |mu| step.energy(mu), h, &[]);

    let step = cayley_body::CayleyBody::new(h)?;
    against_interpreter(&built(golden::CAYLEY_BODY), &step, |mu| step.energy(mu), h, &[]);

    let step = heavy_top::HeavyTop::new(h, [1.5, 2.0, 2.5], 0.3, 9.81, 0.7)?;
    let parameters = [1.5, 2.0, 2.5, 0.3, 9.81, 0.7];
    against_interpreter(&built(golden::HEAVY_TOP), &step, |mu| step.energy(mu), h, &parameters);

    let step = comoving_body::ComovingBody::new(h, [1.5, 0.8], [0.9, 1.4])?;
    let (integrator, parameters) = (built(golden::COMOVING_BODY), [1.5, 0.8, 0.9, 1.4]);
    assert_eq!(integrator.frame.len(), 2);
    against_interpreter(&integrator, &step, |mu| step.energy(mu), h, &parameters);

    let step = three_wave::ThreeWave::new(h, 0.7)?;
    against_interpreter(&built(golden::THREE_WAVE), &step, |mu| step.energy(mu), h, &[0.7]);
    Ok(())
}

#[test]
fn a_group_given_by_tables_keeps_momentum_and_steps_in_time() -> Result<(), StepError> {
    let step = three_wave::ThreeWave::new(0.1, 0.7)?;
    let group = coadjoint::groups::SL2::<f64>::new();
    let mut phase = coadjoint::Phase::<coadjoint::groups::SL2>::at_identity([0.3, 0.5, -0.4]);
    let before = phase.spatial_momentum(&group);
    for _ in 0..200 {
        step.advance(&mut phase)?;
    }
    let drift = (phase.spatial_momentum(&group) - before).amax();
    assert!(drift < 1e-12, "{drift:e}");
    Ok(())
}

#[test]
fn many_steps_are_as_many_single_ones() -> Result<(), StepError> {
    let step = rigid_body::RigidBody::new(0.3)?;
    let start = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let (mut many, mut single) = (start.clone(), start.clone());
    let report = step.advance_by(&mut many, 50)?;
    let mut worst = 0.0_f64;
    for _ in 0..50 {
        worst = worst.max(step.advance(&mut single)?.residual);
    }
    assert!((many.momentum - single.momentum).amax() < 1e-14);
    assert!(many.group_element.angle_to(&single.group_element) < 1e-14);
    assert!(report.iterations == 1 && report.residual > 0.0 && report.residual <= 2.0 * worst);

    // No step changes nothing; one that fails leaves the state before it.
    let mut state = start.clone();
    assert_eq!(step.advance_by(&mut state, 0)?.iterations, 0);
    state.momentum *= 1e3;
    let before = state.clone();
    assert!(step.advance_by(&mut state, 10).is_err());
    assert_eq!(state.momentum, before.momentum);
    assert_eq!(state.group_element, before.group_element);
    Ok(())
}
