//! `simulate` with a potential: the reference of the satellite, what is conserved, mistakes.

use crate::support::{Folder, distance, json, numbers, text_of};
use serde_json::Value;

const SATELLITE: &str = "examples/satellite.toml";

/// The largest difference from tests/reference/satellite.json, made by make_references.py beside it.
fn error(step: &str) -> (f64, Value) {
    let reference: Value =
        serde_json::from_str(&text_of("tests/reference/satellite.json")).unwrap();
    let report = json(&format!("simulate {SATELLITE} --time 20 --step {step} --every 1000"));
    let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
    let mut worst = 0.0_f64;
    let mut compare = |found: &Value, expected: &Value| {
        worst = worst.max((found.as_f64().unwrap() - number(expected)).abs());
    };
    for i in 0..4 {
        compare(&report["momentum"][i], &reference["momentum"][i]);
    }
    for i in 0..3 {
        for j in 0..3 {
            compare(&report["group_element"][i][j], &reference["attitude"][i][j]);
        }
    }
    for i in 0..2 {
        compare(&report["group_element"][3 + i][3], &reference["orbit"][i]);
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
    let report = json(&format!("check {SATELLITE} --points 1"));
    let laws = report["laws"].as_array().unwrap();
    assert!(laws.iter().all(|law| law["pass"] == true), "{report}");
    let law = |name: &str| laws.iter().find(|law| law["name"] == name).unwrap();
    assert!(law("symplectic+V")["value"].as_f64().unwrap() < 1e-9);
    assert!((law("order+V")["value"].as_f64().unwrap() - 6.0).abs() < 0.3, "{report}");
}

#[test]
fn a_broken_symmetry_is_said_and_not_measured() {
    let folder = Folder::with(
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
    folder.run("simulate system.toml").ok().prints(&[
        "rkn4",
        "not conserved: the potential breaks the symmetry",
        "none that the kicks keep",
    ]);
    assert!(folder.json("simulate system.toml")["drift"]["spatial_momentum"].is_null());
    folder.run("emit system.toml").ok().prints(&["SystemPotential", "pub fn torque"]);
}

/// Each row is kicked as `simulate` kicks its state; a row that cannot be moved stops alone.
#[test]
fn ensembles_take_potentials() {
    let folder = Folder::with(
        r#"
group = "SO3"
hamiltonian = "mu[0]^2/2 + mu[1]^2/3 + mu[2]^2/4"
potential = "g[2][2] + 0.5*g[2][0]"
[integrator]
step = 0.05
[initial]
momentum = [0.3, 0.2, 0.1]
[run]
time = 2.0
"#,
    );
    folder.write("in.csv", "mu_1,mu_2,mu_3\n0.3,0.2,0.1\n1e3,2e3,3e3\n0.3,0.2,0.1\n");
    for backend in ["interpreter", "auto"] {
        let report = folder.json(&format!(
            "ensemble system.toml --initial in.csv --out out.csv --backend {backend} --restart"
        ));
        assert_eq!(report["failed"], 1, "{report}");
        // The vertical component of the spatial momentum stays; no Casimir does.
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-13, "{report}");
        assert!(report["drift"]["casimirs"].is_null(), "{report}");
        let ends = folder.table("out.csv");
        let single = folder.json("simulate system.toml");
        for row in [1, 3] {
            let end: Vec<f64> = ends[row].iter().map(|cell| cell.parse().unwrap()).collect();
            assert!(distance(&end, &numbers(&single["momentum"])) < 1e-12, "{end:?}");
        }
    }
}

#[test]
fn mistakes_have_their_places() {
    for (potential, splitting, hamiltonian, place, message) in [
        ("g[0][3]", "rkn4", "mu[0]^2", ":3:14", "index 3 of `g[0]` is out of range"),
        ("1/g[0][0]", "rkn4", "mu[0]^2", ":3:14", "division by the group element"),
        ("sqrt(g[0][0])", "rkn4", "mu[0]^2", ":3:14", "the potential must be one"),
        ("2", "rkn4", "mu[0]^2", ":3:13", "does not depend on the group element"),
        ("g[2][2]", "rkn5", "mu[0]^2", ":6:13", "did you mean `rkn4`"),
        ("g[2][2]", "rkn6", "mu[0]^4", ":6:13", "degree at most two"),
        ("", "strang", "mu[0]^2", ":5:13", "there is none"),
    ] {
        let potential =
            if potential.is_empty() { "" } else { &format!("potential = \"{potential}\"\n") };
        let folder = Folder::with(&format!(
            "group = \"SO3\"\nhamiltonian = \"{hamiltonian}\"\n{potential}[integrator]\nstep = 0.1\n\
             splitting = \"{splitting}\"\n[initial]\nmomentum = [1, 0, 0]\n[run]\ntime = 1\n"
        ));
        folder.run("simulate system.toml").fails(2, &[place, message]);
    }
}
