//! The records of `simulate`: times, columns, written as the run goes, and kept when it fails.

use std::process::Stdio;

use crate::support::{BODY, Folder, distance, json, numbers, refused, root, run, table, text_of};

/// The records that a run writes to the standard output.
fn records(folder: &Folder, arguments: &str) -> Vec<Vec<String>> {
    table(&folder.run(&format!("simulate {arguments} --out -")).ok().out)
}

/// SL(2) is not compact: this motion leaves every bound. Its records up to there stay, and say so.
#[test]
fn a_run_that_fails_leaves_its_records() {
    let folder = Folder::with(
        "group = \"SL2\"\nhamiltonian = \"mu[0]^2/2+mu[1]*mu[2]\"\n[integrator]\ntruncation = 3\n\
         step = 0.1\n[initial]\nmomentum = [1,0.5,0.5]\n[run]\ntime = 10000\n",
    );
    for name in ["t.csv", "t.npy"] {
        let part = format!("{name}.partial");
        let ran = folder.run(&format!("simulate system.toml --out {name}"));
        let error = ran.fails(1, &[", step ", &part]).error;
        assert!(!folder.has(name));
        let time = error.split("at time ").nth(1).unwrap().split(',').next().unwrap();
        let time: f64 = time.parse().unwrap();
        assert!(time > 1.0);
        if name == "t.csv" {
            let text = folder.text(&part);
            let last = text.lines().last().unwrap();
            assert!(last.starts_with("# part: at time "), "{last}");
            let rows = table(&text);
            // Time, momentum, element and energy; drifts that rounding hides are no numbers.
            let state = rows[1..].iter().flat_map(|row| &row[..9]);
            assert!(state.into_iter().all(|x| x.parse::<f64>().unwrap().is_finite()));
            let end: f64 = rows.last().unwrap()[0].parse().unwrap();
            assert!((time - end).abs() < 0.11, "{time} {end}");
        } else {
            let bytes = folder.bytes(&part);
            let array = npyz::NpyFile::new(&bytes[..]).unwrap();
            assert!(array.shape()[0] > 10);
            let values = array.into_vec::<f64>().unwrap();
            assert!(values.chunks(12).flat_map(|row| &row[..9]).all(|value| value.is_finite()));
            assert!(folder.text("t.npy.json").contains("\"complete\": false"));
        }
    }
}

/// The head of a file says what is needed to repeat and judge the run.
#[test]
fn files_say_what_they_are() {
    let folder = Folder::new();
    let options = "--time 1 --truncation 9 --step 0.3 --chart exp --solver newton --out t.csv";
    folder.run(&format!("simulate {BODY} {options}")).ok();
    let text = folder.text("t.csv");
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
    assert!(!folder.has("t.csv.partial"));
}

/// The names are those of the file; numbers are short, with exponents, and read back exactly.
#[test]
fn columns_and_numbers_can_be_read() {
    let unnamed = text_of(BODY);
    let unnamed: Vec<&str> =
        unnamed.lines().filter(|line| !line.starts_with("coordinates")).collect();
    let unnamed = unnamed.join("\n").replace("x^2", "mu[0]^2").replace("y^2", "mu[1]^2");
    let folder = Folder::with(&unnamed.replace("z^2", "mu[2]^2"));
    let top = records(&folder, "examples/heavy_top.toml --time 1");
    assert_eq!(top[0][..7], ["time", "Pi_x", "Pi_y", "Pi_z", "Gamma_x", "Gamma_y", "Gamma_z"]);
    assert_eq!(top[0][7..9], ["g_11", "g_12"]);
    let longest = top.iter().flatten().map(String::len).max().unwrap();
    assert!(longest <= 24, "{longest}");
    assert!(top.iter().flatten().any(|cell| cell.contains("e-")), "no small number");
    let rows = records(&folder, "system.toml --time 1");
    assert_eq!(rows[0][..4], ["time", "mu_1", "mu_2", "mu_3"]);
    // A potential couples the factors; of their matrices the blocks are written still.
    let satellite = records(&folder, "examples/satellite.toml --time 0.1");
    assert_eq!(satellite[0].iter().filter(|name| name.starts_with("g_")).count(), 9 + 4);
}

