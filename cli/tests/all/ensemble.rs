//! `ensemble`: the end states of `simulate`, whatever the threads, shards, formats and accidents.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::support::{Folder, json, numbers, root, run};
use serde_json::Value;

const BODY: &str = "examples/rigid_body.toml";
const NAMES: &str = "mu_1,mu_2,mu_3\n";

/// Momenta of one file: no two rows alike.
fn momenta(rows: usize) -> String {
    let row = |row: usize| {
        let x = row as f64 / rows as f64;
        format!("{},{},{}\n", 2.0 - x, 0.5 + 0.3 * x * x, 1.0 + x)
    };
    NAMES.to_owned() + &(0..rows).map(row).collect::<String>()
}

/// Runs an ensemble of the rigid body between files of a folder.
fn ensemble(folder: &Folder, initial: &str, out: &str, more: &[&str]) -> Value {
    let (initial, out) = (folder.name(initial), folder.name(out));
    let arguments = ["ensemble", BODY, "--initial", &initial, "--out", &out, "--format", "json"];
    json(&[&arguments, more].concat())
}

/// The same as it is said: exit code, standard output, standard error.
fn told(
    folder: &Folder,
    file: &str,
    initial: &str,
    out: &str,
    more: &[&str],
) -> (i32, String, String) {
    let (initial, out) = (folder.name(initial), folder.name(out));
    run(&[&["ensemble", file, "--initial", &initial, "--out", &out], more].concat())
}

/// The numbers of a line.
fn cells(line: &str) -> Vec<f64> {
    line.split(',').map(|cell| cell.parse().unwrap()).collect()
}

/// No file of a folder tells of an unfinished run.
fn nothing_left_over(folder: &Folder) {
    for entry in std::fs::read_dir(folder.path()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.contains(".partial") && !name.contains(".journal"), "{name}");
    }
}

/// SE(3) in closed form, SO(4) and a power of SO(3) by tables, the Cayley chart, and an attitude: every engine gives the
/// end of `simulate`, to the rounding in which a group of tables differs from closed forms.
#[test]
fn rows_end_where_simulate_ends() {
    let folder = Folder::new();
    for (file, chart, attitude) in [
        ("examples/heavy_top.toml", "exp", false),
        ("examples/heavy_top.toml", "cayley", false),
        ("examples/manakov_so4.toml", "exp", false),
        ("examples/manakov_so4.toml", "cayley", false),
        (BODY, "cayley", false),
        (BODY, "exp", true),
        ("examples/heisenberg_spin_ring.toml", "exp", false),
        ("examples/so21_by_brackets.toml", "exp", false),
    ] {
        let text = std::fs::read_to_string(root().join(file)).unwrap();
        let line = text.lines().find(|line| line.starts_with("momentum = [")).unwrap();
        let mut row: Vec<String> =
            line.split(['[', ']']).nth(1).unwrap().split(',').map(|x| x.trim().into()).collect();
        let mut names: Vec<String> = (1..=row.len()).map(|i| format!("mu_{i}")).collect();
        if attitude {
            names.extend("g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33".split(',').map(Into::into));
            row.extend("1,0,0,0,1,0,0,0,1".split(',').map(Into::into));
        }
        folder.write("in.csv", format!("{}\n{}\n", names.join(","), row.join(",")));
        let short = ["--truncation", "3", "--time", "0.5", "--step", "0.05"];
        let common = [&["--chart", chart][..], if attitude { &[][..] } else { &short }].concat();
        let json_too = [&common[..], &["--format", "json"]].concat();
        let (code, report, error) = told(&folder, file, "in.csv", "out.csv", &json_too);
        assert_eq!(code, 0, "{file}: {error}");
        let report: Value = serde_json::from_str(&report).unwrap();
        assert_eq!((&report["trajectories"], &report["failed"]), (&1.into(), &0.into()));
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-12, "{report}");
        let end = folder.text("out.csv");
        let (header, end) = end.split_once('\n').unwrap();
        assert_eq!(header, names.join(","));
        let single = json(&[&["simulate", file], &json_too[..]].concat());
        let mut expected = numbers(&single["momentum"]);
        if attitude {
            assert!(report["drift"]["casimirs"].as_f64().unwrap() < 1e-12);
            assert_eq!(report["steps"], 1000);
            expected.extend(single["group_element"].as_array().unwrap().iter().flat_map(numbers));
        }
        let (end, rounding) = (cells(end.trim()), if attitude { 1e-11 } else { 1e-12 });
        assert_eq!(end.len(), expected.len());
        let size = expected.iter().fold(1.0, |a: f64, b| a.max(b.abs()));
        for (a, b) in end.iter().zip(&expected) {
            assert!((a - b).abs() < rounding * size, "{file}, {chart}: {end:?}, {expected:?}");
        }
    }
}

