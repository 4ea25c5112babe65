//! The records of `simulate`: written as the run goes, and kept when it fails; cases `records_*` show the rest.

use std::process::Stdio;

use crate::support::{BODY, Folder, run, table};

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

/// Records alone are on the standard output, with short numbers. A device is written as it is.
#[cfg(unix)]
#[test]
fn records_go_to_the_standard_output_and_to_devices() {
    let ran = run(&format!("simulate {BODY} --time 1 --out -")).ok();
    assert!(ran.out.ends_with("# complete: 11 records\n"));
    let longest = table(&ran.out).iter().flatten().map(String::len).max().unwrap();
    assert!(longest <= 24, "{longest}");
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
