//! The records of `simulate`: times, columns, written as the run goes, and kept when it fails.

use std::path::Path;
use std::process::Stdio;

use crate::support::{Folder, json, root, run, system};

const BODY: &str = "examples/rigid_body.toml";

/// The lines of a file of records without comments: names, then records.
fn table(text: &str) -> Vec<Vec<String>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn read(path: &Path) -> Vec<Vec<String>> {
    table(&std::fs::read_to_string(path).unwrap())
}

fn simulate(arguments: &[&str]) -> String {
    let (code, out, error) = run(&[&["simulate"], arguments].concat());
    assert_eq!(code, 0, "{arguments:?}: {error}");
    out
}

/// SL(2) is not compact: this motion leaves every bound. Its records up to there stay, and say so.
#[test]
fn a_run_that_fails_leaves_its_records() {
    let (folder, system) = system(
        "group = \"SL2\"\nhamiltonian = \"mu[0]^2/2+mu[1]*mu[2]\"\n[integrator]\ntruncation = 3\n\
         step = 0.1\n[initial]\nmomentum = [1,0.5,0.5]\n[run]\ntime = 10000\n",
    );
    for name in ["t.csv", "t.npy"] {
        let out = folder.at(name);
        let (code, _, error) = run(&["simulate", &system, "--out", out.to_str().unwrap()]);
        assert_eq!(code, 1, "{error}");
        assert!(error.contains(", step ") && error.contains(&format!("{name}.partial")), "{error}");
        assert!(!out.exists());
        let part = folder.at(&format!("{name}.partial"));
        let time = error.split("at time ").nth(1).unwrap().split(',').next().unwrap();
        let time: f64 = time.parse().unwrap();
        assert!(time > 1.0);
        if name == "t.csv" {
            let text = std::fs::read_to_string(&part).unwrap();
            let last = text.lines().last().unwrap();
            assert!(last.starts_with("# part: at time "), "{last}");
            let rows = table(&text);
            // Time, momentum, element and energy; drifts that rounding hides are no numbers.
            let state = rows[1..].iter().flat_map(|row| &row[..9]);
            assert!(state.into_iter().all(|x| x.parse::<f64>().unwrap().is_finite()));
            let end: f64 = rows.last().unwrap()[0].parse().unwrap();
            assert!((time - end).abs() < 0.11, "{time} {end}");
        } else {
            let bytes = std::fs::read(&part).unwrap();
            let array = npyz::NpyFile::new(&bytes[..]).unwrap();
            assert!(array.shape()[0] > 10);
            let values = array.into_vec::<f64>().unwrap();
            assert!(values.chunks(12).flat_map(|row| &row[..9]).all(|value| value.is_finite()));
            let about = std::fs::read_to_string(folder.at("t.npy.json")).unwrap();
            assert!(about.contains("\"complete\": false"));
        }
    }
}

/// The head of a file says what is needed to repeat and judge the run.
#[test]
fn files_say_what_they_are() {
    let folder = Folder::new();
    let out = folder.at("t.csv");
    let comoving = ["--step", "0.3", "--chart", "exp", "--solver", "newton"];
    let name = out.to_str().unwrap();
    simulate(&[&[BODY, "--time", "1", "--truncation", "9", "--out", name], &comoving[..]].concat());
    let text = std::fs::read_to_string(&out).unwrap();
    for line in [
        "# system: examples/rigid_body.toml",
        "# system_sha256: ",
        "# name: rigid-body",
        "# group: SO3",
        "# truncation: 9",
        "# chart: exp",
        "# frame: fixed",
        "# solver: newton",
        "# step: 0.25",
        "# step_asked: 0.3",
        "# steps: 4",
        "# time: 1",
        "# initial_momentum: 2,0.5,1",
        "# complete: 5 records",
    ] {
        assert!(text.lines().any(|found| found.starts_with(line)), "{line}\n{text}");
    }
    assert!(!folder.at("t.csv.partial").exists());
}

