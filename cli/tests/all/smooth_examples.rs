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

/// The ring turns at the rate 11 cos θ/(4π sin² θ), and Σμ stays.
#[test]
fn a_ring_of_twelve_vortices_turns_at_the_known_rate() {
    let end = end("vortex_ring.toml");
    let angle = 11.0 * 0.8 / (4.0 * PI * 0.36) * 3.2;
    for (vortex, found) in end.chunks(3).enumerate() {
        let (sin, cos) = (angle + PI * vortex as f64 / 6.0).sin_cos();
        assert!(distance(found, &[0.6 * cos, 0.6 * sin, 0.8]) < 1e-8, "{vortex}: {found:?}");
    }
    let sum = |i: usize| end.chunks(3).map(|mu| mu[i]).sum::<f64>();
    assert!(distance(&[sum(0), sum(1), sum(2)], &[0.0, 0.0, 9.6]) < 1e-12, "{end:?}");
}

pub(crate) fn cross(a: &[f64], b: &[f64]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Steps of the classical method of Runge and Kutta to this time.
pub(crate) fn runge_kutta<const N: usize>(
    mut state: [f64; N],
    (time, steps): (f64, u32),
    rate: impl Fn(f64, &[f64; N]) -> [f64; N],
) -> [f64; N] {
    let h = time / f64::from(steps);
    let beside = |y: &[f64; N], k: &[f64; N], by: f64| std::array::from_fn(|i| y[i] + by * k[i]);
    for step in 0..steps {
        let t = f64::from(step) * h;
        let k1 = rate(t, &state);
        let k2 = rate(t + h / 2.0, &beside(&state, &k1, h / 2.0));
        let k3 = rate(t + h / 2.0, &beside(&state, &k2, h / 2.0));
        let k4 = rate(t + h, &beside(&state, &k3, h));
        state =
            std::array::from_fn(|i| state[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    state
}

/// Π' = Π × I⁻¹(Π − h(t)), h by Lagrange's formula.
#[test]
fn wheels_turn_a_satellite_as_its_own_equations_say() {
    let found = end("reaction_wheels.toml --step 0.02");
    let tables = [[0.0, 0.4, 0.2, 0.0], [0.0, -0.3, 0.1, 0.5], [0.0, 0.2, 0.6, 0.3]];
    let cubic = |values: &[f64; 4], t: f64| -> f64 {
        let term = |k: usize| {
            let others = (0..4).filter(|j| *j != k);
            let factor = |j: usize| (t / 10.0 - j as f64) / (k as f64 - j as f64);
            values[k] * others.map(factor).product::<f64>()
        };
        (0..4).map(term).sum()
    };
    let inertia = [1.0, 1.5, 2.0];
    let expected = runge_kutta([0.3, 0.2, 0.5], (30.0, 30_000), |t, mu| {
        cross(mu, &[0, 1, 2].map(|i: usize| (mu[i] - cubic(&tables[i], t)) / inertia[i]))
    });
    assert!(distance(&found, &expected) < 1e-11, "{found:?} {expected:?}");
}

/// In body axes: q' = p/m − Ω × q, Π' = Π × Ω + q × ∇V, p' = p × Ω − ∇V.
#[test]
fn a_satellite_on_an_ellipse_moves_as_its_own_equations_say() {
    let report = json("simulate examples/elliptic_satellite.toml --time 5 --step 0.005");
    let inertia = [0.01, 0.03, 0.035];
    let start = [1.0, 0.0, 0.0, 0.005, 0.01, 0.04, 0.0, 0.9, 0.1];
    let expected = runge_kutta(start, (5.0, 50_000), |_, state| {
        let (q, pi, p) = (&state[..3], &state[3..6], &state[6..]);
        let omega = [0, 1, 2].map(|i| pi[i] / inertia[i]);
        let r = q.iter().map(|q| q * q).sum::<f64>().sqrt();
        let (trace, long) = (0.075, (0..3).map(|i| inertia[i] * q[i] * q[i]).sum::<f64>());
        let along = 1.0 / r.powi(3) + 1.5 * trace / r.powi(5) - 7.5 * long / r.powi(7);
        let slope = [0, 1, 2].map(|i| q[i] * along + 3.0 * inertia[i] * q[i] / r.powi(5));
        let ([a, b, c], torque) =
            ([cross(&omega, q), cross(pi, &omega), cross(p, &omega)], cross(q, &slope));
        std::array::from_fn(|i| match i / 3 {
            0 => p[i] - a[i],
            1 => b[i - 3] + torque[i - 3],
            _ => c[i - 6] - slope[i - 6],
        })
    });
    let found = numbers(&report["momentum"]);
    assert!(distance(&found, &expected[3..]) < 1e-10, "{found:?} {expected:?}");
    assert_eq!(report["conserved_momenta"], 3);
    let drift = |name: &str| report["drift"][name].as_f64().unwrap();
    assert!(drift("spatial_momentum") < 1e-13 && drift("energy") < 1e-11, "{report}");
}
