//! `ensemble`: the end states of `simulate`, whatever the threads, shards, formats and accidents.

use std::time::Duration;

use crate::support::{BODY, Folder, Ran, distance, json, numbers, text_of};
use serde_json::Value;

const NAMES: &str = "mu_1,mu_2,mu_3\n";
const TOP: &str = "examples/heavy_top.toml";

/// Momenta of one file: no two rows alike.
fn momenta(rows: usize) -> String {
    let row = |row: usize| {
        let x = row as f64 / rows as f64;
        format!("{},{},{}\n", 2.0 - x, 0.5 + 0.3 * x * x, 1.0 + x)
    };
    NAMES.to_owned() + &(0..rows).map(row).collect::<String>()
}

/// A folder with these states in `in.csv`.
fn place(states: impl AsRef<[u8]>) -> Folder {
    let folder = Folder::new();
    folder.write("in.csv", states);
    folder
}

/// Runs an ensemble of the rigid body from one file to another.
fn run(folder: &Folder, initial: &str, out: &str, more: &str) -> Ran {
    folder.run(&format!("ensemble {BODY} --initial {initial} --out {out} {more}"))
}

/// The report of one that ended well.
fn ensemble(folder: &Folder, initial: &str, out: &str, more: &str) -> Value {
    run(folder, initial, out, &format!("{more} --format json")).json()
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
        (TOP, "exp", false),
        (TOP, "cayley", false),
        ("examples/manakov_so4.toml", "exp", false),
        ("examples/manakov_so4.toml", "cayley", false),
        (BODY, "cayley", false),
        (BODY, "exp", true),
        ("examples/heisenberg_spin_ring.toml", "exp", false),
        ("examples/so21_by_brackets.toml", "exp", false),
    ] {
        let text = text_of(file);
        let line = text.lines().find(|line| line.starts_with("momentum = [")).unwrap();
        let row = line.split(['[', ']']).nth(1).unwrap().replace(' ', "");
        let names: Vec<String> = (1..=row.split(',').count()).map(|i| format!("mu_{i}")).collect();
        let (mut names, mut row) = (names.join(","), row);
        if attitude {
            names += ",g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33";
            row += ",1,0,0,0,1,0,0,0,1";
        }
        folder.write("in.csv", format!("{names}\n{row}\n"));
        let short = if attitude { "" } else { "--truncation 3 --time 0.5 --step 0.05" };
        let options = format!("--chart {chart} {short}");
        let report =
            folder.json(&format!("ensemble {file} --initial in.csv --out out.csv {options}"));
        assert_eq!((&report["trajectories"], &report["failed"]), (&1.into(), &0.into()));
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-12, "{report}");
        let end = folder.text("out.csv");
        let (header, end) = end.split_once('\n').unwrap();
        assert_eq!(header, names);
        let single = json(&format!("simulate {file} {options}"));
        let mut expected = numbers(&single["momentum"]);
        if attitude {
            assert!(report["drift"]["casimirs"].as_f64().unwrap() < 1e-12);
            assert_eq!(report["steps"], 1000);
            expected.extend(single["group_element"].as_array().unwrap().iter().flat_map(numbers));
        }
        let rounding = if attitude { 1e-11 } else { 1e-12 };
        let size = expected.iter().fold(1.0, |a: f64, b| a.max(b.abs()));
        let off = distance(&cells(end.trim()), &expected);
        assert!(off < rounding * size, "{file}, {chart}: {end:?}, {expected:?}");
    }
}

