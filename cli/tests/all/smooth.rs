//! Runs of Hamiltonians that are no polynomials, by collocation.

use serde_json::Value;

use crate::support::Folder;

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