/// Records between the steps are as accurate as steps, and change nothing.
#[test]
fn times_between_steps_change_no_bit() {
    let folder = Folder::new();
    let run = |more: &str| records(&folder, &format!("{BODY} --time 4 {more}"));
    let (plain, at) = (run(""), run("--at 3.99,0.37,0.3,1.25,4,0"));
    let found: Vec<&str> = at[1..].iter().map(|row| row[0].as_str()).collect();
    assert_eq!(found, ["0", "0.3", "0.37", "1.25", "3.99", "4"]);
    // On the grid it is the grid's own state.
    assert_eq!(at[2][1..], plain[4][1..]);
    assert_eq!(at[6], plain[41]);
    for (row, time) in [(3, "0.37"), (4, "1.25"), (5, "3.99")] {
        let exact = json(&format!("simulate {BODY} --time {time} --step 0.01 --truncation 9"));
        let values: Vec<f64> = at[row][1..4].iter().map(|cell| cell.parse().unwrap()).collect();
        assert!(distance(&values, &numbers(&exact["momentum"])) < 1e-11, "{time}");
    }
    // Besides every step, from a file.
    folder.write("times", "# two times\n0.37 1.25\n");
    let both = run("--every 1 --at times");
    let grid = both.iter().filter(|row| !["0.37", "1.25"].contains(&row[0].as_str()));
    assert_eq!(both.len(), plain.len() + 2);
    assert!(grid.eq(&plain));
    for (times, said) in [
        ("5", "5 is not between 0 and the end, 4"),
        ("-1", "-1 is not between"),
        ("nan", "NaN is not between"),
        ("nothing", "neither numbers"),
        ("''", "neither numbers"),
    ] {
        folder.refused(&[(&format!("simulate {BODY} --time 4 --out - --at {times}"), said)]);
    }
}

/// With several truncations each file is announced.
#[test]
fn several_truncations_announce_their_files() {
    let folder = Folder::new();
    let names = ["t-K3.csv", "t-K5.csv"];
    let ran = folder.run(&format!("simulate {BODY} --time 1 --truncation 3,5 --out t.csv"));
    ran.ok().says(&names).prints(&names);
    names.iter().for_each(|name| assert_eq!(folder.table(name).len(), 12));
    assert!(!folder.has("t.csv"));
    refused(&[(&format!("simulate {BODY} --truncation 3,5 --out -"), "several files")]);
}

/// Names that cannot work are refused before anything is computed, by their option.
#[test]
fn names_are_looked_at_first() {
    for (arguments, said) in [
        ("--plot x.png", "--plot x.png: only SVG"),
        ("--plot none/x.svg", "there is no folder none"),
        ("--out none/t.csv", "there is no folder none"),
        ("--out t.xls", ".csv or .npy"),
        ("--out examples", "this is a folder"),
        ("--checkpoint none/c", "there is no folder none"),
        ("--checkpoint c --truncation 3,5", "give one --truncation"),
        ("--checkpoint c --out -", "write to a file"),
        ("--checkpoint t.csv --out t.csv", "t.csv is the same file"),
        ("--at 1", "--out"),
    ] {
        refused(&[(&format!("simulate examples/zeitlin_5.toml {arguments}"), said)]);
    }
    assert!(!root().join("x.png").exists());
}

/// Records alone are on the standard output; the report is not among them. A device is written as it is.
#[cfg(unix)]
#[test]
fn records_go_to_the_standard_output_and_to_devices() {
    let ran = run(&format!("simulate {BODY} --time 1 --out -")).ok().says(&["10 steps to time 1"]);
    assert!(ran.out.ends_with("# complete: 11 records\n"));
    let ran = run(&format!("simulate {BODY} --time 1 --out /dev/null")).ok();
    ran.prints(&["11 records in /dev/null"]);
    assert!(!std::path::Path::new("/dev/null.partial").exists());
}

/// Records are on the disk while the run goes on, and memory does not grow with their number.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_steps() {
    let folder = Folder::with(
        "group = \"SO3\"\nhamiltonian = \"mu[0]^2/2\"\n[integrator]\ntruncation = 1\nstep = 0.1\n\
         [initial]\nmomentum = [1, 0.2, 0]\n[run]\ntime = 1500\n",
    );
    let part = folder.at("t.csv.partial");
    let mut child = folder.command("simulate system.toml --out t.csv").spawn().unwrap();
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
    let whole = folder.bytes("t.csv").len() as u64;
    let first = first.expect("no record was on the disk before the end");
    assert!(seen > whole / 2, "{seen} of {whole} bytes were seen");
    assert!(last - first < 1024, "memory grew from {first} to {last} kB");
    assert_eq!(folder.table("t.csv").len(), 15_002);
}

/// On a terminal, the command says what it is deriving.
#[cfg(unix)]
#[test]
fn setup_shows_progress_on_a_terminal() {
    use std::io::Read;

    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

    let folder = Folder::new();
    for (arguments, word) in [
        ("simulate examples/heavy_top.toml --time 0.5", "deriving the series, K = 9"),
        ("emit examples/heavy_top.toml", "deriving S and writing it"),
    ] {
        let terminal = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&terminal).unwrap();
        unlockpt(&terminal).unwrap();
        let name = ptsname(&terminal, Vec::new()).unwrap().into_string().unwrap();
        let other = std::fs::OpenOptions::new().read(true).write(true).open(name).unwrap();
        let mut command = folder.command(&format!("{arguments} --truncation 9"));
        command.env("TERM", "xterm").stdout(Stdio::null()).stderr(other);
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
    assert_eq!(run(&format!("simulate {BODY} --time 1")).error, "");
}