/// The names are those of the file; numbers are short, with exponents, and read back exactly.
#[test]
fn columns_and_numbers_can_be_read() {
    let top = table(&simulate(&["examples/heavy_top.toml", "--time", "1", "--out", "-"]));
    assert_eq!(top[0][..7], ["time", "Pi_x", "Pi_y", "Pi_z", "Gamma_x", "Gamma_y", "Gamma_z"]);
    assert_eq!(top[0][7..9], ["g_11", "g_12"]);
    let longest = top.iter().flatten().map(String::len).max().unwrap();
    assert!(longest <= 24, "{longest}");
    assert!(top.iter().flatten().any(|cell| cell.contains("e-")), "no small number");

    let text = std::fs::read_to_string(root().join(BODY)).unwrap();
    let unnamed = text.lines().filter(|line| !line.starts_with("coordinates")).collect::<Vec<_>>();
    let unnamed = unnamed.join("\n").replace("x^2", "mu[0]^2").replace("y^2", "mu[1]^2");
    let (_folder, system) = system(&unnamed.replace("z^2", "mu[2]^2"));
    let rows = table(&simulate(&[&system, "--time", "1", "--out", "-"]));
    assert_eq!(rows[0][..4], ["time", "mu_1", "mu_2", "mu_3"]);
    // A potential couples the factors; of their matrices the blocks are written still.
    let satellite = table(&simulate(&["examples/satellite.toml", "--time", "0.1", "--out", "-"]));
    assert_eq!(satellite[0].iter().filter(|name| name.starts_with("g_")).count(), 9 + 4);
}

/// Records between the steps are as accurate as steps, and change nothing.
#[test]
fn times_between_steps_change_no_bit() {
    let folder = Folder::new();
    let plain = table(&simulate(&[BODY, "--time", "4", "--out", "-"]));
    let times = "3.99,0.37,0.3,1.25,4,0";
    let at = table(&simulate(&[BODY, "--time", "4", "--at", times, "--out", "-"]));
    let found: Vec<&str> = at[1..].iter().map(|row| row[0].as_str()).collect();
    assert_eq!(found, ["0", "0.3", "0.37", "1.25", "3.99", "4"]);
    // On the grid it is the grid's own state.
    assert_eq!(at[2][1..], plain[4][1..]);
    assert_eq!(at[6], plain[41]);
    for (row, time) in [(3, "0.37"), (4, "1.25"), (5, "3.99")] {
        let exact = json(&[
            "simulate",
            BODY,
            "--time",
            time,
            "--step",
            "0.01",
            "--truncation",
            "9",
            "--format",
            "json",
        ]);
        for i in 0..3 {
            let value: f64 = at[row][1 + i].parse().unwrap();
            assert!((value - exact["momentum"][i].as_f64().unwrap()).abs() < 1e-11, "{time}");
        }
    }
    // Besides every step, from a file.
    let list = folder.at("times");
    std::fs::write(&list, "# two times\n0.37 1.25\n").unwrap();
    let arguments = [BODY, "--time", "4", "--every", "1", "--at", list.to_str().unwrap()];
    let both = table(&simulate(&[&arguments[..], &["--out", "-"]].concat()));
    let grid: Vec<_> =
        both.iter().filter(|row| !["0.37", "1.25"].contains(&row[0].as_str())).cloned().collect();
    assert_eq!(both.len(), plain.len() + 2);
    assert_eq!(grid, plain);

    for (times, said) in [
        ("5", "5 is not between 0 and the end, 4"),
        ("-1", "-1 is not between"),
        ("nan", "NaN is not between"),
        ("nothing", "neither numbers"),
        ("", "neither numbers"),
    ] {
        let (code, _, error) = run(&["simulate", BODY, "--time", "4", "--at", times, "--out", "-"]);
        assert!(code == 2 && error.contains(said), "{times}: {error}");
    }
}

/// With several truncations each file is announced.
#[test]
fn several_truncations_announce_their_files() {
    let folder = Folder::new();
    let out = folder.at("t.csv");
    let name = out.to_str().unwrap();
    let arguments = ["simulate", BODY, "--time", "1", "--truncation", "3,5", "--out", name];
    let (code, report, error) = run(&arguments);
    assert_eq!(code, 0, "{error}");
    for name in ["t-K3.csv", "t-K5.csv"] {
        assert!(error.contains(name) && report.contains(name), "{error}{report}");
        assert_eq!(read(&folder.at(name)).len(), 12);
    }
    assert!(!out.exists());
    let (code, _, error) = run(&["simulate", BODY, "--truncation", "3,5", "--out", "-"]);
    assert!(code == 2 && error.contains("several files"), "{error}");
}

