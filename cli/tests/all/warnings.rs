//! The warnings of a run: a series that hardly converges, steps that would work.

use crate::support::{Folder, run};
use serde_json::Value;

const BODY: &str = "examples/rigid_body.toml";

/// The report of a run that ends well, and what it said.
fn report(arguments: &[&str]) -> (Value, String) {
    let (code, out, error) = run(&[arguments, &["--format", "json"]].concat());
    assert_eq!(code, 0, "{arguments:?}: {error}");
    (serde_json::from_str(&out).unwrap(), error)
}

fn kinds(report: &Value) -> Vec<&str> {
    report["warnings"].as_array().unwrap().iter().map(|w| w["kind"].as_str().unwrap()).collect()
}

#[test]
fn a_series_that_hardly_converges_is_told_once() {
    for (step, expected) in [("0.1", 0), ("0.5", 0), ("2.2", 1)] {
        let (report, error) = report(&["simulate", BODY, "--step", step, "--time", "22"]);
        assert_eq!(kinds(&report), vec!["series_ratio"; expected], "{step}: {error}");
        assert_eq!(
            error.matches("warning: the series hardly converges").count(),
            expected,
            "{error}"
        );
        if expected == 1 {
            let ratio = report["warnings"][0]["ratio"].as_f64().unwrap();
            assert!((0.25..0.5).contains(&ratio), "{ratio}");
            assert!(report["warnings"][0]["step"].as_u64().unwrap() >= 1);
        }
    }
    let (code, text, _) = run(&["simulate", BODY, "--step", "2.2", "--time", "22"]);
    assert!(
        code == 0 && text.contains("  warning: the series hardly converges: from step "),
        "{text}"
    );
    // Steps are refused above twice that.
    let (code, _, error) = run(&["simulate", BODY, "--step", "3", "--time", "30"]);
    assert!(code == 1 && error.contains("a step of "), "{error}");
}

/// The ratio changes along the motion: the warning names the first step that is worth one.
#[test]
fn the_warning_names_the_time_it_comes() {
    let (report, error) = report(&["simulate", BODY, "--step", "2.1", "--time", "21"]);
    let warning = &report["warnings"][0];
    assert!(warning["step"] == 2 && warning["time"] == 2.1, "{warning}");
    assert!(error.contains("from step 2, at time 2.1,"), "{error}");
}

#[test]
fn check_and_ensemble_tell_it_too() {
    let folder = Folder::new();
    let (found, error) = report(&["check", BODY, "--step", "0.1"]);
    assert!(kinds(&found).is_empty() && error.is_empty(), "{error}");
    let flat = folder.name("flat.toml");
    let text = "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x^2/2 + y^2/6 + z^2/7\"\n\
                [initial]\nmomentum = [0.4, 2.4, 2.0]\n";
    std::fs::write(&flat, text).unwrap();
    let (_, out, error) = run(&["check", &flat, "--step", "1.2", "--format", "json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(kinds(&found), ["series_ratio"], "{error}");
    assert_eq!(error.matches("warning: ").count(), 1, "{error}");

    let (states, out) = (folder.name("states.csv"), folder.name("ends.csv"));
    for (momentum, expected) in [("0.2,0.1,0.1", 0), ("1.5,1.5,0.5", 1)] {
        std::fs::write(&states, format!("mu_1,mu_2,mu_3\n0.1,0,0.1\n{momentum}\n")).unwrap();
        let run = [
            "ensemble",
            BODY,
            "--initial",
            &states,
            "--out",
            &out,
            "--step",
            "2.2",
            "--time",
            "22",
        ];
        let (found, error) = report(&run);
        assert_eq!(kinds(&found), vec!["series_ratio"; expected], "{error}");
        assert_eq!(error.matches("warning: ").count(), expected, "{error}");
    }
}
