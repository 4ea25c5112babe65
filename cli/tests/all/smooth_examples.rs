//! The examples whose Hamiltonians are no polynomials, against closed forms and independent integrations.

use std::f64::consts::PI;

use crate::support::{distance, json, numbers, text_of};

/// The momentum at the end of a run, of which momentum and Casimirs must be kept.
fn end(arguments: &str) -> Vec<f64> {
    let report = json(&format!("simulate examples/{arguments}"));
    for name in ["spatial_momentum", "casimirs"] {
        let drift = report["drift"][name].as_f64().unwrap();
        assert!(drift < 1e-13, "{arguments}: {name} {drift:e}");
    }
    numbers(&report["momentum"])
}

/// An integration by Taylor series with 30 digits.
#[test]
fn ends_are_those_of_another_method() {
    let known: serde_json::Value =
        serde_json::from_str(&text_of("tests/reference/smooth.json")).unwrap();
    for (name, step, order) in [("exponential_spin", 0.2, 8.0), ("screened_top", 0.4, 8.0)] {
        let digits = known[name]["momentum"].as_array().unwrap().iter();
        let expected: Vec<f64> = digits.map(|x| x.as_str().unwrap().parse().unwrap()).collect();
        let error = |step: f64| {
            let end = end(&format!("{name}.toml --time {} --step {step}", known[name]["time"]));
            distance(&end, &expected)
        };
        let errors = [error(step), error(step / 2.0)];
        let found = (errors[0] / errors[1]).log2();
        assert!(errors[1] < 1e-9 && (found - order).abs() < 1.0, "{name}: {errors:?} {found}");
        assert!(error(0.01) < 1e-12, "{name}");
    }
}

/// The energy E is constant, so the body moves as the free one with a time that is slower by E.
#[test]
fn a_relativistic_body_is_a_slow_free_body() {
    let energy = (1.0_f64 + 4.0 / 1.5 + 0.25 / 2.0 + 1.0 / 2.5).sqrt();
    let fast = end("relativistic_body.toml --time 40 --step 0.1");
    let slow = end(&format!("rigid_body.toml --time {} --step 0.02", 40.0 / energy));
    assert!(distance(&fast, &slow) < 1e-12, "{fast:?} {slow:?}");
}

/// An equilateral triangle turns about Σμ at the rate |Σμ|/(2π s²), s² = 2.
#[test]
fn a_triangle_of_vortices_turns_as_a_whole() {
    let time = 20.0;
    let end = end(&format!("sphere_vortices.toml --time {time}"));
    let sum = |mu: &[f64], i: usize| mu[i] + mu[3 + i] + mu[6 + i];
    let total = [1.0, 2.0, 3.0];
    let size = 14.0_f64.sqrt();
    let (sin, cos) = (size / (4.0 * PI) * time).sin_cos();
    for vortex in 0..3 {
        let strength = total[vortex];
        for i in 0..3 {
            // Rodrigues' formula for the unit vector number `vortex`.
            let along = total[vortex] * total[i] / (size * size);
            let across = match (i + 3 - vortex) % 3 {
                0 => 0.0,
                1 => total[(vortex + 2) % 3] / size,
                _ => -total[(vortex + 1) % 3] / size,
            };
            let own = if i == vortex { cos } else { 0.0 };
            let expected = strength * (own + sin * across + (1.0 - cos) * along);
            let found = end[3 * vortex + i];
            assert!((found - expected).abs() < 1e-10, "{vortex} {i}: {found} {expected}");
        }
    }
    for (i, total) in total.into_iter().enumerate() {
        assert!((sum(&end, i) - total).abs() < 1e-13, "{end:?}");
    }
}

/// The transition probability of Rosen and Zener.
#[test]
fn a_pulse_turns_a_qubit_over_with_the_known_probability() {
    let end = end("driven_qubit.toml");
    let (area, detuning) = (PI * 0.8, 0.2);
    let probability = ((area / 2.0).sin() / (PI * detuning / 2.0).cosh()).powi(2);
    assert!(probability > 0.7);
    assert!((end[2] - (1.0 - 2.0 * probability)).abs() < 1e-11, "{end:?} {probability}");
}