/// Names that cannot work are refused before anything is computed, by their option.
#[test]
fn names_are_looked_at_first() {
    let slow = "examples/zeitlin_5.toml";
    for (arguments, said) in [
        (&["--plot", "x.png"][..], "--plot x.png: only SVG"),
        (&["--plot", "none/x.svg"], "there is no folder none"),
        (&["--out", "none/t.csv"], "there is no folder none"),
        (&["--out", "t.xls"], ".csv or .npy"),
        (&["--out", "examples"], "this is a folder"),
        (&["--checkpoint", "none/c"], "there is no folder none"),
        (&["--checkpoint", "c", "--truncation", "3,5"], "give one --truncation"),
        (&["--checkpoint", "c", "--out", "-"], "write to a file"),
        (&["--checkpoint", "t.csv", "--out", "t.csv"], "t.csv is the same file"),
        (&["--at", "1"], "--out"),
    ] {
        let (code, _, error) = run(&[&["simulate", slow], arguments].concat());
        assert!(code == 2 && error.contains(said), "{arguments:?}: {error}");
    }
    assert!(!root().join("x.png").exists());
}

/// Records alone are on the standard output; the report is not among them. A device is written as it is.
#[cfg(unix)]
#[test]
fn records_go_to_the_standard_output_and_to_devices() {
    let (code, out, error) = run(&["simulate", BODY, "--time", "1", "--out", "-"]);
    assert_eq!(code, 0);
    assert!(out.ends_with("# complete: 11 records\n") && error.contains("10 steps to time 1"));
    let (code, report, _) = run(&["simulate", BODY, "--time", "1", "--out", "/dev/null"]);
    assert!(code == 0 && report.contains("11 records in /dev/null"), "{report}");
    assert!(!Path::new("/dev/null.partial").exists());
}

/// Records are on the disk while the run goes on, and memory does not grow with their number.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_steps() {
    let (folder, system) = system(
        "group = \"SO3\"\nhamiltonian = \"mu[0]^2/2\"\n[integrator]\ntruncation = 1\nstep = 0.1\n\
         [initial]\nmomentum = [1, 0.2, 0]\n[run]\ntime = 1500\n",
    );
    let out = folder.at("t.csv");
    let part = folder.at("t.csv.partial");
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_coadjoint"));
    command.args(["simulate", &system, "--out"]).arg(&out).stdout(Stdio::null());
    let mut child = command.spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    // The largest memory of the process so far, in kB, when the first records are there and last of all.
    let (mut first, mut last, mut seen) = (None, 0, 0);
    while child.try_wait().unwrap().is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find(|line| line.starts_with("VmHWM:"));
        let peak: Option<u64> = line.and_then(|l| l.split_whitespace().nth(1)?.parse().ok());
        let length = std::fs::metadata(&part).map_or(0, |data| data.len());
        if let Some(peak) = peak.filter(|_| length > 100_000) {
            (first, last, seen) = (first.or(Some(peak)), peak, length);
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let whole = std::fs::metadata(&out).unwrap().len();
    let first = first.expect("no record was on the disk before the end");
    assert!(seen > whole / 2, "{seen} of {whole} bytes were seen");
    assert!(last - first < 1024, "memory grew from {first} to {last} kB");
    assert_eq!(read(&out).len(), 15_002);
}

/// On a terminal, the command says what it is deriving.
#[cfg(unix)]
#[test]
fn setup_shows_progress_on_a_terminal() {
    use std::io::Read;

    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

    let options = ["examples/heavy_top.toml", "--truncation", "9"];
    for (verb, more, word) in [
        ("simulate", &["--time", "0.5"][..], "deriving the series, K = 9"),
        ("emit", &[], "deriving S and writing it"),
    ] {
        let terminal = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&terminal).unwrap();
        unlockpt(&terminal).unwrap();
        let name = ptsname(&terminal, Vec::new()).unwrap().into_string().unwrap();
        let other = std::fs::OpenOptions::new().read(true).write(true).open(name).unwrap();
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_coadjoint"));
        command.current_dir(root()).env("TERM", "xterm").stdout(Stdio::null()).stderr(other);
        command.arg(verb).args(options).args(more);
        let mut child = command.spawn().unwrap();
        drop(command);
        let mut shown = Vec::new();
        let mut piece = [0; 4096];
        let mut terminal = std::fs::File::from(terminal);
        // An error once nobody writes any more.
        while let Ok(length @ 1..) = terminal.read(&mut piece) {
            shown.extend_from_slice(&piece[..length]);
        }
        assert!(child.wait().unwrap().success());
        let shown = String::from_utf8_lossy(&shown);
        assert!(shown.contains(word), "{word}: {shown}");
    }
    // Not on a pipe.
    let (_, _, error) = run(&["simulate", BODY, "--time", "1"]);
    assert_eq!(error, "");
}
