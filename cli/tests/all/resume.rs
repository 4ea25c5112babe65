//! Runs and trainings that are killed or interrupted go on from their checkpoints to the same bits.
#![cfg(unix)]

use std::process::Child;
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

use crate::support::{BODY, Folder, Ran, text_of};

const KEEP: &str = " --checkpoint state --checkpoint-interval 0.001";

/// A folder with a system.
fn place() -> Folder {
    let place = Folder::new();
    place.write("body.toml", text_of(BODY));
    place.write("smooth.toml", text_of("examples/relativistic_body.toml"));
    // Pairs to learn from.
    let case = text_of("cli/tests/cases/learn.case");
    place.write(
        "train.csv",
        case.split("== train.csv\n").nth(1).unwrap().split("== ").next().unwrap(),
    );
    place
}

/// Records every 3rd step and between steps, and a picture. By one backend: a report names those that made its own steps.
fn body(out: &str) -> String {
    format!(
        "simulate body.toml --backend interpreter --time 8000 --every 3 --at 0.55,77.77,150.01 --format json --out {out} \
         --plot {out}.svg"
    )
}

/// A run of the learned map.
fn learned(out: &str) -> String {
    format!("simulate --model model.json --start 2,0.5,1 --time 1000 --format json --out {out}")
}

/// Steps by collocation, which are guessed from those before them.
fn smooth(out: &str) -> String {
    format!(
        "simulate smooth.toml --backend interpreter --time 4000 --every 3 --format json --out {out}"
    )
}

/// A lattice, by collocation or by rotations.
fn magnet(method: &str, out: &str) -> String {
    format!("simulate {method}.toml --every 3 --format json --out {out} --plot {out}.svg")
}

