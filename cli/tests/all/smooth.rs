//! Runs of Hamiltonians that are no polynomials, by collocation.

use serde_json::Value;

use crate::support::{Folder, distance, numbers};

const FAST_BODY: &str = r#"
name = "fast-body"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "sqrt(1 + x^2/I1 + y^2/2 + z^2/2.5)"
[parameters]
I1 = 1.5
[integrator]
truncation = 7
step = 0.2
[initial]
momentum = [2.0, 0.5, 1.0]
[run]
time = 200.0
"#;

fn report(folder: &Folder, options: &str) -> Value {
    let ran = folder.run(&format!("simulate system.toml --format json {options}")).ok();
    serde_json::from_str(&ran.out).unwrap()
}

#[test]
fn momentum_casimirs_and_energy_are_kept() {
    let folder = Folder::with(FAST_BODY);
    let report = report(&folder, "--out rows.csv");
    assert_eq!(report["method"], "collocation, 4 nodes");
    assert_eq!(report["steps"], 1000);
    let drift = |name: &str| report["drift"][name].as_f64().unwrap();
    assert!(drift("spatial_momentum") < 1e-13, "{report}");
    assert!(drift("casimirs") < 1e-13, "{report}");
    assert!(drift("energy") < 1e-11, "{report}");
    let energy = report["energy"]["start"].as_f64().unwrap();
    let expected = (1.0_f64 + 4.0 / 1.5 + 0.125 + 0.4).sqrt();
    assert!((energy - expected).abs() < 1e-15, "{energy}");
    assert_eq!(folder.text("rows.csv").lines().filter(|line| !line.starts_with('#')).count(), 1002);
}

/// Order 8: the error of half the step is about 2⁸ times as small.
#[test]
fn the_order_is_that_of_the_truncation() {
    let folder = Folder::with(FAST_BODY);
    let end = |step: f64| -> Vec<f64> {
        let report = report(&folder, &format!("--time 8 --step {step}"));
        let end = report["momentum"].as_array().unwrap();
        end.iter().map(|value| value.as_f64().unwrap()).collect()
    };
    let exact = end(0.1);
    let error = |step| -> f64 {
        let end = end(step);
        end.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let order = (error(1.6) / error(0.8)).log2();
    assert!((order - 8.0).abs() < 1.0, "{order}");
}

#[test]
fn refusals_name_expression_argument_and_time() {
    let folder = Folder::with(&FAST_BODY.replace("sqrt(1 + x^2/I1", "x + ln(x - 3"));
    let expected = "at time 0: ln(x - 3 + y^2/2 + z^2/(5/2)) of -0.475";
    folder.run("simulate system.toml").fails(1, &[expected]);
    for option in ["--tolerance 1e-8", "--compare rk45", "--checkpoint c", "--backend c"] {
        let folder = Folder::with(FAST_BODY);
        let error = folder.run(&format!("simulate system.toml {option}")).fails(2, &[]).error;
        assert!(error.contains("runs by collocation"), "{option}: {error}");
    }
    let chosen = FAST_BODY.replace("step = 0.2", "step = 0.2\nchart = \"cayley\"");
    let ran = Folder::with(&chosen).run("simulate system.toml");
    ran.fails(2, &["`chart` is one of a series"]);
    let pushed = FAST_BODY.replace("[parameters]", "potential = \"g[2][2]\"\n[parameters]");
    Folder::with(&pushed).run("simulate system.toml").fails(2, &["`potential`: "]);
    // Where there is no collocation yet.
    let ran = Folder::with(FAST_BODY).run("derive system.toml");
    ran.fails(2, &["`sqrt` of the momentum is not a polynomial", "collocation"]);
}

/// A spin in a field that turns about the third axis.
const DRIVEN: &str = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "B*(cos(w*t)*x + sin(w*t)*y) + C*z"
[parameters]
B = 0.8
C = 0.3
w = 1.7
[integrator]
step = 0.1
[initial]
momentum = [0.5, -0.3, 0.9]
[run]
time = 12.3
[[event]]
name = "flat"
when = "z - 1"
[[event]]
name = "late"
when = "t - 12.21"
"#;

/// μ of the spin at time t: in axes that turn with the field, which stands still there, it turns about B, 0, C + w.
fn driven(t: f64) -> [f64; 3] {
    let (b, w) = ([0.8, 0.0, 0.3 + 1.7], 1.7_f64);
    let rate = f64::hypot(b[0], b[2]);
    let (axis, start) = (b.map(|x| x / rate), [0.5, -0.3, 0.9]);
    // By Rodrigues' formula, backwards.
    let (sin, cos) = (-rate * t).sin_cos();
    let along: f64 = axis.iter().zip(start).map(|(a, x)| a * x).sum();
    let cross = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        axis[j] * start[k] - axis[k] * start[j]
    };
    let [x, y, z] =
        [0, 1, 2].map(|i| cos * start[i] + sin * cross(i) + (1.0 - cos) * along * axis[i]);
    let (sin, cos) = (w * t).sin_cos();
    [cos * x - sin * y, sin * x + cos * y, z]
}

#[test]
fn a_hamiltonian_that_moves_in_time_is_followed_at_its_own_times() {
    let folder = Folder::with(DRIVEN);
    let report = report(&folder, "--at 0.037,7.2,12.29 --out rows.csv");
    let close = |found: &[f64], time: f64, most: f64| {
        let error = distance(found, &driven(time));
        assert!(error < most, "{error:e} at {time}");
        error
    };
    close(&numbers(&report["momentum"]), 12.3, 1e-11);
    for row in &folder.table("rows.csv")[1..] {
        let row: Vec<f64> = row.iter().map(|x| x.parse().unwrap()).collect();
        close(&row[1..4], row[0], 1e-11);
    }
    let names = &folder.table("rows.csv")[0];
    assert!(names.iter().any(|name| name == "spatial_momentum_drift"), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("energy")), "{names:?}");
    let events = report["events"].as_array().unwrap();
    assert!(events.len() > 3, "{report}");
    for event in events {
        let time = event["time"].as_f64().unwrap();
        match event["event"].as_str().unwrap() {
            "flat" => assert!((driven(time)[2] - 1.0).abs() < 1e-11, "{event}"),
            _ => assert!((time - 12.21).abs() < 1e-12, "{event}"),
        }
    }
    for name in ["spatial_momentum", "casimirs"] {
        assert!(report["drift"][name].as_f64().unwrap() < 1e-13, "{report}");
    }
    assert!(report["drift"]["energy"].is_null() && report["energy"].is_null(), "{report}");
    let text = folder.run("simulate system.toml --step 0.4").ok();
    text.prints(&["energy           not conserved: the Hamiltonian depends on time"]);
    // Of an odd number of steps too.
    for step in ["0.41", "0.4"] {
        let report = folder.json(&format!("simulate system.toml --step {step}"));
        let error = close(&numbers(&report["momentum"]), 12.3, 1e-5);
        let estimate = report["estimated_error"].as_f64().unwrap();
        assert!((0.2..5.0).contains(&(estimate / error)), "{estimate:e} {error:e}");
    }
}
