//! A learned map is run by the driver of all other runs: parts, formats, no number that is not finite.

use serde_json::Value;

use crate::support::{Folder, said};

/// A folder with a learned map.
fn place() -> Folder {
    let place = Folder::new();
    place.pairs("train.csv", 40, 1);
    let learned = place.run("learn train.csv --group SO3 --dt 0.1 --degree 2 --out model.json");
    assert!(learned.status.success(), "{}", said(&learned));
    place
}

const RUN: &str = "simulate --model model.json --out run.csv";

#[test]
fn reports_and_files_are_those_of_every_run() {
    let place = place();
    let output = place.run(&format!("{RUN} --start 2,0.5,1 --time 1000 --every 100 --format json"));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["method"], "learned polynomial, exp");
    for number in [
        &report["drift"]["casimirs"],
        &report["drift"]["spatial_momentum"],
        &report["solver"]["max_residual"],
    ] {
        assert!(number.as_f64().unwrap() < 1e-10, "{report}");
    }
    assert!(report.get("energy").is_none() && report["drift"].get("energy").is_none());
    let text = place.text("run.csv");
    assert!(text.contains("# model: model.json") && text.contains("# complete: 101 records"));
    let names = text.lines().find(|line| !line.starts_with('#')).unwrap();
    assert_eq!(
        names,
        "time,mu_1,mu_2,mu_3,g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33,spatial_momentum_drift,casimir_drift"
    );
    let verified = place.run("verify run.csv");
    assert!(verified.status.code() == Some(2) && said(&verified).contains("learned map"));
}

/// A number that is not finite ends the run with the time, and the records up to there stay. The map has one step: another
/// time is refused, not rounded.
#[test]
fn what_cannot_be_run_is_refused() {
    let place = place();
    for (options, code, words) in [
        ("--start nan,0,0 --time 10", 2, "--start: NaN is no finite number"),
        ("--start 1e200,0,0 --time 10", 1, "at time 0, step "),
        ("--start 2,0.5,1 --time 0.25", 2, "no whole number of steps"),
    ] {
        let output = place.run(&format!("{RUN} {options}"));
        assert_eq!(output.status.code(), Some(code), "{options}: {}", said(&output));
        assert!(said(&output).contains(words), "{}", said(&output));
        assert!(!place.at("run.csv").exists());
    }
    assert!(place.run(&format!("{RUN} --start 2,0.5,1 --time 0.3")).status.success());
}
