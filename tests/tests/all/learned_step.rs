//! The emitted code of a learned model, which `golden_files` compares with what is emitted now: it
//! compiles, and its steps are the model's own.
//!
//! The model, `reference/learned_body.json`, is a polynomial of degree 2 learned from 60 pairs of
//! the free body, Δt = 0.1 (`coadjoint learn pairs.csv --dt 0.1 --degree 2 --out …`).

#![allow(clippy::unwrap_used)]

use std::path::Path;

use coadjoint::groups::Exponential;
use coadjoint::nalgebra::Vector3;
use coadjoint::steps::{advance, poisson_map};
use coadjoint::{GeneratingFunction, Phase, SO3};
use coadjoint_learn::{Generating, ModelFile};

mod learned {
    include!("../../golden/learned.rs");
}

#[test]
fn the_emitted_steps_are_the_models_own() {
    let file = ModelFile::load(Path::new("reference/learned_body.json")).unwrap();
    let group = SO3::new();
    let learned = Generating::<SO3, Exponential, _>::new(group, &file.model);
    let emitted = learned::Learned::new(file.step).unwrap();
    for point in 0..5 {
        let p = Vector3::from_fn(|i, _| 1.5 * ((1 + point) as f64 * (1.3 + i as f64)).sin());
        let (gradient, hessian) = learned.gradient_and_hessian(&p);
        let (by_code, hessian_by_code) = emitted.gradient_and_hessian(&p);
        assert!((gradient - by_code).amax() < 1e-14);
        assert!((hessian - hessian_by_code).amax() < 1e-14);
        let image = poisson_map(&learned, &p).unwrap();
        assert!((image - poisson_map(&emitted, &p).unwrap()).amax() < 1e-14);
    }
    // Along a trajectory differences of rounding add up.
    let mut by_model = Phase::<SO3>::at_identity(Vector3::new(1.5, 0.5, 1.0));
    let mut by_code = by_model.clone();
    for _ in 0..500 {
        advance(&learned, &mut by_model).unwrap();
        emitted.advance(&mut by_code).unwrap();
    }
    assert!((by_model.momentum - by_code.momentum).amax() < 1e-11);
    assert!(by_model.group_element.angle_to(&by_code.group_element) < 1e-11);
    assert!((by_model.momentum - Vector3::new(1.5, 0.5, 1.0)).norm() > 0.1);
}
