//! A learned map is run by the driver of all other runs: parts, checkpoints, formats, no number that is not finite.
#![cfg(unix)]

use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use crate::support::run;
use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;

/// A folder with a learned map and its runs.
struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        let wide = MomentumBox { low: -2.0, high: 2.0 };
        let pairs = phase_pairs(&SO3::new(), &Quadratic::paper(), 0.1, wide, 40, 1);
        write_pairs(&place.at("train.csv"), &SO3::new(), &pairs).unwrap();
        let [data, model] = ["train.csv", "model.json"].map(|name| place.name(name));
        let learn =
            ["learn", &data, "--group", "SO3", "--dt", "0.1", "--degree", "2", "--out", &model];
        let (code, _, error) = run(&learn);
        assert_eq!(code, 0, "{error}");
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.at(name).to_str().unwrap().to_owned()
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.at(name)).unwrap()
    }

    fn command(&self, out: &str, more: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
        command.current_dir(self.0.path()).args(["simulate", "--model", "model.json"]);
        command.args(["--start", "2,0.5,1", "--time", "1000", "--format", "json", "--out", out]);
        command.args(more).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, out: &str, more: &[&str]) -> Output {
        self.command(out, more).output().unwrap()
    }
}

/// Waits until a checkpoint has been written.
fn wait_for_state(child: &mut Child, place: &Place) {
    while child.try_wait().unwrap().is_none() {
        if place.at("state").exists() {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the run ended before it was stopped");
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bits() {
    let place = Place::new();
    let keep = ["--checkpoint", "state", "--checkpoint-interval", "0.001"];
    for name in ["run.csv", "run.npy"] {
        let whole = format!("whole.{}", &name[4..]);
        assert!(place.run(&whole, &[]).status.success());
        let _ = std::fs::remove_file(place.at("state"));
        let mut child = place.command(name, &keep).spawn().unwrap();
        wait_for_state(&mut child, &place);
        kill_process(Pid::from_child(&child), Signal::INT).unwrap();
        let output = child.wait_with_output().unwrap();
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{error}");
        assert!(error.contains("interrupted at time ") && error.contains("goes on from state"));
        assert!(place.at(&format!("{name}.partial")).exists() && !place.at(name).exists());
        let resumed = place.run(name, &keep);
        assert!(resumed.status.success(), "{}", String::from_utf8_lossy(&resumed.stderr));
        assert!(place.bytes(name) == place.bytes(&whole), "{name}");
        assert!(!place.at(&format!("{name}.partial")).exists());
    }
}

#[test]
fn reports_and_files_are_those_of_every_run() {
    let place = Place::new();
    let output = place.run("run.csv", &["--every", "100"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["method"], "learned polynomial, exp");
    assert!(report["drift"]["casimirs"].as_f64().unwrap() < 1e-10);
    assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-10);
    assert!(report.get("energy").is_none() && report["drift"].get("energy").is_none());
    assert!(report["solver"]["max_residual"].as_f64().unwrap() < 1e-10);
    let text = String::from_utf8(place.bytes("run.csv")).unwrap();
    assert!(text.contains("# model: model.json") && text.contains("# complete: 101 records"));
    let names = text.lines().find(|line| !line.starts_with('#')).unwrap();
    assert_eq!(
        names,
        "time,mu_1,mu_2,mu_3,g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33,spatial_momentum_drift,casimir_drift"
    );
    let (code, _, error) = run(&["verify", &place.name("run.csv")]);
    assert!(code == 2 && error.contains("learned map"), "{error}");
}

/// A number that is not finite ends the run with the time, and the records up to there stay.
#[test]
fn what_is_not_finite_ends_the_run() {
    let place = Place::new();
    for (start, code, words) in
        [("nan,0,0", 2, "--start: NaN is no finite number"), ("1e200,0,0", 1, "at time 0, step ")]
    {
        let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
        command.current_dir(place.0.path()).args(["simulate", "--model", "model.json"]);
        command.args(["--time", "10", "--out", "bad.csv", "--start", start]);
        let output = command.output().unwrap();
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{start}: {error}");
        assert!(error.contains(words), "{error}");
        assert!(!place.at("bad.csv").exists());
    }
}