/// Threads, formats, shares of unequal length, and more shares than rows: the same bytes. A file in one format that is read
/// again is the same ensemble.
#[test]
fn threads_formats_and_shards_give_the_same_bytes() {
    let folder = place(momenta(2100));
    let step = "--time 0.3 --step 0.3";
    let threads = |count: u8| format!("{step} --threads {count}");
    ensemble(&folder, "in.csv", "middle.csv", step);
    ensemble(&folder, "middle.csv", "end.csv", &threads(1));
    let share = |initial: &str, shard: &str| {
        ensemble(&folder, initial, "share.csv", &format!("{step} --shard {shard}"));
        folder.text("share.csv").strip_prefix(NAMES).unwrap().to_owned()
    };
    let endings = ["csv", "npy", "parquet"];
    for ending in &endings[..if cfg!(feature = "parquet") { 3 } else { 2 }] {
        let [one, middle] = ["one", "two"].map(|name| format!("{name}.{ending}"));
        ensemble(&folder, "in.csv", &one, &threads(1));
        ensemble(&folder, "in.csv", &middle, &threads(2));
        assert!(folder.bytes(&one) == folder.bytes(&middle), "{ending}");
        // A share begins in the middle of the file.
        let shares = ["1/4", "2/4", "3/4", "4/4"].map(|shard| share(&middle, shard));
        assert!(NAMES.to_owned() + &shares.concat() == folder.text("end.csv"), "{ending}");
    }
    folder.write("in.csv", momenta(2));
    ensemble(&folder, "in.csv", "whole.csv", step);
    let shares = ["1/3", "2/3", "3/3"].map(|shard| share("in.csv", shard));
    assert_eq!(NAMES.to_owned() + &shares.concat(), folder.text("whole.csv"));
    nothing_left_over(&folder);
}

/// Starts a run and kills it as soon as it has noted something.
fn kill_in_the_middle(folder: &Folder, out: &str) {
    let mut command = folder.command(&format!("ensemble {BODY} --initial in.csv --out {out}"));
    let mut child = command.spawn().unwrap();
    let journal = folder.at(&format!("{out}.journal"));
    let noted = || {
        let text = std::fs::read_to_string(&journal).ok()?;
        serde_json::from_str::<Value>(&text).ok()?["rows"].as_u64()
    };
    while noted().is_none() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(journal.exists(), "ended before it was killed");
}

/// A run that was killed does not go on with other options or another input. With the same ones its files are those of an
/// undisturbed run, as they are when it is told to begin anew.
#[test]
fn a_killed_run_ends_with_the_same_bytes() {
    // Seconds of work: the journal is written after a fifth of one.
    let states = momenta(30_000) + "bad,1,2\n";
    let folder = place(&states);
    for out in ["out.csv", "out.npy"] {
        kill_in_the_middle(&folder, out);
        let refused = |more: &str, expected: &str| {
            run(&folder, "in.csv", out, more).fails(2, &[expected]);
        };
        refused("--step 0.2", "number of steps: 1000 then, 500 now");
        folder.write("in.csv", momenta(100));
        refused("", "another initial file");
        folder.write("in.csv", &states);
        let resumed = ensemble(&folder, "in.csv", out, "");
        assert!(resumed["resumed_at"].as_u64().unwrap() > 0);
        assert_eq!(resumed["failed"], 1);
        let files = || [out.to_owned(), format!("{out}.rejected.csv")].map(|f| folder.bytes(&f));
        let before = files();
        kill_in_the_middle(&folder, out);
        let undisturbed = ensemble(&folder, "in.csv", out, "--restart");
        assert_eq!(undisturbed["resumed_at"], 0);
        assert_eq!(resumed["drift"], undisturbed["drift"]);
        assert!(files() == before);
    }
    nothing_left_over(&folder);
}

#[test]
fn bad_rows_are_told_and_do_not_stop_the_rest() {
    let rows = "mu_1,mu_2,mu_3,q_w,q_x,q_y,q_z\n2,0.5,1,1,0,0,0\n2,inf,1,1,0,0,0\n2,0.5,1,1,1,0,0\n2,0.5,1,1,0,0\n\
                2,0.5,one,1,0,0,0\n200,50,100,1,0,0,0\n2,0.5,1,1,0,0,0\n# end";
    let folder = place(rows);
    let summary = ensemble(&folder, "in.csv", "out.csv", "");
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
    ensemble(&folder, "in.csv", "out.csv", "");
    assert!(!folder.has("out.csv.rejected.csv"));
    // Without a single end state the run fails.
    for (count, rows) in [(2, "2,inf,1\n2,x,1\n"), (1, "2000,500,1000\n")] {
        folder.write("in.csv", NAMES.to_owned() + rows);
        run(&folder, "in.csv", "out.csv", "")
            .fails(1, &[&format!("all {count} rows failed"), "out.csv.rejected.csv says why"])
            .prints(&["trajectories of 1000 steps"]);
        assert!(folder.text("out.csv").contains("NaN,NaN,NaN"));
    }
    // A file without rows has nothing that could fail.
    folder.write("in.csv", NAMES);
    assert_eq!(ensemble(&folder, "in.csv", "out.csv", "")["trajectories"], 0);
}

