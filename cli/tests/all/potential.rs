//! `simulate` with a potential: the reference of the satellite, what is conserved, mistakes.

use crate::support::{Folder, json, run, system};

/// The largest difference from tests/reference/satellite.json, made by tests/reference/satellite.py.
fn error(step: &str) -> (f64, serde_json::Value) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/reference/satellite.json");
    let reference: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let arguments = ["--time", "20", "--step", step, "--every", "1000", "--format", "json"];
    let report = json(&[&["simulate", "examples/satellite.toml"], &arguments[..]].concat());
    let number = |value: &serde_json::Value| value.as_str().unwrap().parse::<f64>().unwrap();
    let mut worst = 0.0_f64;
    for i in 0..4 {
        let found = report["momentum"][i].as_f64().unwrap();
        worst = worst.max((found - number(&reference["momentum"][i])).abs());
    }
    for i in 0..3 {
        for j in 0..3 {
            let found = report["group_element"][i][j].as_f64().unwrap();
            worst = worst.max((found - number(&reference["attitude"][i][j])).abs());
        }
        if i < 2 {
            let found = report["group_element"][3 + i][3].as_f64().unwrap();
            worst = worst.max((found - number(&reference["orbit"][i])).abs());
        }
    }
    (worst, report)
}

/// Order 6 to the reference, and to 1e-11 where the steps are small.
#[test]
fn the_satellite_reaches_its_reference() {
    let (coarse, _) = error("0.2");
    let (fine, _) = error("0.1");
    let order = (coarse / fine).log2();
    assert!((order - 6.0).abs() < 0.6, "{coarse:e} {fine:e}: order {order:.2}");
    let (finest, report) = error("0.0125");
    assert!(finest < 1e-11, "{finest:e}");
    // Turning attitude and orbit together is the one symmetry left; no Casimir is.
    assert_eq!(report["conserved_momenta"], 1);
    assert_eq!(report["conserved_casimirs"], 0);
    assert!(report["drift"]["casimirs"].is_null());
    assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-13);
    assert!(report["drift"]["energy"].as_f64().unwrap() < 1e-11);
}

#[test]
fn the_laws_hold_with_kicks() {
    let report = json(&["check", "examples/satellite.toml", "--points", "1", "--format", "json"]);
    let laws = report["laws"].as_array().unwrap();
    assert!(laws.iter().all(|law| law["pass"] == true), "{report}");
    let law = |name: &str| laws.iter().find(|law| law["name"] == name).unwrap();
    assert!(law("symplectic+V")["value"].as_f64().unwrap() < 1e-9);
    assert!((law("order+V")["value"].as_f64().unwrap() - 6.0).abs() < 0.3, "{report}");
}

#[test]
fn a_broken_symmetry_is_said_and_not_measured() {
    let (_folder, system) = system(
        r#"
group = "SO3"
hamiltonian = "mu[0]^2/2 + mu[1]^2/3 + mu[2]^2/4"
potential = "g[2][2] + a*g[0][1]"
[parameters]
a = 0.5
[integrator]
step = 0.05
[initial]
momentum = [0.3, 0.2, 0.1]
[run]
time = 2.0
"#,
    );
    let (code, text, error) = run(&["simulate", &system]);
    assert_eq!(code, 0, "{error}");
    assert!(text.contains("rkn4"), "{text}");
    assert!(text.contains("not conserved: the potential breaks the symmetry"), "{text}");
    assert!(text.contains("none that the kicks keep"), "{text}");
    assert!(
        json(&["simulate", &system, "--format", "json"])["drift"]["spatial_momentum"].is_null()
    );
    let (code, module, _) = run(&["emit", &system]);
    assert_eq!(code, 0);
    assert!(module.contains("SystemPotential") && module.contains("pub fn torque"), "{module}");
}

#[test]
fn mistakes_have_their_places() {
    let folder = Folder::new();
    let system = |potential: &str, splitting: &str, hamiltonian: &str| {
        format!(
            "group = \"SO3\"\nhamiltonian = \"{hamiltonian}\"\npotential = \"{potential}\"\n\
             [integrator]\nstep = 0.1\nsplitting = \"{splitting}\"\n[initial]\n\
             momentum = [1, 0, 0]\n[run]\ntime = 1\n"
        )
    };
    for (text, place, message) in [
        (system("g[0][3]", "rkn4", "mu[0]^2"), ":3:14", "unknown variable `g[0][3]`"),
        (system("1/g[0][0]", "rkn4", "mu[0]^2"), ":3:14", "division by the group element"),
        (system("sqrt(g[0][0])", "rkn4", "mu[0]^2"), ":3:14", "the potential must be one"),
        (system("2", "rkn4", "mu[0]^2"), ":3:13", "does not depend on the group element"),
        (system("g[2][2]", "rkn5", "mu[0]^2"), ":6:13", "did you mean `rkn4`"),
        (system("g[2][2]", "rkn6", "mu[0]^4"), ":6:13", "degree at most two"),
        (
            "group = \"SO3\"\nhamiltonian = \"mu[0]^2\"\n[integrator]\nsplitting = \"strang\"\n"
                .into(),
            ":4:13",
            "there is none",
        ),
    ] {
        let path = folder.write("system.toml", &text);
        let (code, _, error) = run(&["simulate", &path]);
        assert_eq!(code, 2, "{text}\n{error}");
        assert!(error.contains(place) && error.contains(message), "{text}\n{error}");
    }
}
