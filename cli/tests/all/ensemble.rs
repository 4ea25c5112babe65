//! `ensemble`: the end states of `simulate`, whatever the threads, shards, formats and accidents.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::support::{json, root, run};
use serde_json::Value;
use tempfile::TempDir;

const BODY: &str = "examples/rigid_body.toml";

/// Momenta of one file: no two rows alike.
fn momenta(rows: usize) -> String {
    let mut text = "mu_1,mu_2,mu_3\n".to_owned();
    for row in 0..rows {
        let x = row as f64 / rows as f64;
        text += &format!("{},{},{}\n", 2.0 - x, 0.5 + 0.3 * x * x, 1.0 + x);
    }
    text
}

fn at(directory: &TempDir, name: &str) -> String {
    directory.path().join(name).to_str().unwrap().to_owned()
}

fn written(directory: &TempDir, name: &str, text: &str) -> String {
    let path = at(directory, name);
    std::fs::write(&path, text).unwrap();
    path
}

/// Runs an ensemble of the rigid body.
fn ensemble(initial: &str, out: &str, more: &[&str]) -> Value {
    let mut arguments = vec!["ensemble", BODY, "--initial", initial, "--out", out];
    arguments.extend(["--format", "json"]);
    arguments.extend(more);
    json(&arguments)
}

fn bytes(path: &str) -> Vec<u8> {
    std::fs::read(path).unwrap()
}

/// The names of a directory that tell of an unfinished run.
fn left_over(directory: &TempDir) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(directory.path()).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let of_a_run = |path: &PathBuf| {
        let name = path.to_string_lossy().into_owned();
        name.contains(".partial") || name.contains(".journal")
    };
    paths.filter(of_a_run).collect()
}

/// A row with an attitude ends where `simulate` ends, to the rounding in which its group of tables
/// differs from the closed forms.
#[test]
fn a_row_ends_where_simulate_ends() {
    let directory = TempDir::new().unwrap();
    let names = "mu_1,mu_2,mu_3,g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33";
    let row = "2.0,0.5,1.0,1,0,0,0,1,0,0,0,1";
    let initial = written(&directory, "in.csv", &format!("{names}\n{row}\n"));
    let out = at(&directory, "out.csv");
    let summary = ensemble(&initial, &out, &[]);
    assert_eq!(summary["trajectories"], 1);
    assert_eq!(summary["steps"], 1000);
    assert!(summary["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-12);
    assert!(summary["drift"]["casimirs"].as_f64().unwrap() < 1e-12);
    let end = String::from_utf8(bytes(&out)).unwrap();
    let (header, end) = end.split_once('\n').unwrap();
    assert_eq!(header, names);
    let end: Vec<f64> = end.trim().split(',').map(|cell| cell.parse().unwrap()).collect();
    let single = json(&["simulate", BODY, "--format", "json"]);
    let mut expected = crate::support::numbers(&single["momentum"]);
    for row in single["group_element"].as_array().unwrap() {
        expected.extend(crate::support::numbers(row));
    }
    for (a, b) in end.iter().zip(&expected) {
        assert!((a - b).abs() < 1e-11, "{end:?}\n{expected:?}");
    }
}

/// SE(3) in closed form, SO(4) and a power of SO(3) by tables, and the Cayley chart: every engine
/// gives what `simulate` gives.
#[test]
fn every_kind_of_group_and_chart_runs() {
    let directory = TempDir::new().unwrap();
    for (file, chart) in [
        ("examples/heavy_top.toml", "exp"),
        ("examples/heavy_top.toml", "cayley"),
        ("examples/manakov_so4.toml", "exp"),
        ("examples/manakov_so4.toml", "cayley"),
        ("examples/rigid_body.toml", "cayley"),
        ("examples/heisenberg_spin_ring.toml", "exp"),
        ("examples/so21_by_brackets.toml", "exp"),
    ] {
        let text = std::fs::read_to_string(root().join(file)).unwrap();
        let line = text.lines().find(|line| line.starts_with("momentum = [")).unwrap();
        let list = line.split(['[', ']']).nth(1).unwrap();
        let cells: Vec<&str> = list.split(',').map(str::trim).collect();
        let names: Vec<String> = (1..=cells.len()).map(|i| format!("mu_{i}")).collect();
        let csv = format!("{}\n{}\n", names.join(","), cells.join(","));
        let initial = written(&directory, "in.csv", &csv);
        let out = at(&directory, "out.csv");
        let common = ["--chart", chart, "--truncation", "3", "--time", "0.5", "--step", "0.05"];
        let mut arguments = vec!["ensemble", file, "--initial", &initial, "--out", &out];
        arguments.extend(common);
        let (code, _, error) = run(&arguments);
        assert_eq!(code, 0, "{file}: {error}");
        let end = String::from_utf8(bytes(&out)).unwrap();
        let end: Vec<f64> =
            end.lines().nth(1).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
        let mut arguments = vec!["simulate", file, "--format", "json"];
        arguments.extend(common);
        let expected = crate::support::numbers(&json(&arguments)["momentum"]);
        assert_eq!(end.len(), expected.len());
        let size = expected.iter().fold(1.0, |a: f64, b| a.max(b.abs()));
        for (a, b) in end.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12 * size, "{file}, {chart}: {end:?}, {expected:?}");
        }
    }
}

