//! A run that is killed or interrupted goes on from its checkpoint to the same bits.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use crate::support::root;
use rustix::process::{Pid, Signal, kill_process};

/// A folder with a system file and the runs of it.
struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        std::fs::copy(root().join("examples/rigid_body.toml"), place.at("body.toml")).unwrap();
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.at(name)).unwrap()
    }

    /// Records in `out`, every 3rd step and between steps, and a picture.
    fn command(&self, out: &str, more: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
        command.current_dir(self.0.path()).args(["simulate", "body.toml", "--time", "8000"]);
        command.args(["--every", "3", "--at", "0.55,77.77,150.01", "--format", "json"]);
        command.args(["--out", out, "--plot", &format!("{out}.svg")]).args(more);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, out: &str, more: &[&str]) -> Output {
        self.command(out, more).output().unwrap()
    }
}

const KEEP: [&str; 4] = ["--checkpoint", "state", "--checkpoint-interval", "0.01"];

/// Waits until a checkpoint has been written and replaced.
fn wait_for_second(child: &mut Child, state: &Path) {
    let mut first = None;
    while child.try_wait().unwrap().is_none() {
        let now = std::fs::read(state).ok();
        match (&first, now) {
            (None, now) => first = now,
            (Some(first), Some(now)) if *first != now => return,
            _ => {}
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the run ended before it was stopped");
}

/// Report, records and picture of the run that went on are those of the run that was not stopped.
fn same(place: &Place, whole: &Output, resumed: &Output, out: &str) {
    let error = String::from_utf8_lossy(&resumed.stderr);
    assert!(resumed.status.success(), "{error}");
    assert!(error.contains("going on from state at step "), "{error}");
    assert!(!error.contains("at step 0 of"), "{error}");
    let whole_name = format!("whole.{}", out.split('.').nth(1).unwrap());
    assert!(place.bytes(&whole_name) == place.bytes(out), "records");
    assert!(place.bytes(&format!("{whole_name}.svg")) == place.bytes(&format!("{out}.svg")));
    let report = |output: &Output| String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(report(whole).replace(&whole_name, out), report(resumed));
    assert!(!place.at(&format!("{out}.partial")).exists());
}

#[test]
fn a_killed_run_ends_with_the_same_bits() {
    for out in ["t.csv", "t.npy"] {
        let place = Place::new();
        let whole = place.run(&format!("whole.{}", &out[2..]), &[]);
        assert!(whole.status.success());
        let mut child = place.command(out, &KEEP).spawn().unwrap();
        wait_for_second(&mut child, &place.at("state"));
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!place.at(out).exists() && place.at(&format!("{out}.partial")).exists());
        same(&place, &whole, &place.run(out, &KEEP), out);

        // Once more it is only told of.
        let before = place.bytes(out);
        let again = place.run(out, &KEEP);
        assert!(again.status.success());
        let error = String::from_utf8_lossy(&again.stderr);
        assert!(error.contains("this run has finished"), "{error}");
        assert_eq!(
            String::from_utf8(again.stdout).unwrap().replace(out, "x"),
            String::from_utf8(whole.stdout).unwrap().replace(&format!("whole.{}", &out[2..]), "x")
        );
        assert!(place.bytes(out) == before);
    }
}

#[test]
fn an_interrupted_run_leaves_a_whole_part_and_goes_on() {
    let place = Place::new();
    let whole = place.run("whole.csv", &[]);
    for (signal, out) in [(Signal::INT, "i.csv"), (Signal::TERM, "e.csv")] {
        let _ = std::fs::remove_file(place.at("state"));
        let mut child = place.command(out, &KEEP).spawn().unwrap();
        wait_for_second(&mut child, &place.at("state"));
        kill_process(Pid::from_child(&child), signal).unwrap();
        let output = child.wait_with_output().unwrap();
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{error}");
        assert!(error.contains("interrupted at time ") && error.contains("goes on from state"));
        let part = String::from_utf8(place.bytes(&format!("{out}.partial"))).unwrap();
        let (last, rows) = (part.lines().last().unwrap(), part.lines().rev().nth(1).unwrap());
        assert!(last.starts_with("# part: interrupted at time "), "{last}");
        assert_eq!(rows.split(',').count(), 17);
        same(&place, &whole, &place.run(out, &KEEP), out);
    }
}

#[test]
fn another_run_is_refused_by_name() {
    let place = Place::new();
    let mut child = place.command("t.csv", &KEEP).spawn().unwrap();
    wait_for_second(&mut child, &place.at("state"));
    child.kill().unwrap();
    child.wait().unwrap();
    let refused = |more: &[&str], said: &str| {
        let output = place.run("t.csv", &[&KEEP[..], more].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(said), "{said}: {error}");
    };
    refused(&["--step", "0.05"], "another step: 0.1 then, 0.05 now");
    refused(&["--truncation", "5"], "another truncation:");
    refused(&["--chart", "cayley"], "another chart:");
    let output = place.run("other.csv", &KEEP);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("another out:"));
    // The file of records is gone.
    std::fs::rename(place.at("t.csv.partial"), place.at("away")).unwrap();
    refused(&[], "bring the file back");
    std::fs::rename(place.at("away"), place.at("t.csv.partial")).unwrap();
    // A comment changes nothing that is run, but is another text.
    let text = std::fs::read_to_string(place.at("body.toml")).unwrap();
    std::fs::write(place.at("body.toml"), format!("{text}# more\n")).unwrap();
    refused(&[], "another system_sha256:");
    std::fs::write(place.at("body.toml"), text).unwrap();
    std::fs::write(place.at("state"), "{}").unwrap();
    refused(&[], "is no checkpoint of this version");
}
