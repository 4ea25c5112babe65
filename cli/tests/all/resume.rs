//! Runs and trainings that are killed or interrupted go on from their checkpoints to the same bits.
#![cfg(unix)]

use std::path::Path;
use std::process::{Child, Command, Output};
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

use crate::support::{Folder, root, said};

const KEEP: &str = " --checkpoint state --checkpoint-interval 0.001";

/// A folder with a system and a learned model.
fn place() -> Folder {
    let place = Folder::new();
    std::fs::copy(root().join("examples/rigid_body.toml"), place.at("body.toml")).unwrap();
    place
}

/// Records every 3rd step and between steps, and a picture.
fn body(out: &str) -> String {
    format!(
        "simulate body.toml --time 8000 --every 3 --at 0.55,77.77,150.01 --format json --out {out} --plot {out}.svg"
    )
}

/// A run of the learned map.
fn learned(out: &str) -> String {
    format!("simulate --model model.json --start 2,0.5,1 --time 1000 --format json --out {out}")
}

/// Waits until a file has been written, and replaced `times` times.
fn wait_for(child: &mut Child, file: &Path, times: usize) {
    let mut seen: Vec<Vec<u8>> = Vec::new();
    while child.try_wait().unwrap().is_none() {
        if let Ok(now) = std::fs::read(file)
            && seen.last() != Some(&now)
        {
            seen.push(now);
        }
        if seen.len() > times {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the run ended before it was stopped");
}

fn start(place: &Folder, arguments: &str) -> Child {
    let _ = std::fs::remove_file(place.at("state"));
    let mut child = place.command(arguments).spawn().unwrap();
    wait_for(&mut child, &place.at("state"), 1);
    child
}

/// Report, records and picture of the run that went on are those of the run that was not stopped.
fn same(place: &Folder, whole: &Output, resumed: &Output, out: &str) {
    let error = said(resumed);
    assert!(resumed.status.success(), "{error}");
    assert!(error.contains("going on from state at step ") && !error.contains("at step 0 of"));
    let whole_name = format!("whole.{}", out.split('.').nth(1).unwrap());
    for ending in ["", ".svg"] {
        let [a, b] =
            [&whole_name, out].map(|name| std::fs::read(place.at(&format!("{name}{ending}"))).ok());
        assert!(a == b, "{out}{ending}");
    }
    let report = |output: &Output| String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(report(whole).replace(&whole_name, out), report(resumed));
    assert!(!place.at(&format!("{out}.partial")).exists());
}

#[test]
fn a_killed_run_ends_with_the_same_bits() {
    for out in ["t.csv", "t.npy"] {
        let place = place();
        let whole = place.run(&body(&format!("whole.{}", &out[2..])));
        assert!(whole.status.success());
        let mut child = start(&place, &(body(out) + KEEP));
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!place.at(out).exists() && place.at(&format!("{out}.partial")).exists());
        let resumed = place.run(&(body(out) + KEEP));
        same(&place, &whole, &resumed, out);

        // Once more it is only told of.
        let before = place.bytes(out);
        let again = place.run(&(body(out) + KEEP));
        assert!(again.status.success() && said(&again).contains("this run has finished"));
        assert_eq!(again.stdout, resumed.stdout);
        assert!(place.bytes(out) == before);
    }
}

/// Of a system and of a learned map.
#[test]
fn an_interrupted_run_leaves_a_whole_part_and_goes_on() {
    let place = place();
    place.pairs("train.csv", 40, 1);
    assert!(place.run("learn train.csv --dt 0.1 --degree 2 --out model.json").status.success());
    for (signal, run, out) in [
        (Signal::INT, body as fn(&str) -> String, "i.csv"),
        (Signal::TERM, body, "e.csv"),
        (Signal::INT, learned, "l.csv"),
        (Signal::INT, learned, "l.npy"),
    ] {
        let _ = std::fs::remove_file(place.at("whole.csv.svg"));
        let whole = place.run(&run(&format!("whole.{}", &out[2..])));
        let child = start(&place, &(run(out) + KEEP));
        kill_process(Pid::from_child(&child), signal).unwrap();
        let output = child.wait_with_output().unwrap();
        let error = said(&output);
        assert_eq!(output.status.code(), Some(130), "{error}");
        assert!(error.contains("interrupted at time ") && error.contains("goes on from state"));
        assert!(place.at(&format!("{out}.partial")).exists() && !place.at(out).exists());
        if out == "i.csv" {
            let part = place.text("i.csv.partial");
            let (last, row) = (part.lines().last().unwrap(), part.lines().rev().nth(1).unwrap());
            assert!(last.starts_with("# part: interrupted at time "), "{last}");
            assert_eq!(row.split(',').count(), 17);
        }
        same(&place, &whole, &place.run(&(run(out) + KEEP)), out);
    }
}

#[test]
fn another_run_is_refused_by_name() {
    let place = place();
    let run = body("t.csv") + KEEP;
    let mut child = start(&place, &run);
    child.kill().unwrap();
    child.wait().unwrap();
    let refused = |run: &str, expected: &str| {
        let output = place.run(run);
        let error = said(&output);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(expected), "{expected}: {error}");
    };
    refused(&format!("{run} --step 0.05"), "another step: 0.1 then, 0.05 now");
    refused(&format!("{run} --truncation 5"), "another truncation:");
    refused(&format!("{run} --chart cayley"), "another chart:");
    refused(&(body("other.csv") + KEEP), "another out:");
    // The file of records is gone.
    std::fs::rename(place.at("t.csv.partial"), place.at("away")).unwrap();
    refused(&run, "bring the file back");
    std::fs::rename(place.at("away"), place.at("t.csv.partial")).unwrap();
    // A comment changes nothing that is run, but is another text.
    let text = place.text("body.toml");
    place.write("body.toml", format!("{text}# more\n"));
    refused(&run, "another system_sha256:");
    place.write("body.toml", text);
    place.write("state", "{}");
    refused(&run, "is no checkpoint of this version");
}

#[test]
fn a_killed_training_ends_with_the_same_model() {
    let place = Folder::new();
    place.pairs("train.csv", 100, 1);
    let learn = |out: &str| -> Command {
        let network = "--model network --widths 40,40 --evaluations 1500";
        place.command(&format!("learn train.csv --dt 0.1 {network} --out {out}"))
    };
    assert!(learn("whole.json").status().unwrap().success());
    let mut child = learn("killed.json").spawn().unwrap();
    let checkpoint = place.at("killed.json.checkpoint.network");
    wait_for(&mut child, &checkpoint, 0);
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!place.at("killed.json").exists());
    assert!(learn("killed.json").status().unwrap().success());
    assert!(place.bytes("whole.json") == place.bytes("killed.json"));
    assert!(!checkpoint.exists());
}