#[test]
fn one_thread_and_two_write_the_same_bytes() {
    let directory = TempDir::new().unwrap();
    let initial = written(&directory, "in.csv", &momenta(2500));
    for ending in ["csv", "npy"] {
        let [one, two] = ["one", "two"].map(|name| at(&directory, &format!("{name}.{ending}")));
        ensemble(&initial, &one, &["--time", "1", "--threads", "1"]);
        ensemble(&initial, &two, &["--time", "1", "--threads", "2"]);
        assert!(bytes(&one) == bytes(&two), "{ending}");
    }
    assert_eq!(left_over(&directory), Vec::<PathBuf>::new());
}

/// Shares of unequal length, and more shares than rows.
#[test]
fn shards_together_are_the_whole() {
    let directory = TempDir::new().unwrap();
    for (rows, shards) in [(1003, 4), (2, 3)] {
        let initial = written(&directory, "in.csv", &momenta(rows));
        let whole = at(&directory, "whole.csv");
        ensemble(&initial, &whole, &["--time", "1"]);
        let mut joined = b"mu_1,mu_2,mu_3\n".to_vec();
        for shard in 1..=shards {
            let out = at(&directory, "shard.csv");
            ensemble(&initial, &out, &["--time", "1", "--shard", &format!("{shard}/{shards}")]);
            let part = bytes(&out);
            let body = part.strip_prefix(b"mu_1,mu_2,mu_3\n").unwrap();
            joined.extend(body);
        }
        assert!(joined == bytes(&whole), "{rows} rows, {shards} shards");
    }
}

/// An ensemble written in any format reads back the same.
#[test]
fn formats_agree() {
    let directory = TempDir::new().unwrap();
    let mut endings = vec!["csv", "npy"];
    if cfg!(feature = "parquet") {
        endings.push("parquet");
    }
    let first = written(&directory, "in.csv", &momenta(2100));
    let reference = at(&directory, "reference.csv");
    ensemble(&first, &reference, &["--time", "0.3", "--step", "0.3"]);
    let end = at(&directory, "end.csv");
    ensemble(&reference, &end, &["--time", "0.3", "--step", "0.3"]);
    for ending in endings {
        let middle = at(&directory, &format!("middle.{ending}"));
        ensemble(&first, &middle, &["--time", "0.3", "--step", "0.3"]);
        let out = at(&directory, &format!("from_{ending}.csv"));
        ensemble(&middle, &out, &["--time", "0.3", "--step", "0.3"]);
        assert!(bytes(&out) == bytes(&end), "{ending}");
        // A share begins in the middle of the file.
        let share = at(&directory, "share.csv");
        ensemble(&middle, &share, &["--time", "0.3", "--step", "0.3", "--shard", "2/3"]);
        let [all, share] = [&end, &share].map(|p| String::from_utf8(bytes(p)).unwrap());
        let all: Vec<&str> = all.lines().collect();
        assert_eq!(share.lines().skip(1).collect::<Vec<_>>(), all[701..1401], "{ending}");
    }
}