/// Starts a command, and waits until a file has been written and replaced `times` times.
fn start(place: &Folder, arguments: &str, file: &str, times: usize) -> Child {
    let _ = std::fs::remove_file(place.at(file));
    let mut child = place.command(arguments).spawn().unwrap();
    let mut seen: Vec<Vec<u8>> = Vec::new();
    while child.try_wait().unwrap().is_none() {
        if let Ok(now) = std::fs::read(place.at(file))
            && seen.last() != Some(&now)
        {
            seen.push(now);
        }
        if seen.len() > times {
            return child;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("the run ended before it was stopped");
}

fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Report, records and picture of the run that went on are those of the run that was not stopped.
fn same(place: &Folder, whole: &Ran, resumed: Ran, out: &str) {
    let resumed = resumed.ok().says(&["going on from state at step "]);
    assert!(!resumed.error.contains("at step 0 of"));
    let whole_name = format!("whole.{}", out.split('.').nth(1).unwrap());
    for ending in ["", ".svg"] {
        let [a, b] =
            [&whole_name, out].map(|name| std::fs::read(place.at(&format!("{name}{ending}"))).ok());
        assert!(a == b, "{out}{ending}");
    }
    assert_eq!(whole.out.replace(&whole_name, out), resumed.out);
    assert!(!place.has(&format!("{out}.partial")));
}

#[test]
fn a_killed_run_ends_with_the_same_bits() {
    for out in ["t.csv", "t.npy"] {
        let place = place();
        let whole = place.run(&body(&format!("whole.{}", &out[2..]))).ok();
        let run = body(out) + KEEP;
        kill(start(&place, &run, "state", 1));
        assert!(!place.has(out) && place.has(&format!("{out}.partial")));
        same(&place, &whole, place.run(&run), out);

        // Once more it is only told of.
        let before = place.bytes(out);
        let again = place.run(&run).ok().says(&["this run has finished"]);
        assert_eq!(again.out, whole.out.replace("whole.", "t."));
        assert!(place.bytes(out) == before);
    }
}

/// Of a system, by its series and by collocation, and of a learned map.
#[test]
fn an_interrupted_run_leaves_a_whole_part_and_goes_on() {
    let place = place();
    place.run("learn train.csv --dt 0.1 --degree 2 --out model.json").ok();
    for (signal, run, out) in [
        (Signal::INT, body as fn(&str) -> String, "i.csv"),
        (Signal::TERM, body, "e.csv"),
        (Signal::INT, smooth, "s.csv"),
        (Signal::INT, learned, "l.csv"),
        (Signal::INT, learned, "l.npy"),
    ] {
        let _ = std::fs::remove_file(place.at("whole.csv.svg"));
        let whole = place.run(&run(&format!("whole.{}", &out[2..])));
        let run = run(out) + KEEP;
        let child = start(&place, &run, "state", 1);
        kill_process(Pid::from_child(&child), signal).unwrap();
        let ran = Ran::of(&child.wait_with_output().unwrap());
        ran.fails(130, &["interrupted at time ", "goes on from state"]);
        let part = format!("{out}.partial");
        assert!(place.has(&part) && !place.has(out));
        if out == "i.csv" {
            let part = place.text(&part);
            let (last, row) = (part.lines().last().unwrap(), part.lines().rev().nth(1).unwrap());
            assert!(last.starts_with("# part: interrupted at time "), "{last}");
            assert_eq!(row.split(',').count(), 17);
        }
        same(&place, &whole, place.run(&run), out);
    }
}

#[test]
fn a_killed_run_of_a_lattice_ends_with_the_same_bits() {
    let place = Folder::new();
    let text = text_of("examples/lattices/skyrmion.toml")
        .replace("\ntime = 40", "\ntime = 8")
        .replace("step = 0.2", "step = 0.05");
    place.write("collocation.toml", text.clone() + "sites = [0, 119]\n");
    let turned =
        text.replace("damping = 0.3", "").replace("truncation = 3", "splitting = \"axes\"");
    place.write("rotations.toml", turned);
    for (method, out) in [("collocation", "c.csv"), ("rotations", "r.npy")] {
        let whole = place.run(&magnet(method, &format!("whole.{}", &out[2..]))).ok();
        let run = magnet(method, out) + KEEP;
        kill(start(&place, &run, "state", 1));
        place.refused(&[(&format!("{run} --step 0.02"), "another step: 0.05 then, 0.02 now")]);
        same(&place, &whole, place.run(&run), out);
        let again = place.run(&run).ok().says(&["this run has finished"]);
        assert_eq!(again.out, whole.out);
        std::fs::remove_file(place.at("state")).unwrap();
    }
    let run = magnet("collocation", "i.csv") + KEEP;
    let child = start(&place, &run, "state", 1);
    kill_process(Pid::from_child(&child), Signal::INT).unwrap();
    let ran = Ran::of(&child.wait_with_output().unwrap());
    ran.fails(130, &["interrupted at time ", "goes on from state"]);
    let whole = place.run(&magnet("collocation", "whole.csv")).ok();
    same(&place, &whole, place.run(&run), "i.csv");
}

#[test]
fn another_run_is_refused_by_name() {
    let place = place();
    let run = body("t.csv") + KEEP;
    kill(start(&place, &run, "state", 1));
    place.refused(&[
        (&format!("{run} --step 0.05"), "another step: 0.1 then, 0.05 now"),
        (&format!("{run} --truncation 5"), "another truncation:"),
        (&format!("{run} --chart cayley"), "another chart:"),
        (&(body("other.csv") + KEEP), "another out:"),
    ]);
    // The file of records is gone.
    std::fs::rename(place.at("t.csv.partial"), place.at("away")).unwrap();
    place.refused(&[(&run, "bring the file back")]);
    std::fs::rename(place.at("away"), place.at("t.csv.partial")).unwrap();
    // A comment changes nothing that is run, but is another text.
    place.write("body.toml", text_of(BODY) + "# more\n");
    place.refused(&[(&run, "another system_sha256:")]);
    place.write("body.toml", text_of(BODY));
    place.write("state", "{}");
    place.refused(&[(&run, "is no checkpoint of this version")]);
}

/// So is a run whose inputs are others: their table is no part of the text.
#[test]
fn a_run_with_other_inputs_is_refused() {
    let place = place();
    let text =
        place.text("smooth.toml").replacen("hamiltonian = \"", "hamiltonian = \"u*mu[0] + ", 1);
    place.write("smooth.toml", text + "\n[inputs]\ntable = \"u.csv\"\ntimes = \"t\"\nu = \"u\"\n");
    place.write("u.csv", "t,u\n0,0.1\n2000,0\n4000,0.1\n");
    let run = smooth("t.csv") + KEEP;
    kill(start(&place, &run, "state", 1));
    place.write("u.csv", "t,u\n0,0.1\n2000,0\n4000,0.2\n");
    place.refused(&[(&run, "another inputs_sha256:")]);
}

#[test]
fn a_killed_training_ends_with_the_same_model() {
    let place = place();
    let network =
        "learn train.csv --dt 0.1 --model network --widths 40,40 --evaluations 5000 --out";
    place.run(&format!("{network} whole.json")).ok();
    let checkpoint = "killed.json.checkpoint.network";
    kill(start(&place, &format!("{network} killed.json"), checkpoint, 0));
    assert!(!place.has("killed.json"));
    place.run(&format!("{network} killed.json")).ok();
    assert!(place.bytes("whole.json") == place.bytes("killed.json"));
    assert!(!place.has(checkpoint));
}
