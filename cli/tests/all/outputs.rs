//! The files that the command writes: never over an input, whole or not there, and known to be what was written.
#![cfg(unix)]

use std::fs;
use std::process::{Command, Stdio};

use crate::support::{BODY, Folder, Ran, run, text_of};

/// A folder with a system, a table of momenta, and pairs to learn from.
fn place() -> Folder {
    let place = Folder::new();
    place.write("body.toml", text_of(BODY));
    let rows: String = (0..40).map(|i| format!("{},0.5,1\n", 1.0 + f64::from(i) / 40.0)).collect();
    place.write("states.csv", format!("mu_1,mu_2,mu_3\n{rows}"));
    let pair = |i: i32| {
        let (sin, cos) = (f64::from(i) / 40.0).sin_cos();
        format!("{cos},{sin},1,{},{},1\n", cos * 0.995 - sin * 0.1, sin * 0.995 + cos * 0.1)
    };
    let names = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3\n";
    let pairs: String = (0..40).map(pair).collect();
    place.write("pairs.csv", format!("{names}{pairs}"));
    place.write("times", "0.5 1");
    place
}

fn names(place: &Folder) -> Vec<String> {
    let entries = fs::read_dir(place.path()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn an_output_is_never_an_input() {
    let place = place();
    for (arguments, input) in [
        ("emit body.toml --out OUT", "body.toml"),
        ("emit body.toml --language c --out OUT", "body.toml"),
        ("simulate body.toml --time 1 --plot OUT", "body.toml"),
        ("simulate body.toml --time 1 --checkpoint OUT", "body.toml"),
        ("simulate body.toml --time 1 --out OUT", "body.toml"),
        ("simulate body.toml --time 1 --out t.csv --at times --checkpoint OUT", "times"),
        ("ensemble body.toml --initial states.csv --time 1 --out OUT", "states.csv"),
        ("ensemble body.toml --initial states.csv --time 1 --restart --out OUT", "body.toml"),
        ("learn pairs.csv --dt 0.1 --out OUT", "pairs.csv"),
        ("learn pairs.csv --dt 0.1 --test states.csv --out OUT", "states.csv"),
    ] {
        let before = place.bytes(input);
        // The name itself where it can be given, links to it, and names that end in `.partial` until all is written.
        let ending = ["--plot", "simulate", "ensemble"].iter().any(|word| arguments.contains(word));
        let link = if arguments.contains("--plot") { "link.svg" } else { "link.csv" };
        let refused = |name: &str| {
            let out = arguments.replace("OUT", name);
            place.refused(&[(&out, "the same file")]);
            assert!(place.bytes(input) == before, "{out}");
        };
        if !ending || arguments.contains("--checkpoint") || input == "states.csv" {
            refused(input);
        }
        std::os::unix::fs::symlink(place.at(input), place.at(link)).unwrap();
        refused(link);
        place.remove(link);
        fs::hard_link(place.at(input), place.at(link)).unwrap();
        refused(link);
        // The name under which the file grows.
        let passing = format!("{link}.partial");
        fs::rename(place.at(link), place.at(&passing)).unwrap();
        refused(link);
        place.remove(&passing);
    }
    assert_eq!(names(&place), ["body.toml", "examples", "pairs.csv", "states.csv", "times"]);
}

/// The command in a shell that limits files to this number of blocks of 512 bytes.
fn limited(place: &Folder, blocks: u32, arguments: &str) -> Ran {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" {arguments}");
    let mut command = Command::new("sh");
    command.current_dir(place.path()).args(["-c", &script]).arg(env!("CARGO_BIN_EXE_coadjoint"));
    Ran::of(&command.output().unwrap())
}

#[test]
fn a_full_disk_leaves_what_was_there_and_whole_records() {
    let place = place();
    place.write("old", "what was there");
    for arguments in ["emit body.toml --out old", "simulate body.toml --plot old.svg --time 1"] {
        limited(&place, 2, arguments).fails(1, &["cannot write old"]);
    }
    assert_eq!(place.text("old"), "what was there");
    assert!(!names(&place).iter().any(|name| name.contains(".partial") || name.contains(".svg")));
    for name in ["t.csv", "t.npy"] {
        let part = format!("{name}.partial");
        limited(&place, 16, &format!("simulate body.toml --time 100 --out {name}"))
            .fails(1, &[&part]);
        let part = place.bytes(&part);
        // A row has 17 numbers.
        assert!(part.len() > 8192 - 17 * 24, "{name}: {} bytes", part.len());
        if name == "t.csv" {
            let last = String::from_utf8(part).unwrap();
            let last = last.strip_suffix('\n').unwrap().lines().last().unwrap().to_owned();
            assert_eq!(last.split(',').count(), 17, "{last}");
        } else {
            let array = npyz::NpyFile::new(&part[..]).unwrap();
            assert_eq!(array.shape()[0], (8192 - 128) / (17 * 8));
        }
    }
}

/// A reader that stops reading (`| head`) is no failure, and nothing to complain about; a full disk is one, and is named.
#[cfg(target_os = "linux")]
#[test]
fn a_closed_pipe_is_no_failure_and_a_full_device_is_one() {
    let place = place();
    let start =
        |arguments: &str, output: Stdio| place.command(arguments).stdout(output).spawn().unwrap();
    let emit = format!("emit {BODY}");
    let records = |time| format!("simulate {BODY} --time {time} --out -");
    for arguments in [&emit, &records("1e7")] {
        let mut child = start(arguments, Stdio::piped());
        drop(child.stdout.take());
        let ran = Ran::of(&child.wait_with_output().unwrap()).ok();
        assert!(ran.error.is_empty(), "{ran:?}");
    }
    std::os::unix::fs::symlink("/dev/full", place.at("full.csv")).unwrap();
    for (arguments, expected) in [
        (&emit, "error: standard output cannot be written"),
        (&records("50"), "cannot write the standard output"),
        (&format!("simulate {BODY} --out /dev/full"), "cannot write /dev/full"),
        (&format!("simulate {BODY} --out full.csv"), "cannot write full.csv"),
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = start(arguments, full.into()).wait_with_output().unwrap();
        Ran::of(&output).fails(1, &[expected]);
    }
}

/// One bit of whatever a run goes on from: an error, or the same result.
#[test]
fn a_changed_bit_never_gives_another_result() {
    let place = place();
    let simulate =
        "simulate body.toml --time 4 --out t.csv --checkpoint state --checkpoint-interval 0";
    // Full after some records: the checkpoint before that stays.
    limited(&place, 12, simulate).fails(1, &[]);
    let kept = ["state", "t.csv.partial"];
    let before = kept.map(|name| place.bytes(name));
    place.run(simulate).ok().says(&["going on from state at step "]);
    let expected = place.bytes("t.csv");
    for (name, old) in kept.iter().zip(&before) {
        for byte in (0..old.len()).step_by(old.len() / 9) {
            kept.iter().zip(&before).for_each(|(name, old)| place.write(name, old));
            let _ = fs::remove_file(place.at("t.csv"));
            let mut changed = old.clone();
            changed[byte] ^= 1;
            place.write(name, changed);
            let ran = place.run(simulate);
            assert!(ran.code == 2 || place.bytes("t.csv") == expected, "{name}, {byte}: {ran:?}");
        }
    }
}

/// Inputs that never end, or that are larger than what is read, are refused before they are read.
#[test]
fn devices_pipes_and_large_files_are_refused() {
    let place = place();
    let status = Command::new("mkfifo").arg(place.at("pipe.csv")).status().unwrap();
    assert!(status.success());
    place.write("large.toml", text_of(BODY));
    let large = fs::File::options().write(true).open(place.at("large.toml")).unwrap();
    large.set_len(65_000_000).unwrap();
    place.refused(&[
        ("derive /dev/zero", "a device or a pipe"),
        ("derive pipe.csv", "a device or a pipe"),
        ("derive large.toml", "more than 64 MB"),
        ("simulate --model large.toml --start 1,1,1 --time 1", "COADJOINT_MAX_MEGABYTES"),
        ("simulate body.toml --out t.csv --at pipe.csv", "a device or a pipe"),
        ("ensemble body.toml --initial pipe.csv --out e.csv", "a device or a pipe"),
        ("learn pipe.csv --dt 0.1", "a device or a pipe"),
        ("verify body.toml pipe.csv", "a device or a pipe"),
    ]);
    let mut raised = place.command("derive large.toml");
    let raised = Ran::of(&raised.env("COADJOINT_MAX_MEGABYTES", "100").output().unwrap());
    assert!(!raised.error.contains("MB"), "{raised:?}");
    let script = "cat body.toml | \"$0\" derive /dev/stdin";
    let mut shell = Command::new("sh");
    shell.current_dir(place.path()).args(["-c", script, env!("CARGO_BIN_EXE_coadjoint")]);
    let piped = Ran::of(&shell.output().unwrap()).ok();
    assert_eq!(run(&format!("derive {BODY}")).out, piped.out);
}
