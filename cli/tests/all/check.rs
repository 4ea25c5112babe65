//! `check`: laws that hold, and one that does not.

use crate::support::{BODY, Folder, json, run};
use serde_json::Value;

/// The report of a check by which all laws hold.
fn holds(report: Value) -> Value {
    for law in report["laws"].as_array().unwrap() {
        assert_eq!(law["pass"], true, "{law}");
        assert!(law["value"].is_number() && law["bound"].is_number(), "{law}");
    }
    report
}

#[test]
fn the_laws_hold_for_the_examples() {
    for arguments in [
        "rigid_body.toml --truncation 5",
        "rigid_body.toml --chart cayley --truncation 3",
        "heavy_top.toml --truncation 3 --points 1",
        "sl2_by_basis.toml",
        "so21_by_brackets.toml",
        "toda_lattice.toml --points 1",
    ] {
        let report = holds(json(&format!("check examples/{arguments}")));
        let laws = report["laws"].as_array().unwrap();
        let names: Vec<&str> = laws.iter().map(|law| law["name"].as_str().unwrap()).collect();
        assert_eq!(
            names,
            [
                "Poisson",
                "symplectic",
                "equivariant",
                "momentum",
                "diagram",
                "symmetric",
                "order",
                "drift"
            ]
        );
        let order = laws[6]["value"].as_f64().unwrap();
        let expected = report["truncation"].as_f64().unwrap() + 1.0;
        assert!((order - expected).abs() < 0.3, "{arguments}: order {order}");
    }
}

#[test]
fn the_table_is_the_same_for_the_same_seed() {
    let table = || run(&format!("check {BODY} --truncation 3 --seed 7")).ok();
    let first = table().prints(&["Poisson", "holds"]);
    assert!(!first.out.contains("FAILS"));
    assert_eq!(table().out, first.out);
}

/// A step far too large: the solve fails, which is a failure of the run, not of the input.
#[test]
fn a_step_too_large_is_a_failure_while_running() {
    run(&format!("check {BODY} --step 1000")).fails(1, &["; a step of "]);
}

/// A held-out algebra by brackets: the Euclidean algebra of the plane with a central extension.
#[test]
fn an_algebra_nobody_has_seen() {
    let folder = Folder::with(
        r#"
hamiltonian = "r^2/2 + px^2/3 + py^2/5 + px*c/7 + c"
[algebra]
generators = ["r", "px", "py", "c"]
brackets = ["[r, px] = py", "[r, py] = -px", "[px, py] = 1/2*c"]
[integrator]
truncation = 5
step = 0.1
[initial]
momentum = [0.5, 1.0, -0.5, 0.25]
"#,
    );
    holds(folder.json("check system.toml"));
}

/// Coordinates of different units have different sizes: points are near the run of the file.
#[test]
fn points_have_the_scale_of_the_initial_momentum() {
    let folder = Folder::with(
        "group = \"SO3 |x R3\"\ncoordinates = [\"x\", \"y\", \"z\", \"u\", \"v\", \"w\"]\n\
         hamiltonian = \"x^2/(2*A) + y^2/(2*A) + z^2/(2*C) + m*w\"\n[parameters]\nA = 8e-5\nC = 1.2e-4\nm = 0.05886\n\
         [integrator]\ntruncation = 3\nstep = 0.0005\n[initial]\nmomentum = [0, 0, 0.05, 0, 0.5, 0.8660254037844386]\n",
    );
    let report = holds(folder.json("check system.toml"));
    assert_eq!((&report["step"], &report["truncation"]), (&0.0005.into(), &3.into()));
}
