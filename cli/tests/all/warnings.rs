//! The warnings of a run: a series that hardly converges, steps that would work.

use crate::support::{BODY, Folder, Ran};
use serde_json::Value;

const TOLD: &str = "warning: the series hardly converges";
/// So long a step makes large errors, and takes the generic solver: warnings of their own.
const OTHERS: [&str; 2] =
    ["warning: the error at the end is about", "are too long for the compiled step"];

/// The report of a command, which warns of the series this often, in the report and on the error stream.
fn warned(ran: Ran, times: usize) -> Value {
    let others: usize = OTHERS.iter().map(|other| ran.error.matches(other).count()).sum();
    assert_eq!(ran.error.matches("warning: ").count(), times + others, "{ran:?}");
    assert_eq!(ran.error.matches(TOLD).count(), times, "{ran:?}");
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    let kinds = report["warnings"].as_array().unwrap().iter().map(|warning| &warning["kind"]);
    let kinds = kinds.filter(|kind| *kind != "estimated_error" && *kind != "slow_steps");
    assert_eq!(kinds.collect::<Vec<_>>(), vec!["series_ratio"; times], "{report}");
    report
}

#[test]
fn a_series_that_hardly_converges_is_told_once() {
    let folder = Folder::new();
    let run = |options: &str| folder.run(&format!("simulate {BODY} {options}"));
    let report = |options: &str| run(&format!("{options} --format json")).ok();
    for (step, expected) in [("0.1", 0), ("0.5", 0), ("2.2", 1)] {
        let report = warned(report(&format!("--step {step} --time 22")), expected);
        if expected == 1 {
            let ratio = report["warnings"][0]["ratio"].as_f64().unwrap();
            assert!((0.25..0.5).contains(&ratio), "{ratio}");
            assert!(report["warnings"][0]["step"].as_u64().unwrap() >= 1);
        }
    }
    let text = run("--step 2.2 --time 22").ok();
    text.prints(&["  warning: the series hardly converges: from step "]);
    // The ratio changes along the motion: the warning names the first step that is worth one.
    let ran = report("--step 2.1 --time 21").says(&["from step 2, at time 2.1,"]);
    let warning = &warned(ran, 1)["warnings"][0];
    assert!(warning["step"] == 2 && warning["time"] == 2.1, "{warning}");
    // Steps are refused above twice that.
    run("--step 3 --time 30").fails(1, &["a step of "]);
}

#[test]
fn check_and_ensemble_tell_it_too() {
    let folder = Folder::with(
        "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x^2/2 + y^2/6 + z^2/7\"\n\
         [initial]\nmomentum = [0.4, 2.4, 2.0]\n",
    );
    warned(folder.run(&format!("check {BODY} --step 0.1 --format json")).ok(), 0);
    warned(folder.run("check system.toml --step 1.2 --format json"), 1);
    for (momentum, expected) in [("0.2,0.1,0.1", 0), ("1.5,1.5,0.5", 1)] {
        folder.write("states.csv", format!("mu_1,mu_2,mu_3\n0.1,0,0.1\n{momentum}\n"));
        let advance = "--initial states.csv --out ends.csv --step 2.2 --time 22 --format json";
        warned(folder.run(&format!("ensemble {BODY} {advance}")).ok(), expected);
    }
}
