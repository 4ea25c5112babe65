//! `check`: laws that hold, and one that does not.

use crate::support::{json, run, system};

#[test]
fn the_laws_hold_for_the_examples() {
    for (system, options) in [
        ("examples/rigid_body.toml", &["--truncation", "5"][..]),
        ("examples/rigid_body.toml", &["--chart", "cayley", "--truncation", "3"]),
        ("examples/heavy_top.toml", &["--truncation", "3", "--points", "1"]),
        ("examples/sl2_by_basis.toml", &[]),
        ("examples/so21_by_brackets.toml", &[]),
        ("examples/toda_lattice.toml", &["--points", "1"]),
    ] {
        let report = json(&[&["check", system, "--format", "json"], options].concat());
        let laws = report["laws"].as_array().unwrap();
        let names: Vec<&str> = laws.iter().map(|law| law["name"].as_str().unwrap()).collect();
        assert_eq!(
            names,
            ["Poisson", "symplectic", "equivariant", "momentum", "diagram", "symmetric", "order"]
        );
        for law in laws {
            assert_eq!(law["pass"], true, "{system}: {law}");
            assert!(law["value"].is_number() && law["bound"].is_number(), "{law}");
        }
        let order = laws[6]["value"].as_f64().unwrap();
        let expected = report["truncation"].as_f64().unwrap() + 1.0;
        assert!((order - expected).abs() < 0.3, "{system}: order {order}");
    }
}

#[test]
fn the_table_is_the_same_for_the_same_seed() {
    let arguments = ["check", "examples/rigid_body.toml", "--truncation", "3", "--seed", "7"];
    let (code, table, _) = run(&arguments);
    assert_eq!(code, 0);
    assert!(table.contains("Poisson") && table.contains("holds") && !table.contains("FAILS"));
    assert_eq!(run(&arguments).1, table);
}

/// A step far too large: the solve fails, which is a failure of the run, not of the input.
#[test]
fn a_step_too_large_is_a_failure_while_running() {
    let (code, _, error) = run(&["check", "examples/rigid_body.toml", "--step", "1000"]);
    assert_eq!(code, 1, "{error}");
    assert!(error.contains("; a step of "), "{error}");
}

/// A held-out algebra by brackets: the Euclidean algebra of the plane with a central extension.
#[test]
fn an_algebra_nobody_has_seen() {
    let (_folder, system) = system(
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
    let report = json(&["check", &system, "--format", "json"]);
    assert!(report["laws"].as_array().unwrap().iter().all(|law| law["pass"] == true), "{report}");
}

/// Coordinates of different units have different sizes: points are about the initial momentum, one by one.
#[test]
fn points_have_the_scale_of_the_initial_momentum() {
    let (_folder, system) = system(
        "group = \"SO3 |x R3\"\ncoordinates = [\"x\", \"y\", \"z\", \"u\", \"v\", \"w\"]\n\
         hamiltonian = \"x^2/(2*A) + y^2/(2*A) + z^2/(2*C) + m*w\"\n[parameters]\nA = 8e-5\nC = 1.2e-4\nm = 0.05886\n\
         [integrator]\ntruncation = 3\nstep = 0.0005\n[initial]\nmomentum = [0, 0, 0.05, 0, 0.5, 0.8660254037844386]\n",
    );
    let report = json(&["check", &system, "--format", "json"]);
    assert_eq!((&report["step"], &report["truncation"]), (&0.0005.into(), &3.into()));
    assert!(report["laws"].as_array().unwrap().iter().all(|law| law["pass"] == true), "{report}");
}