/// Columns that are not ours keep their names, their places and their text, also in rows that fail.
#[test]
fn other_columns_are_carried_through_unchanged() {
    let folder = place(
        "id,mu_2, name ,mu_1,mu_3,note\n7,0.5,\"a, \"\"b\"\"\",2,1,  two  blanks \n# passed over\n\
         008,0.5,é,nan,1,\n9,1,#hash,2,1e0,0.10\n",
    );
    let summary = ensemble(&folder, "in.csv", "out.csv", "--time 1");
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
    ensemble(&folder, "plain.csv", "plain_out.csv", "--time 1");
    let plain = folder.text("plain_out.csv");
    for (line, plain) in [lines[1], lines[3]].iter().zip(plain.lines().skip(1)) {
        for number in plain.split(',') {
            assert!(line.split(',').any(|cell| cell == number), "{line}\n{plain}");
        }
    }
    // The output can be read again: the second run carries the same cells.
    ensemble(&folder, "out.csv", "again.csv", "--time 1");
    let again = folder.text("again.csv");
    assert!(again.contains(",\"a, \"\"b\"\"\",") && again.contains("008,NaN,é,NaN,NaN,"));
    // A matrix has no room for them, and it is said.
    let told = run(&folder, "in.csv", "out.npy", "--time 1").ok();
    told.says(&["not carried through", "id, name, note"]);
}

/// `ensemble` reads the output of `simulate`: coordinates by their own names, matrices of products by their blocks.
#[test]
fn records_of_runs_are_states() {
    let folder = Folder::new();
    for file in [BODY, "examples/heisenberg_spin_ring.toml"] {
        let advance = |records: &str| {
            let ran = format!("ensemble {file} --initial {records} --out out.csv --time 1");
            folder.run(&ran).ok();
            folder.text("out.csv")
        };
        for records in ["records.csv", "records.npy"] {
            folder.run(&format!("simulate {file} --time 2 --out {records}")).ok();
        }
        // States are equal: time, energy and drifts of the table are carried through; the array has no names for them.
        let (of_matrix, after) = (advance("records.npy"), advance("records.csv"));
        let before = folder.text("records.csv");
        let rows: Vec<&str> = before.lines().filter(|line| !line.starts_with('#')).collect();
        let ends: Vec<&str> = after.lines().collect();
        assert_eq!(rows[0], ends[0]);
        let half = rows.len() / 2;
        let (found, expected) = (cells(ends[half]), cells(rows[rows.len() - 1]));
        let states = 1..found.len() - 4;
        assert!(distance(&found[states.clone()], &expected[states]) < 1e-12);
        let own = cells(of_matrix.lines().nth(half).unwrap());
        assert_eq!(own[0], found[1]);
    }
}

/// A body whose first moment of inertia is a parameter.
fn body(inertia: &str) -> String {
    format!(
        "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x^2/I1 + y^2/4 + z^2/5\"\n\
         [parameters]\nI1 = {inertia}\n[integrator]\nstep = 0.1\n[run]\ntime = 10\n"
    )
}