fn start(initial: &str, out: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_coadjoint"))
        .current_dir(root())
        .args(["ensemble", BODY, "--initial", initial, "--out", out])
        .stdout(Stdio::null())
        .spawn()
        .unwrap()
}

/// Waits until the run has noted something, and kills it.
fn kill_in_the_middle(mut child: Child, journal: &str) {
    while rows_noted(Path::new(journal)).is_none() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Killed as soon as something is noted and started again: the files are those of an undisturbed
/// run, and the second run began in the middle.
#[test]
fn a_killed_run_ends_with_the_same_bytes() {
    let directory = TempDir::new().unwrap();
    let initial = written(&directory, "in.csv", &(momenta(6000) + "bad,1,2\n"));
    for name in ["out.csv", "out.npy"] {
        let out = at(&directory, name);
        let journal = at(&directory, &format!("{name}.journal"));
        kill_in_the_middle(start(&initial, &out), &journal);
        // A machine so fast that the run ended before it was killed has nothing to resume.
        let stopped = Path::new(&journal).exists();
        let resumed = ensemble(&initial, &out, &[]);
        assert_eq!(resumed["resumed_at"].as_u64().unwrap() > 0, stopped);
        assert_eq!(resumed["failed"], 1);
        let straight = at(&directory, &format!("straight_{name}"));
        let undisturbed = ensemble(&initial, &straight, &[]);
        assert_eq!(undisturbed["resumed_at"], 0);
        assert!(bytes(&out) == bytes(&straight));
        let lists = [&out, &straight].map(|p| bytes(&format!("{p}.rejected.csv")));
        assert!(lists[0] == lists[1]);
        assert_eq!(resumed["drift"], undisturbed["drift"]);
    }
    assert_eq!(left_over(&directory), Vec::<PathBuf>::new());
}

fn rows_noted(journal: &Path) -> Option<u64> {
    let text = std::fs::read_to_string(journal).ok()?;
    serde_json::from_str::<Value>(&text).ok()?["rows"].as_u64()
}

/// A run that was stopped does not go on with other options or another input.
#[test]
fn a_changed_run_is_refused_until_told_to_begin_anew() {
    let directory = TempDir::new().unwrap();
    // Seconds of work: the journal is written after a fifth of one.
    let initial = written(&directory, "in.csv", &momenta(60_000));
    let out = at(&directory, "out.csv");
    let journal = at(&directory, "out.csv.journal");
    kill_in_the_middle(start(&initial, &out), &journal);
    assert!(Path::new(&journal).exists(), "ended before it was killed");
    let again = |more: &[&str]| {
        let mut arguments = vec!["ensemble", BODY, "--initial", &initial, "--out", &out];
        arguments.extend(more);
        run(&arguments)
    };
    let (code, _, error) = again(&["--step", "0.2"]);
    assert_eq!(code, 2);
    assert!(error.contains("number of steps: 1000 then, 500 now"), "{error}");
    std::fs::write(&initial, momenta(100)).unwrap();
    let (code, _, error) = again(&[]);
    assert_eq!(code, 2);
    assert!(error.contains("another initial file"), "{error}");
    let (code, _, error) = again(&["--restart"]);
    assert_eq!(code, 0, "{error}");
    assert_eq!(String::from_utf8(bytes(&out)).unwrap().lines().count(), 101);
}

/// Jobs of an array that are started again: what is finished stays, what is damaged is made again, and another command
/// is refused.
#[test]
fn a_finished_shard_is_kept() {
    let directory = TempDir::new().unwrap();
    let initial = written(&directory, "in.csv", &(momenta(60) + "bad,1,2\n"));
    let out = at(&directory, "out-3.csv");
    let options = ["--shard", "3/3", "--time", "1", "--keep"];
    assert_eq!(ensemble(&initial, &out, &options)["kept"], false);
    let files = [out.clone(), format!("{out}.rejected.csv"), format!("{out}.done")];
    let before = files.each_ref().map(|file| bytes(file));
    let note: Value = serde_json::from_slice(&before[2]).unwrap();
    assert_eq!(note["first_row"], 41);
    assert_eq!(note["journal"]["rows"], 21);
    let again = ensemble(&initial, &out, &options);
    assert_eq!((&again["kept"], &again["failed"]), (&true.into(), &1.into()));
    assert_eq!(again["trajectories"], 21);
    let mut arguments = vec!["ensemble", BODY, "--initial", &initial, "--out", &out];
    arguments.extend(options);
    let (code, report, _) = run(&arguments);
    assert_eq!(code, 0);
    assert!(report.contains("finished by an earlier run, and kept"), "{report}");
    arguments.extend(["--step", "0.2"]);
    let (code, _, error) = run(&arguments);
    assert_eq!(code, 2);
    assert!(error.contains("out-3.csv.done is of a run with another number of steps"), "{error}");
    // Damaged or lost, it is made again.
    for file in &files[..2] {
        std::fs::write(file, "1,2").unwrap();
        assert_eq!(ensemble(&initial, &out, &options)["kept"], false);
    }
    std::fs::remove_file(&out).unwrap();
    assert_eq!(ensemble(&initial, &out, &options)["kept"], false);
    assert!(files.each_ref().map(|file| bytes(file)) == before);
    // Made by another command without the option, the file has no note.
    ensemble(&initial, &out, &["--time", "2"]);
    assert!(!Path::new(&files[2]).exists());
    assert_eq!(left_over(&directory), Vec::<PathBuf>::new());
}

#[test]
fn bad_rows_are_told_and_do_not_stop_the_rest() {
    let directory = TempDir::new().unwrap();
    let rows = [
        "2,0.5,1,1,0,0,0",
        "2,inf,1,1,0,0,0",
        "2,0.5,1,1,1,0,0",
        "2,0.5,1,1,0,0",
        "2,0.5,one,1,0,0,0",
        "200,50,100,1,0,0,0",
        "2,0.5,1,1,0,0,0",
    ];
    let text = format!("mu_1,mu_2,mu_3,q_w,q_x,q_y,q_z\n{}\n", rows.join("\n"));
    let initial = written(&directory, "in.csv", &text);
    let out = at(&directory, "out.csv");
    let summary = ensemble(&initial, &out, &[]);
    assert_eq!(summary["trajectories"], 7);
    assert_eq!(summary["failed"], 5);
    let end = String::from_utf8(bytes(&out)).unwrap();
    let end: Vec<&str> = end.lines().skip(1).collect();
    assert_eq!(end.len(), 7);
    assert_eq!(end[0], end[6]);
    assert!(!end[0].contains("NaN"));
    for row in &end[1..6] {
        assert_eq!(*row, "NaN,NaN,NaN,NaN,NaN,NaN,NaN");
    }
    let list = String::from_utf8(bytes(&format!("{out}.rejected.csv"))).unwrap();
    let list: Vec<&str> = list.lines().collect();
    assert_eq!(list[0], "row,step,reason");
    assert_eq!(list[1], "2,0,\"mu_2 is inf\"");
    assert!(list[2].starts_with("3,0,\"the attitude is off the group by 4.1e-1"), "{list:?}");
    assert_eq!(list[3], "4,0,\"6 cells instead of 7\"");
    assert_eq!(list[4], "5,0,\"mu_3: 'one' is no number\"");
    // Far outside the chart; at which step it is noticed depends on rounding.
    assert!(list[5].starts_with("6,") && list[5].contains("leaves the chart"), "{list:?}");
    // Without bad rows the list of an earlier run goes away.
    written(&directory, "in.csv", &momenta(3));
    ensemble(&initial, &out, &[]);
    assert!(!Path::new(&format!("{out}.rejected.csv")).exists());
}

/// Columns that are not ours keep their names, their places and their text, also in rows that fail
/// and after a run that was stopped.
#[test]
fn other_columns_are_carried_through_unchanged() {
    let directory = TempDir::new().unwrap();
    let text = "id,mu_2, name ,mu_1,mu_3,note\n\
                7,0.5,\"a, \"\"b\"\"\",2,1,  two  blanks \n\
                # passed over\n\
                008,0.5,é,nan,1,\n\
                9,1,#hash,2,1e0,0.10\n";
    let initial = written(&directory, "in.csv", text);
    let out = at(&directory, "out.csv");
    let summary = ensemble(&initial, &out, &["--time", "1"]);
    assert_eq!((&summary["trajectories"], &summary["failed"]), (&3.into(), &1.into()));
    let end = String::from_utf8(bytes(&out)).unwrap();
    let lines: Vec<&str> = end.lines().collect();
    assert_eq!(lines.len(), 4);
    assert_eq!(lines[0], "id,mu_2,name,mu_1,mu_3,note");
    assert!(lines[1].starts_with("7,") && lines[1].ends_with(",  two  blanks "), "{end}");
    assert!(lines[1].contains(",\"a, \"\"b\"\"\","), "{end}");
    assert_eq!(lines[2], "008,NaN,é,NaN,NaN,");
    assert!(lines[3].contains(",\"#hash\",") && lines[3].ends_with(",0.10"), "{end}");
    // The numbers are those of a file without the other columns.
    let plain = written(&directory, "plain.csv", "mu_1,mu_2,mu_3\n2,0.5,1\n2,1,1\n");
    let plain_out = at(&directory, "plain_out.csv");
    ensemble(&plain, &plain_out, &["--time", "1"]);
    let plain = String::from_utf8(bytes(&plain_out)).unwrap();
    for (line, plain) in [lines[1], lines[3]].iter().zip(plain.lines().skip(1)) {
        for number in plain.split(',') {
            assert!(line.split(',').any(|cell| cell == number), "{line}\n{plain}");
        }
    }
    // The output can be read again: the second run carries the same cells.
    let again = at(&directory, "again.csv");
    ensemble(&out, &again, &["--time", "1"]);
    let again = String::from_utf8(bytes(&again)).unwrap();
    assert!(
        again.contains(",\"a, \"\"b\"\"\",") && again.contains("008,NaN,é,NaN,NaN,"),
        "{again}"
    );
    // A matrix has no room for them, and it is said.
    let npy = at(&directory, "out.npy");
    let arguments = ["ensemble", BODY, "--initial", &initial, "--out", &npy, "--time", "1"];
    let (code, _, error) = run(&arguments);
    assert_eq!(code, 0, "{error}");
    assert!(error.contains("not carried through") && error.contains("id, name, note"), "{error}");
}

#[test]
fn a_run_without_a_single_end_state_fails() {
    let directory = TempDir::new().unwrap();
    let out = at(&directory, "out.csv");
    for rows in ["2,inf,1\n2,x,1\n", "2000,500,1000\n"] {
        let initial = written(&directory, "in.csv", &format!("mu_1,mu_2,mu_3\n{rows}"));
        let (code, report, error) = run(&["ensemble", BODY, "--initial", &initial, "--out", &out]);
        assert_eq!(code, 1, "{error}");
        assert!(report.contains("trajectories of 1000 steps"), "{report}");
        let count = rows.lines().count();
        assert!(error.contains(&format!("all {count} rows failed")), "{error}");
        assert!(error.contains("out.csv.rejected.csv says why"), "{error}");
        assert!(String::from_utf8(bytes(&out)).unwrap().contains("NaN,NaN,NaN"));
    }
    // A file without rows has nothing that could fail.
    let initial = written(&directory, "in.csv", "mu_1,mu_2,mu_3\n");
    assert_eq!(ensemble(&initial, &out, &[])["trajectories"], 0);
}

/// `ensemble` reads the output of `simulate`: coordinates by their own names, matrices of products by their blocks.
#[test]
fn records_of_runs_are_states() {
    let directory = TempDir::new().unwrap();
    let (records, out) = (at(&directory, "records.csv"), at(&directory, "out.csv"));
    for file in [BODY, "examples/heisenberg_spin_ring.toml"] {
        let (code, _, error) = run(&["simulate", file, "--time", "2", "--out", &records]);
        assert_eq!(code, 0, "{error}");
        let half = ["ensemble", file, "--initial", &records, "--out", &out, "--time", "1"];
        let (code, _, error) = run(&half);
        assert_eq!(code, 0, "{error}");
        let [before, after] = [&records, &out].map(|name| String::from_utf8(bytes(name)).unwrap());
        let rows: Vec<&str> = before.lines().filter(|line| !line.starts_with('#')).collect();
        let ends: Vec<&str> = after.lines().collect();
        assert_eq!(rows[0], ends[0]);
        let numbers = |line: &str| -> Vec<f64> {
            line.split(',').map(|cell| cell.parse().unwrap()).collect()
        };
        let (found, expected) = (numbers(ends[rows.len() / 2]), numbers(rows[rows.len() - 1]));
        // Time, energy and drifts are carried through.
        let states = 1..found.len() - 4;
        for (x, y) in found[states.clone()].iter().zip(&expected[states]) {
            assert!((x - y).abs() < 1e-12, "{x} {y}");
        }
    }
}

#[test]
fn mistakes_are_told_before_anything_runs() {
    let directory = TempDir::new().unwrap();
    let good = written(&directory, "good.csv", &momenta(3));
    let out = at(&directory, "out.csv");
    let missing = written(&directory, "missing.csv", "mu_1,mu_2\n1,2\n");
    let quaternions =
        written(&directory, "q.csv", "mu_1,mu_2,mu_3,mu_4,mu_5,mu_6,q_w\n1,2,3,4,5,6,1\n");
    let npy = at(&directory, "good.npy");
    ensemble(&good, &npy, &["--time", "0.1"]);
    let mut cut = bytes(&npy);
    cut.truncate(cut.len() - 8);
    let short = at(&directory, "short.npy");
    std::fs::write(&short, cut).unwrap();
    let mut claims = b"\x93NUMPY\x02\x00".to_vec();
    claims.extend(u32::MAX.to_le_bytes());
    claims.extend([b' '; 20]);
    let long = at(&directory, "long.npy");
    std::fs::write(&long, claims).unwrap();
    let header = |name: &str, line: &str| written(&directory, name, &format!("{line}\n"));
    let twice = header("twice.csv", "mu_1,mu_2,mu_3,mu_1");
    let both = header("both.csv", "mu_1,mu_2,mu_3,q_w,q_x,q_y,q_z,g_11");
    let part = header("part.csv", "mu_1,mu_2,mu_3,g_12,g_13");
    let fourth = header("fourth.csv", "mu_1,mu_2,mu_3,mu_4");
    let parameter = header("parameter.csv", "mu_1,mu_2,mu_3,I1");
    let top = "examples/heavy_top.toml";
    for (file, initial, out, more, expected) in [
        (
            BODY,
            &twice,
            &out,
            [].as_slice(),
            "column mu_1 is there twice, in row 1 as cells 1 and 4",
        ),
        (BODY, &both, &out, &[], "columns g_11 and q_w both give the attitude"),
        (BODY, &part, &out, &[], "column g_11 is missing"),
        (BODY, &fourth, &out, &[], "column mu_4: the momentum of this system has"),
        (BODY, &parameter, &out, &[], "column I1 is called as a parameter of the system is"),
        (BODY, &long, &out, &[], "its header claims 4294967295 bytes; the file has 20 left"),
        (BODY, &good, &out, &["--threads", "1000000"], "--threads 1000000: at most"),
        (BODY, &missing, &out, &[], "column mu_3 is missing"),
        (top, &quaternions, &out, &[], "no quaternions"),
        (top, &npy, &out, &[], "the array has 3 columns; this system needs 6 or 22"),
        (BODY, &short, &out, &[], "its shape [3, 3] needs more than the 64 bytes"),
        (BODY, &good, &out, &["--shard", "3/2"], "counted from 1"),
        (BODY, &good, &out, &["--shard", "0/2"], "counted from 1"),
        (BODY, &good, &out, &["--shard", "half"], "write i/n"),
        (BODY, &good, &good, &[], "is the same file, which this run uses"),
        (BODY, &good, &at(&directory, "out.txt"), &[], "must end in .csv or .npy"),
        (BODY, &good, &out, &["--step", "0"], "other than zero"),
    ] {
        let mut arguments = vec!["ensemble", file, "--initial", initial, "--out", out];
        arguments.extend(more);
        let (code, _, error) = run(&arguments);
        assert_eq!(code, 2, "{error}");
        assert!(error.contains(expected), "{error}");
    }
    assert_eq!(left_over(&directory), Vec::<PathBuf>::new());
}
