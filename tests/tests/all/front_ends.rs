//! Attribute, build script and interpreter give one and the same integrator.

use coadjoint::nalgebra::Vector3;
use coadjoint::{GeneratingFunction, LieGroup, Phase, SO3, StepError, lie_poisson};
use coadjoint_tests::kernels::integrator;

mod built {
    include!(concat!(env!("OUT_DIR"), "/rigid_body.rs"));
}
mod brackets {
    include!(concat!(env!("OUT_DIR"), "/brackets.rs"));
}

#[lie_poisson(group = SO3, truncation = 5)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    let [x, y, z] = mu;
    x.powi(2) / (2.0 * inertia[0]) + y.powi(2) / (2.0 * inertia[1]) + z.powi(2) / (2.0 * inertia[2])
}

#[test]
fn macro_build_script_and_interpreter_agree() -> Result<(), StepError> {
    let h = 0.25;
    let by_macro = RigidBody::new(h, [1.5, 2.0, 2.5])?;
    let by_script = built::RigidBody::new(h, 1.5, 2.0, 2.5)?;
    let integrator = integrator("SO3", "a^2/3 + b^2/4 + c^2/5", "exp", 5);
    let slots = coadjoint_codegen::integrator::FoldTable::new(&integrator).fold(h, &[]).unwrap();
    for p in [Vector3::new(2.0, 0.5, 1.0), Vector3::new(-0.3, 1.7, 0.2)] {
        let interpreted = Vector3::from_vec(integrator.gradient.run(p.as_slice(), &slots));
        let (a, b) = (by_macro.gradient(&p), by_script.gradient(&p));
        assert!((a - b).amax() < 1e-15, "{a} {b}");
        assert!((a - interpreted).amax() < 1e-15, "{a} {interpreted}");
    }
    let mut left = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let mut right = left.clone();
    for _ in 0..100 {
        by_macro.advance(&mut left)?;
        by_script.advance(&mut right)?;
    }
    assert!((left.momentum - right.momentum).amax() < 1e-13);
    Ok(())
}

#[test]
fn an_algebra_of_brackets_becomes_code() -> Result<(), StepError> {
    // [a, b] = b − c, [a, c] = b + c: solvable, no matrices given, elements are adjoint matrices.
    let step = brackets::Brackets::new(0.05)?;
    let group = brackets::BracketsGroup::<f64>::new();
    assert_eq!(group.dim(), 3);
    let mut phase = Phase::<brackets::BracketsGroup>::at_identity([0.4, 1.0, -0.6]);
    let before = phase.spatial_momentum(&group);
    let energy = step.energy(&phase.momentum);
    // The group is not compact: Ad*_g grows like e^{T}, and rounding in g with it.
    for _ in 0..80 {
        step.advance(&mut phase)?;
    }
    let drift = (phase.spatial_momentum(&group) - before).amax() / before.amax();
    assert!(drift < 1e-13, "spatial momentum drifted by {drift:e}");
    assert!((step.energy(&phase.momentum) - energy).abs() < 1e-6);
    Ok(())
}