/// The shape and the numbers of an array in `.npy`.
fn array(bytes: &[u8]) -> (String, Vec<f64>) {
    let start = 10 + usize::from(bytes[8]) + 256 * usize::from(bytes[9]);
    let head = String::from_utf8(bytes[10..start].to_vec()).unwrap();
    let shape = head.split(['(', ')']).nth(1).unwrap().to_owned();
    let numbers = bytes[start..].as_chunks::<8>().0;
    (shape, numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
}

/// Trajectories have the states of `simulate` at times on the grid and beside it, and the same bytes whatever the threads; a
/// row that fails on its way is NaN from there on.
#[test]
fn trajectories_are_those_of_simulate() {
    let folder = place("mu_1,mu_2,mu_3\n2,0.5,1\n1,2,3\n");
    let times = "--time 20 --at 0,0.55,7,19.98,20";
    let report = ensemble(&folder, "in.csv", "out.npy", times);
    assert_eq!(report["failed"], 0);
    folder.run(&format!("simulate {BODY} --out run.csv {times}")).ok();
    let (shape, found) = array(&folder.bytes("out.npy"));
    assert_eq!(shape, "2, 5, 3");
    let records = folder.table("run.csv");
    for (state, record) in found.chunks(3).zip(&records[1..]) {
        assert!(distance(state, &cells(&record[1..4].join(","))) < 1e-12, "{state:?} {record:?}");
    }
    run(&folder, "in.csv", "end.npy", "--time 20").ok();
    let (_, ends) = array(&folder.bytes("end.npy"));
    assert_eq!(found[12..15], ends[..3]);
    assert_eq!(found[27..30], ends[3..]);

    folder.write("in.csv", momenta(700));
    for threads in [1, 2] {
        let out = format!("out{threads}.npy");
        run(&folder, "in.csv", &out, &format!("{times} --threads {threads}")).ok();
    }
    assert!(folder.bytes("out1.npy") == folder.bytes("out2.npy"));

    let folder = Folder::with(&body("3"));
    folder.write("in.csv", "I1,mu_1,mu_2,mu_3\n4,1,2,3\nnan,1,2,3\n");
    for (out, more) in [("out.npy", "--at 0,3.14,10"), ("end.npy", "")] {
        folder.run(&format!("ensemble system.toml --initial in.csv --out {out} {more}")).ok();
    }
    let (shape, found) = array(&folder.bytes("out.npy"));
    assert_eq!((shape.as_str(), &found[..4]), ("2, 3, 4", &[1.0, 2.0, 3.0, 4.0][..]));
    assert_eq!(found[8..12], array(&folder.bytes("end.npy")).1[..4]);
    assert!(found[12..15].iter().all(|x| x.is_nan()));
    let ran = "ensemble system.toml --initial in.csv --out out";
    folder.refused(&[
        (&format!("{ran}.csv --at 1"), "--out takes as .npy or .parquet"),
        (&format!("{ran}.npy --at 11"), "11 is not between 0 and the end, 10"),
        (&format!("{ran}.npy --at 1 --device opencl"), "cannot be used with"),
    ]);
}

/// In Parquet a trajectory has a line for each of its times, with the numbers of the array; records of `simulate` are those of
/// `.npy`.
#[cfg(feature = "parquet")]
#[test]
fn parquet_has_the_numbers_of_arrays() {
    let rows = |folder: &Folder, name: &str| {
        let mut table = coadjoint_learn::table::Table::open(&folder.at(name)).unwrap();
        let (names, mut row) = (table.names().join(","), coadjoint_learn::table::Row::default());
        let mut all = Vec::new();
        while table.read(&mut row).unwrap() {
            all.push(row.numbers());
        }
        (names, all)
    };
    let folder = Folder::with(&body("3"));
    folder.write("in.csv", "I1,mu_1,mu_2,mu_3\n4,1,2,3\nnan,1,2,3\n");
    for out in ["out.npy", "out.parquet"] {
        let ran = format!("ensemble system.toml --initial in.csv --out {out} --at 0,3.16,10");
        folder.run(&ran).ok();
    }
    let (_, expected) = array(&folder.bytes("out.npy"));
    let (names, found) = rows(&folder, "out.parquet");
    assert_eq!(names, "row,time,mu_1,mu_2,mu_3,I1");
    let places: Vec<&[f64]> = found.iter().map(|line| &line[..2]).collect();
    let times = [0.0, 3.16, 10.0];
    let all = [1.0, 2.0].into_iter().flat_map(|row| times.map(|time| [row, time]));
    assert!(places.into_iter().eq(all.collect::<Vec<_>>().iter().map(|place| &place[..])));
    let states = found.iter().flat_map(|line| &line[2..]);
    assert!(states.map(|x| x.to_bits()).eq(expected.iter().map(|x| x.to_bits())));

    for out in ["run.npy", "run.parquet"] {
        folder.run(&format!("simulate {BODY} --time 2 --out {out}")).ok();
    }
    assert_eq!(rows(&folder, "run.npy").1, rows(&folder, "run.parquet").1);
    assert_eq!(rows(&folder, "run.parquet").0.split(',').next(), Some("time"));
    nothing_left_over(&folder);
}

/// Of some rows the error at the end is estimated, near the truth.
#[test]
fn errors_of_a_sample_are_estimated() {
    let folder = place(momenta(40));
    let rough = "--truncation 3 --time 50 --estimate 10";
    let report = ensemble(&folder, "in.csv", "out.csv", &format!("{rough} --step 0.1"));
    run(&folder, "in.csv", "fine.csv", "--truncation 7 --time 50 --step 0.05").ok();
    let numbers = |name: &str| -> Vec<Vec<f64>> {
        folder.table(name)[1..].iter().map(|row| cells(&row.join(","))).collect()
    };
    let off = numbers("out.csv")
        .iter()
        .zip(numbers("fine.csv"))
        .map(|(a, b)| distance(a, &b))
        .fold(0.0, f64::max);
    let found = &report["estimated_error"];
    assert_eq!(found["rows"], 10);
    let largest = found["largest"].as_f64().unwrap();
    assert!((0.1..10.0).contains(&(largest / off)), "{found} {off}");
    assert!(found["median"].as_f64().unwrap() <= largest);
    // Far off, and so far that nothing is known.
    let rough = |time: u32| {
        let options =
            format!("--truncation 1 --time {time} --step 0.25 --estimate 2 --format json");
        run(&folder, "in.csv", "out.csv", &options).ok()
    };
    rough(40).says(&["the error at the end of a row is about"]).prints(&["\"median\""]);
    let ran = rough(1600).says(&["the error at the end of 2 rows estimated is not known: "]);
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert!(report["estimated_error"].is_null(), "{report}");
    assert_eq!(report["estimated_error_unknown"]["rows"], 2);
}

/// The end of a row is that of a system file with the row's value, in every format; a bad value is told by its row.
#[test]
fn a_column_named_after_a_parameter_varies_it() {
    let folder = Folder::with(&body("3"));
    folder
        .write("in.csv", "I1,mu_1,mu_2,mu_3,name\n4,1,2,3,a\n3,1,2,3,b\nnan,1,2,3,c\n0,1,2,3,d\n");
    let advance = |initial: &str, out: &str| {
        folder.run(&format!("ensemble system.toml --initial {initial} --out {out}")).ok()
    };
    advance("in.csv", "out.csv")
        .prints(&["each row with its own I1", "failed                    2"]);
    let table = folder.table("out.csv");
    let state = |row: &[String]| cells(&row.join(","));
    for (row, inertia) in [(&table[1], "4"), (&table[2], "3")] {
        folder.write("own.toml", body(inertia));
        folder.write("one.csv", "mu_1,mu_2,mu_3\n1,2,3\n");
        folder.run("ensemble own.toml --initial one.csv --out one.out.csv").ok();
        let expected = state(&folder.table("one.out.csv")[1]);
        assert!(distance(&state(&row[1..4]), &expected) < 1e-12, "{row:?} {expected:?}");
        assert_eq!(row[0], inertia);
    }
    assert_ne!(table[1][1..4], table[2][1..4]);
    assert_eq!(table[4].join(","), "0,NaN,NaN,NaN,d");
    let list = folder.text("out.csv.rejected.csv");
    assert!(list.contains("\n3,0,\"I1 is NaN\"\n4,0,\"with I1 = 0: coefficient "), "{list}");
    // Matrices have names in the file beside them; the row's value stays in its column.
    folder.write("in.csv", "mu_1,mu_2,mu_3,I1\n1,2,3,4\n1,2,3,3\n");
    for out in ["one.csv", "one.npy"] {
        advance("in.csv", out);
    }
    folder.write("one.npy.json", "{\"columns\": [\"mu_1\", \"mu_2\", \"mu_3\", \"I1\"]}");
    for initial in ["one.csv", "one.npy"] {
        advance(initial, &format!("{initial}.out.csv"));
    }
    assert_eq!(folder.text("one.csv.out.csv"), folder.text("one.npy.out.csv"));
    let report = folder.json("ensemble system.toml --initial in.csv --out out.csv");
    assert_eq!(report["parameters"], serde_json::json!(["I1"]));
}

/// Each column varies its own parameter, at the end and at times between: H = ω z turns μ about the third axis by −ω t.
#[test]
fn columns_vary_each_its_own_parameter() {
    for method in ["", "method = \"collocation\"\n"] {
        let folder = Folder::with(&format!(
            "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"(a + 2*b[1] + b[0])*z\"\n\
             [parameters]\na = 0.7\nb = [0.05, 0.2]\n[integrator]\nstep = 0.1\n{method}[run]\ntime = 2\n"
        ));
        folder.write("in.csv", "b[1],mu_1,mu_2,mu_3,a\n0.1,1,0,0.5,0.3\n0.4,1,0,0.5,0.1\n");
        let turned = |omega: f64, time: f64| {
            let (sin, cos) = (omega * time).sin_cos();
            [cos, -sin, 0.5]
        };
        let omegas = [0.3 + 0.2 + 0.05, 0.1 + 0.8 + 0.05];
        folder.run("ensemble system.toml --initial in.csv --out out.csv").ok();
        for (row, omega) in folder.table("out.csv")[1..].iter().zip(omegas) {
            let found = cells(&row[1..4].join(","));
            assert!(distance(&found, &turned(omega, 2.0)) < 1e-9, "{method}{row:?}");
        }
        folder.run("ensemble system.toml --initial in.csv --out out.npy --at 0,0.37,2").ok();
        let (shape, found) = array(&folder.bytes("out.npy"));
        assert_eq!(shape, "2, 3, 5");
        let states = omegas.iter().zip([[0.1, 0.3], [0.4, 0.1]]).flat_map(|(&omega, own)| {
            [0.0, 0.37, 2.0].map(|time| [&turned(omega, time)[..], &own].concat())
        });
        for (state, expected) in found.chunks(5).zip(states) {
            assert!(distance(state, &expected) < 1e-9, "{method}{state:?} {expected:?}");
        }
    }
}

/// A body that is symmetric by its file has a comoving frame for a tolerance, which its rows do not: they meet the tolerance in
/// a frame that all of them have.
#[test]
fn a_tolerance_is_met_in_a_frame_that_all_rows_have() {
    let text = body("4").replace("step = 0.1", "tolerance = 1e-8").replace("x^2/I1", "x^2/I1 + z");
    let folder = Folder::with(&(text + "[initial]\nmomentum = [1, 2, 3]\n"));
    folder.write("in.csv", "mu_1,mu_2,mu_3\n1,2,3\n");
    let run = "ensemble system.toml --initial in.csv --out";
    folder.run(&format!("{run} one.csv")).ok().prints(&["comoving: 1"]);
    folder.write("in.csv", "mu_1,mu_2,mu_3,I1\n1,2,3,4\n");
    folder.run(&format!("{run} own.csv")).ok();
    let [one, own] = ["one.csv", "own.csv"].map(|name| cells(&folder.table(name)[1].join(",")));
    assert!(distance(&one, &own[..3]) < 1e-7, "{one:?} {own:?}");
    folder.run("emit system.toml --language c --keep-parameters").ok();
}

/// A field that varies from row to row: each row ends where a file with its field ends, in the comoving frame.
#[test]
fn a_field_varies_from_row_to_row() {
    let text = text_of("tests/systems/two_spins_in_a_field.toml");
    let folder = Folder::with(&text);
    let names: String = (1..=6).map(|i| format!("mu_{i},")).collect();
    let start = "1,0,0,0,0.6,0.8,";
    folder.write("in.csv", format!("{names}B\n{start}60\n{start}-45\n"));
    folder
        .run("ensemble system.toml --initial in.csv --out out.csv")
        .ok()
        .prints(&["K = 3, exp, comoving: 2 trajectories"]);
    for (row, field) in folder.table("out.csv")[1..].iter().zip(["60", "-45"]) {
        folder.write("own.toml", text.replace("B = 100", &format!("B = {field}")));
        let expected = numbers(&folder.json("simulate own.toml")["momentum"]);
        let found = cells(&row[..6].join(","));
        assert!(distance(&found, &expected) < 1e-10, "{found:?} {expected:?}");
    }
}

/// A parameter that cannot vary is refused by its name, at its place.
#[test]
fn parameters_that_cannot_vary_are_refused() {
    let folder = Folder::with(&body("3"));
    let run = "ensemble system.toml --out out.csv --initial";
    folder.write("in.csv", "mu_1,mu_2,mu_3,I1\n1,2,3,4\n");
    folder.refused(&[
        (&format!("{run} in.csv --device opencl"), "are not made on devices"),
        ("verify system.toml in.csv --input in.csv --steps 1 --step 0.1", "column I1: rows with"),
    ]);
    folder.write("system.toml", body("3").replace("I1 = 3", "I1 = 3\nI2 = \"2*I1\""));
    folder.refused(&[(
        &format!("{run} in.csv"),
        "system.toml:5:1: error: the parameter `I1` can neither vary from row to row nor have derivatives: `I2` is computed",
    )]);
    folder.write(
        "system.toml",
        body("3").replace("x^2/I1", "sum(i, 0..3, x^2/J[i])").replace("I1 = 3", "J = [1, 2, 3]"),
    );
    for column in ["J", "J[3]"] {
        folder.write("in.csv", format!("mu_1,mu_2,mu_3,{column}\n1,2,3,4\n"));
        let word = format!("column {column}: the parameter J has the numbers J[0] … J[2]");
        folder.refused(&[(&format!("{run} in.csv"), &word)]);
    }
    folder.write("in.csv", "mu_1,mu_2,mu_3,J[1]\n1,2,3,4\n");
    folder.run(&format!("{run} in.csv")).ok().prints(&["each row with its own J[1]"]);
}

#[test]
fn mistakes_are_told_before_anything_runs() {
    let folder = Folder::new();
    folder.write("good.csv", momenta(3));
    folder.write("missing.csv", "mu_1,mu_2\n1,2\n");
    folder.write("q.csv", "mu_1,mu_2,mu_3,mu_4,mu_5,mu_6,q_w\n1,2,3,4,5,6,1\n");
    ensemble(&folder, "good.csv", "good.npy", "--time 0.1");
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
        ("near", "mu_1,mu_2,mu_3,I_1"),
        ("bare", "1,2,3"),
    ] {
        folder.write(&format!("{name}.csv"), format!("{line}\n"));
    }
    for (file, initial, out, more, expected) in [
        (BODY, "twice.csv", "out.csv", "", "mu_1 is there twice, in row 1 as cells 1 and 4"),
        (BODY, "both.csv", "out.csv", "", "columns g_11 and q_w both give the attitude"),
        (BODY, "part.csv", "out.csv", "", "column g_11 is missing"),
        (BODY, "fourth.csv", "out.csv", "", "column mu_4: the momentum of this system has"),
        (
            BODY,
            "near.csv",
            "out.csv",
            "",
            "column I_1 is no parameter of the system: did you mean I1",
        ),
        (BODY, "bare.csv", "out.csv", "", "it must name the columns"),
        (BODY, "long.npy", "out.csv", "", "header claims 4294967295 bytes; the file has 20 left"),
        (BODY, "good.csv", "out.csv", "--threads 1000000", "--threads 1000000: at most"),
        (BODY, "missing.csv", "out.csv", "", "column mu_3 is missing"),
        (TOP, "q.csv", "out.csv", "", "no quaternions"),
        (TOP, "good.npy", "out.csv", "", "the array has 3 columns; this system needs 6 or 22"),
        (BODY, "short.npy", "out.csv", "", "its shape [3, 3] needs more than the 64 bytes"),
        (BODY, "good.csv", "out.csv", "--shard 3/2", "counted from 1"),
        (BODY, "good.csv", "out.csv", "--shard 0/2", "counted from 1"),
        (BODY, "good.csv", "out.csv", "--shard half", "write i/n"),
        (BODY, "good.csv", "good.csv", "", "is the same file, which this run uses"),
        (BODY, "good.csv", "out.txt", "", "must end in .csv or .npy"),
        (BODY, "good.csv", "out.csv", "--step 0", "other than zero"),
    ] {
        let ran = format!("ensemble {file} --initial {initial} --out {out} {more}");
        folder.refused(&[(&ran, expected)]);
    }
    nothing_left_over(&folder);
}