/// Threads, formats, shares of unequal length, and more shares than rows: the same bytes. A file in one format that is read
/// again is the same ensemble.
#[test]
fn threads_formats_and_shards_give_the_same_bytes() {
    let folder = Folder::new();
    folder.write("in.csv", momenta(2100));
    let step = ["--time", "0.3", "--step", "0.3"];
    let more = |words: &[&'static str]| [&step[..], words].concat();
    ensemble(&folder, "in.csv", "middle.csv", &step);
    ensemble(&folder, "middle.csv", "end.csv", &more(&["--threads", "1"]));
    let end = folder.text("end.csv");
    let end: Vec<&str> = end.lines().collect();
    let endings = ["csv", "npy", "parquet"];
    for ending in &endings[..if cfg!(feature = "parquet") { 3 } else { 2 }] {
        let [one, middle] = ["one", "two"].map(|name| format!("{name}.{ending}"));
        ensemble(&folder, "in.csv", &one, &more(&["--threads", "1"]));
        ensemble(&folder, "in.csv", &middle, &more(&["--threads", "2"]));
        assert!(folder.bytes(&one) == folder.bytes(&middle), "{ending}");
        let mut joined = vec![NAMES.trim().to_owned()];
        // A share begins in the middle of the file.
        for shard in ["1/4", "2/4", "3/4", "4/4"] {
            ensemble(&folder, &middle, "share.csv", &[&step[..], &["--shard", shard]].concat());
            joined.extend(folder.text("share.csv").lines().skip(1).map(str::to_owned));
        }
        assert!(joined == end, "{ending}");
    }
    folder.write("in.csv", momenta(2));
    ensemble(&folder, "in.csv", "whole.csv", &step);
    let shares = ["1/3", "2/3", "3/3"].map(|shard| {
        ensemble(&folder, "in.csv", "share.csv", &[&step[..], &["--shard", shard]].concat());
        folder.text("share.csv").strip_prefix(NAMES).unwrap().to_owned()
    });
    assert_eq!(NAMES.to_owned() + &shares.concat(), folder.text("whole.csv"));
    nothing_left_over(&folder);
}

/// Starts a run and kills it as soon as it has noted something.
fn kill_in_the_middle(folder: &Folder, out: &str) {
    let (initial, out) = (folder.name("in.csv"), folder.name(out));
    let arguments = ["ensemble", BODY, "--initial", &initial, "--out", &out];
    let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
    let command = command.current_dir(root()).args(arguments).stdout(Stdio::null());
    let mut child = command.spawn().unwrap();
    let journal = format!("{out}.journal");
    let noted = || {
        let text = std::fs::read_to_string(&journal).ok()?;
        serde_json::from_str::<Value>(&text).ok()?["rows"].as_u64()
    };
    while noted().is_none() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(Path::new(&journal).exists(), "ended before it was killed");
}

/// A run that was killed does not go on with other options or another input. With the same ones its files are those of an
/// undisturbed run, as they are when it is told to begin anew.
#[test]
fn a_killed_run_ends_with_the_same_bytes() {
    let folder = Folder::new();
    // Seconds of work: the journal is written after a fifth of one.
    let states = momenta(30_000) + "bad,1,2\n";
    folder.write("in.csv", &states);
    for out in ["out.csv", "out.npy"] {
        kill_in_the_middle(&folder, out);
        let refused = |more: &[&str], expected: &str| {
            let (code, _, error) = told(&folder, BODY, "in.csv", out, more);
            assert!(code == 2 && error.contains(expected), "{error}");
        };
        refused(&["--step", "0.2"], "number of steps: 1000 then, 500 now");
        folder.write("in.csv", momenta(100));
        refused(&[], "another initial file");
        folder.write("in.csv", &states);
        let resumed = ensemble(&folder, "in.csv", out, &[]);
        assert!(resumed["resumed_at"].as_u64().unwrap() > 0);
        assert_eq!(resumed["failed"], 1);
        let list = folder.bytes(&format!("{out}.rejected.csv"));
        let bytes = folder.bytes(out);
        kill_in_the_middle(&folder, out);
        let undisturbed = ensemble(&folder, "in.csv", out, &["--restart"]);
        assert_eq!(undisturbed["resumed_at"], 0);
        assert_eq!(resumed["drift"], undisturbed["drift"]);
        assert!(folder.bytes(out) == bytes);
        assert!(folder.bytes(&format!("{out}.rejected.csv")) == list);
    }
    nothing_left_over(&folder);
}

/// Jobs of an array that are started again: what is finished stays, what is damaged is made again, and another command
/// is refused.
#[test]
fn a_finished_shard_is_kept() {
    let folder = Folder::new();
    folder.write("in.csv", momenta(60) + "bad,1,2\n");
    let options = ["--shard", "3/3", "--time", "1", "--keep"];
    let again = || ensemble(&folder, "in.csv", "out-3.csv", &options);
    assert_eq!(again()["kept"], false);
    let files = ["out-3.csv", "out-3.csv.rejected.csv", "out-3.csv.done"];
    let before = files.map(|file| folder.bytes(file));
    let note: Value = serde_json::from_slice(&before[2]).unwrap();
    assert_eq!((&note["first_row"], &note["journal"]["rows"]), (&41.into(), &21.into()));
    let kept = again();
    assert_eq!((&kept["kept"], &kept["failed"]), (&true.into(), &1.into()));
    assert_eq!(kept["trajectories"], 21);
    let (code, report, _) = told(&folder, BODY, "in.csv", "out-3.csv", &options);
    assert!(code == 0 && report.contains("finished by an earlier run, and kept"), "{report}");
    let other = [&options[..], &["--step", "0.2"]].concat();
    let (code, _, error) = told(&folder, BODY, "in.csv", "out-3.csv", &other);
    let expected = "out-3.csv.done is of a run with another number of steps";
    assert!(code == 2 && error.contains(expected), "{error}");
    // Damaged or lost, it is made again.
    for file in &files[..2] {
        folder.write(file, "1,2");
        assert_eq!(again()["kept"], false);
    }
    std::fs::remove_file(folder.at(files[0])).unwrap();
    assert_eq!(again()["kept"], false);
    assert!(files.map(|file| folder.bytes(file)) == before);
    // Made by another command without the option, the file has no note.
    ensemble(&folder, "in.csv", "out-3.csv", &["--time", "2"]);
    assert!(!folder.at(files[2]).exists());
    nothing_left_over(&folder);
}

#[test]
fn bad_rows_are_told_and_do_not_stop_the_rest() {
    let folder = Folder::new();
    let rows = [
        "2,0.5,1,1,0,0,0",
        "2,inf,1,1,0,0,0",
        "2,0.5,1,1,1,0,0",
        "2,0.5,1,1,0,0",
        "2,0.5,one,1,0,0,0",
        "200,50,100,1,0,0,0",
        "2,0.5,1,1,0,0,0",
    ];
    folder.write("in.csv", format!("mu_1,mu_2,mu_3,q_w,q_x,q_y,q_z\n{}\n# end", rows.join("\n")));
    let summary = ensemble(&folder, "in.csv", "out.csv", &[]);
    assert_eq!((&summary["trajectories"], &summary["failed"]), (&7.into(), &5.into()));
    let end = folder.text("out.csv");
    let end: Vec<&str> = end.lines().skip(1).collect();
    assert_eq!((end.len(), end[0]), (7, end[6]));
    assert!(!end[0].contains("NaN"));
    end[1..6].iter().for_each(|row| assert_eq!(*row, "NaN,NaN,NaN,NaN,NaN,NaN,NaN"));
    let list = folder.text("out.csv.rejected.csv");
    let list: Vec<&str> = list.lines().collect();
    assert_eq!(list[..2], ["row,step,reason", "2,0,\"mu_2 is inf\""]);
    assert!(list[2].starts_with("3,0,\"the attitude is off the group by 4.1e-1"), "{list:?}");
    assert_eq!(list[3..5], ["4,0,\"6 cells instead of 7\"", "5,0,\"mu_3: 'one' is no number\""]);
    // Far outside the chart; at which step it is noticed depends on rounding.
    assert!(list[5].starts_with("6,") && list[5].contains("leaves the chart"), "{list:?}");
    // Without bad rows the list of an earlier run goes away.
    folder.write("in.csv", momenta(3));
    ensemble(&folder, "in.csv", "out.csv", &[]);
    assert!(!folder.at("out.csv.rejected.csv").exists());
    // Without a single end state the run fails.
    for rows in ["2,inf,1\n2,x,1\n", "2000,500,1000\n"] {
        folder.write("in.csv", NAMES.to_owned() + rows);
        let (code, report, error) = told(&folder, BODY, "in.csv", "out.csv", &[]);
        assert!(code == 1 && report.contains("trajectories of 1000 steps"), "{report}");
        let expected = format!("all {} rows failed", rows.lines().count());
        assert!(error.contains(&expected), "{error}");
        assert!(error.contains("out.csv.rejected.csv says why"), "{error}");
        assert!(folder.text("out.csv").contains("NaN,NaN,NaN"));
    }
    // A file without rows has nothing that could fail.
    folder.write("in.csv", NAMES);
    assert_eq!(ensemble(&folder, "in.csv", "out.csv", &[])["trajectories"], 0);
}

/// Columns that are not ours keep their names, their places and their text, also in rows that fail.
#[test]
fn other_columns_are_carried_through_unchanged() {
    let folder = Folder::new();
    let text = "id,mu_2, name ,mu_1,mu_3,note\n\
                7,0.5,\"a, \"\"b\"\"\",2,1,  two  blanks \n\
                # passed over\n\
                008,0.5,é,nan,1,\n\
                9,1,#hash,2,1e0,0.10\n";
    folder.write("in.csv", text);
    let summary = ensemble(&folder, "in.csv", "out.csv", &["--time", "1"]);
    assert_eq!((&summary["trajectories"], &summary["failed"]), (&3.into(), &1.into()));
    let end = folder.text("out.csv");
    let lines: Vec<&str> = end.lines().collect();
    assert_eq!((lines.len(), lines[0]), (4, "id,mu_2,name,mu_1,mu_3,note"));
    assert!(lines[1].starts_with("7,") && lines[1].ends_with(",  two  blanks "), "{end}");
    assert!(lines[1].contains(",\"a, \"\"b\"\"\","), "{end}");
    assert_eq!(lines[2], "008,NaN,é,NaN,NaN,");
    assert!(lines[3].contains(",\"#hash\",") && lines[3].ends_with(",0.10"), "{end}");
    // The numbers are those of a file without the other columns.
    folder.write("plain.csv", "mu_1,mu_2,mu_3\n2,0.5,1\n2,1,1\n");
    ensemble(&folder, "plain.csv", "plain_out.csv", &["--time", "1"]);
    let plain = folder.text("plain_out.csv");
    for (line, plain) in [lines[1], lines[3]].iter().zip(plain.lines().skip(1)) {
        for number in plain.split(',') {
            assert!(line.split(',').any(|cell| cell == number), "{line}\n{plain}");
        }
    }
    // The output can be read again: the second run carries the same cells.
    ensemble(&folder, "out.csv", "again.csv", &["--time", "1"]);
    let again = folder.text("again.csv");
    assert!(
        again.contains(",\"a, \"\"b\"\"\",") && again.contains("008,NaN,é,NaN,NaN,"),
        "{again}"
    );
    // A matrix has no room for them, and it is said.
    let (code, _, error) = told(&folder, BODY, "in.csv", "out.npy", &["--time", "1"]);
    assert_eq!(code, 0, "{error}");
    assert!(error.contains("not carried through") && error.contains("id, name, note"), "{error}");
}

/// `ensemble` reads the output of `simulate`: coordinates by their own names, matrices of products by their blocks.
#[test]
fn records_of_runs_are_states() {
    let folder = Folder::new();
    for file in [BODY, "examples/heisenberg_spin_ring.toml"] {
        for records in ["records.csv", "records.npy"] {
            let out = folder.name(records);
            let (code, _, error) = run(&["simulate", file, "--time", "2", "--out", &out]);
            assert_eq!(code, 0, "{error}");
            let (code, _, error) = told(&folder, file, records, "out.csv", &["--time", "1"]);
            assert_eq!(code, 0, "{error}");
        }
        // The same states, whether time, energy and drifts are carried through or have no names that would let them be.
        let of_matrix = folder.text("out.csv");
        told(&folder, file, "records.csv", "out.csv", &["--time", "1"]);
        let (before, after) = (folder.text("records.csv"), folder.text("out.csv"));
        let rows: Vec<&str> = before.lines().filter(|line| !line.starts_with('#')).collect();
        let ends: Vec<&str> = after.lines().collect();
        assert_eq!(rows[0], ends[0]);
        let half = rows.len() / 2;
        let (found, expected) = (cells(ends[half]), cells(rows[rows.len() - 1]));
        let states = 1..found.len() - 4;
        for (x, y) in found[states.clone()].iter().zip(&expected[states]) {
            assert!((x - y).abs() < 1e-12, "{x} {y}");
        }
        let own = cells(of_matrix.lines().nth(half).unwrap());
        assert_eq!(own[0], found[1]);
    }
}

#[test]
fn mistakes_are_told_before_anything_runs() {
    let folder = Folder::new();
    folder.write("good.csv", momenta(3));
    folder.write("missing.csv", "mu_1,mu_2\n1,2\n");
    folder.write("q.csv", "mu_1,mu_2,mu_3,mu_4,mu_5,mu_6,q_w\n1,2,3,4,5,6,1\n");
    ensemble(&folder, "good.csv", "good.npy", &["--time", "0.1"]);
    let mut cut = folder.bytes("good.npy");
    cut.truncate(cut.len() - 8);
    folder.write("short.npy", cut);
    let claims = [b"\x93NUMPY\x02\x00", &u32::MAX.to_le_bytes()[..], &[b' '; 20]].concat();
    folder.write("long.npy", claims);
    for (name, line) in [
        ("twice", "mu_1,mu_2,mu_3,mu_1"),
        ("both", "mu_1,mu_2,mu_3,q_w,q_x,q_y,q_z,g_11"),
        ("part", "mu_1,mu_2,mu_3,g_12,g_13"),
        ("fourth", "mu_1,mu_2,mu_3,mu_4"),
        ("parameter", "mu_1,mu_2,mu_3,I1"),
        ("bare", "1,2,3"),
    ] {
        folder.write(&format!("{name}.csv"), format!("{line}\n"));
    }
    let top = "examples/heavy_top.toml";
    let threads = ["--threads", "1000000"];
    for (file, initial, out, more, expected) in [
        (BODY, "twice.csv", "out.csv", &[][..], "mu_1 is there twice, in row 1 as cells 1 and 4"),
        (BODY, "both.csv", "out.csv", &[], "columns g_11 and q_w both give the attitude"),
        (BODY, "part.csv", "out.csv", &[], "column g_11 is missing"),
        (BODY, "fourth.csv", "out.csv", &[], "column mu_4: the momentum of this system has"),
        (
            BODY,
            "parameter.csv",
            "out.csv",
            &[],
            "column I1 is called as a parameter of the system is",
        ),
        (BODY, "bare.csv", "out.csv", &[], "it must name the columns"),
        (
            BODY,
            "long.npy",
            "out.csv",
            &[],
            "its header claims 4294967295 bytes; the file has 20 left",
        ),
        (BODY, "good.csv", "out.csv", &threads, "--threads 1000000: at most"),
        (BODY, "missing.csv", "out.csv", &[], "column mu_3 is missing"),
        (top, "q.csv", "out.csv", &[], "no quaternions"),
        (top, "good.npy", "out.csv", &[], "the array has 3 columns; this system needs 6 or 22"),
        (BODY, "short.npy", "out.csv", &[], "its shape [3, 3] needs more than the 64 bytes"),
        (BODY, "good.csv", "out.csv", &["--shard", "3/2"], "counted from 1"),
        (BODY, "good.csv", "out.csv", &["--shard", "0/2"], "counted from 1"),
        (BODY, "good.csv", "out.csv", &["--shard", "half"], "write i/n"),
        (BODY, "good.csv", "good.csv", &[], "is the same file, which this run uses"),
        (BODY, "good.csv", "out.txt", &[], "must end in .csv or .npy"),
        (BODY, "good.csv", "out.csv", &["--step", "0"], "other than zero"),
    ] {
        let (code, _, error) = told(&folder, file, initial, out, more);
        assert!(code == 2 && error.contains(expected), "{error}");
    }
    nothing_left_over(&folder);
}
