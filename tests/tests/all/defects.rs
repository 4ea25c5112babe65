//! Regression tests of defects in the library: steps that solved nothing, and more. Each is refused, or right.

#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

use coadjoint::generating::PolynomialFunction;
use coadjoint::groups::{Cayley, Exponential};
use coadjoint::steps::{advance, advance_by};
use coadjoint::{GeneratingFunction, Phase};
use coadjoint::{SE3, SO3, StepError, lie_poisson};
use coadjoint_tests::sources::{self, root};
use nalgebra::{Matrix3, Quaternion, SVector, UnitQuaternion, Vector3};

const INERTIA: [f64; 3] = [1.3, 2.1, 3.0];

#[lie_poisson(group = SO3, truncation = 7)]
fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SE3, truncation = 5)]
fn top(mu: [f64; 6], inertia: [f64; 3], height: f64) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
        + height * mu[5]
}

#[test]
fn a_step_of_a_top_that_loses_momentum_is_refused() -> Result<(), StepError> {
    let step = Top::new(1.0, INERTIA, 1.0)?;
    // This one was accepted with |x| = 4e52.
    let mu = [
        -0.34170078176259644,
        -3.8837134581662,
        6.421404486074798,
        -0.916301546164221,
        0.45806835778254174,
        -0.9476025154341972,
    ];
    let start = Phase::<SE3>::at_identity(SVector::from(mu));
    let mut state = start.clone();
    assert!(step.advance(&mut state).is_err());
    assert_eq!(state.momentum, start.momentum);
    Ok(())
}

#[test]
fn a_group_element_that_is_not_finite_goes_nowhere() -> Result<(), StepError> {
    let step = Body::new(0.1, INERTIA)?;
    let nowhere = UnitQuaternion::new_unchecked(Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    let start = Phase::<SO3>::new(nowhere, Vector3::new(2.0, 0.5, 1.0));
    let mut state = start.clone();
    assert!(matches!(step.advance(&mut state), Err(StepError::OffGroup { .. })));
    assert!(matches!(advance(&step, &mut state), Err(StepError::OffGroup { .. })));
    let stopped = advance_by(&step, &mut state, 1000).unwrap_err();
    assert!(stopped.steps == 0 && matches!(stopped.error, StepError::OffGroup { .. }), "{stopped}");
    assert_eq!(state.momentum, start.momentum);
    Ok(())
}

/// S = p₀·p₀ + p₁·p₁ with both factors written out: ∂²S/∂p² has 2 twice on its diagonal, in both charts.
#[test]
fn repeated_factors_are_powers_in_every_term() -> Result<(), Box<dyn std::error::Error>> {
    let terms = || vec![(1.0, vec![(0, 1), (0, 1)]), (1.0, vec![(1, 1), (1, 1)])];
    let p = Vector3::new(0.3, -0.4, 0.5);
    let expected = Matrix3::from_diagonal(&Vector3::new(2.0, 2.0, 0.0));
    let exponential = PolynomialFunction::new(SO3::<f64>::new(), Exponential, terms())?;
    let cayley = PolynomialFunction::new(SO3::<f64>::new(), Cayley, terms())?;
    for (gradient, hessian) in
        [exponential.gradient_and_hessian(&p), cayley.gradient_and_hessian(&p)]
    {
        assert_eq!(gradient, Vector3::new(0.6, -0.8, 0.0));
        assert_eq!(hessian, expected);
    }
    Ok(())
}

#[test]
fn the_feature_of_build_scripts_is_named() {
    for page in ["codegen/src/build_script.rs", "codegen/src/lib.rs"] {
        let text = sources::read(page);
        assert!(text.contains("features = [\"system\"]"), "{page}");
    }
}

/// The build script of the runtime, built and run as cargo does.
#[test]
fn without_std_or_libm_one_sentence_says_what_is_missing() {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("runtime-build-script");
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let built = Command::new(compiler)
        .args(["--edition", "2024", "-o"])
        .arg(&program)
        .arg(root().join("runtime/build.rs"))
        .env("CARGO_PKG_VERSION", "0.0.0")
        .status();
    assert!(built.unwrap().success());
    let said = |feature: &str| {
        let mut command = Command::new(&program);
        command.env_remove("CARGO_FEATURE_STD").env_remove("CARGO_FEATURE_LIBM");
        let output = command.env(feature, "1").output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let without = said("CARGO_FEATURE_ALLOC");
    assert_eq!(without.matches("cargo::error=").count(), 1, "{without}");
    assert!(without.contains("`std`") && without.contains("`libm`"), "{without}");
    for feature in ["CARGO_FEATURE_STD", "CARGO_FEATURE_LIBM"] {
        assert!(!said(feature).contains("cargo::error"));
    }
}

/// Numbers of steps are of 64 bits; addresses may have 32.
#[test]
fn no_number_of_steps_is_cut_to_the_width_of_an_address() {
    let files = sources::rust("runtime/src");
    for (file, text) in &files {
        // A number of substeps is one of few.
        let before = text.match_indices("steps as usize").map(|(at, _)| &text[..at]);
        let mut whole = before.filter(|text| !text.ends_with(|c: char| c.is_alphanumeric()));
        assert!(whole.next().is_none(), "{file}");
    }
    assert!(files.len() > 50);
}
