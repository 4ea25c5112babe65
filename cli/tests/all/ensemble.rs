//! `ensemble`: the same bytes whatever the threads, shards, formats and accidents; cases `ensemble_*` show the rest.

use std::time::Duration;

use coadjoint_learn::table::array;
use serde_json::Value;

use crate::support::{BODY, Folder, Ran};

const NAMES: &str = "mu_1,mu_2,mu_3\n";

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

/// No file of a folder tells of an unfinished run.
fn nothing_left_over(folder: &Folder) {
    for entry in std::fs::read_dir(folder.path()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.contains(".partial") && !name.contains(".journal"), "{name}");
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
    for threads in ["1", "2"] {
        let options = format!("--time 2 --at 0,0.55,2 --threads {threads}");
        ensemble(&folder, "in.csv", &format!("at{threads}.npy"), &options);
    }
    assert!(folder.bytes("at1.npy") == folder.bytes("at2.npy"));
    assert_eq!(array(&folder.at("at1.npy")).unwrap().0, [2100, 3, 3]);
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

/// In Parquet a trajectory has a line for each of its times, with the numbers of the array; records of `simulate` are those of
/// `.npy`.
#[cfg(feature = "parquet")]
#[test]
fn parquet_has_the_numbers_of_arrays() {
    let rows = |folder: &Folder, name: &str| {
        let mut table = coadjoint_learn::table::Table::open(&folder.at(name)).unwrap();
        let (names, mut row) = (table.names().join(","), coadjoint_learn::table::Cells::default());
        let mut all = Vec::new();
        while table.read(&mut row).unwrap() {
            all.push(row.numbers());
        }
        (names, all)
    };
    let folder = Folder::with(
        "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x^2/I1 + y^2/4 + z^2/5\"\n\
         [parameters]\nI1 = 3\n[integrator]\nstep = 0.1\n[run]\ntime = 10\n",
    );
    folder.write("in.csv", "I1,mu_1,mu_2,mu_3\n4,1,2,3\nnan,1,2,3\n");
    for out in ["out.npy", "out.parquet"] {
        let ran = format!("ensemble system.toml --initial in.csv --out {out} --at 0,3.16,10");
        folder.run(&ran).ok();
    }
    let (_, expected) = array(&folder.at("out.npy")).unwrap();
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
