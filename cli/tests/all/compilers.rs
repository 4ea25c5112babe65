//! Compilers that hang or fail do not keep a run waiting.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::support::{BODY, Folder, Ran};

/// A compiler that tells its version, and for everything else runs this script.
fn compiler(folder: &Path, script: &str) -> String {
    let path = folder.join("compiler");
    let text = format!("#!/bin/sh\ncase \"$*\" in *version*) echo cc 1; exit 0;; esac\n{script}\n");
    fs::write(&path, text).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    path.to_str().unwrap().to_owned()
}

fn alive(pid: &str) -> bool {
    let pid = pid.trim().parse().ok().and_then(rustix::process::Pid::from_raw).unwrap();
    rustix::process::test_kill_process(pid).is_ok()
}

/// A run of some seconds, worth a compiler, ends while the compiler hangs, and takes it along.
#[test]
fn a_run_never_waits_for_a_compiler() {
    let folder = Folder::new();
    let started = folder.at("started");
    let hangs = format!("sleep 1000 & echo $! > {}; wait", started.display());
    folder.write("states.csv", "mu_1,mu_2,mu_3\n2,0.5,1\n");
    let simulate = format!("simulate {BODY} --time 80000");
    let ensemble = format!("ensemble {BODY} --initial states.csv --time 16000 --out out.csv");
    let fails = "echo 'error: out of paper' >&2; exit 1";
    for (arguments, script) in [(simulate, hangs.as_str()), (ensemble, fails)] {
        let mut command = folder.command(&format!("{arguments} --format json"));
        command.env("CC", compiler(folder.path(), script)).env("XDG_CACHE_HOME", folder.path());
        let ran = Ran::of(&command.output().unwrap()).ok().prints(&["interpreter"]);
        assert!(!ran.out.contains("machine code"), "{ran:?}");
        if script == hangs {
            let pid = fs::read_to_string(&started).unwrap();
            let begun = Instant::now();
            // It is there until whoever inherits it has heard of its end.
            while alive(&pid) && begun.elapsed() < Duration::from_secs(20) {
                std::thread::sleep(Duration::from_millis(20));
            }
            assert!(!alive(&pid), "{pid} goes on");
        } else {
            ran.says(&["out of paper; the run goes on without it"]);
        }
    }
}

/// Two runs compile once, and a store that cannot be used is none.
#[test]
fn compiled_steps_are_kept_for_later_runs() {
    let folder = Folder::new();
    let counts = folder.at("counts");
    let compiler =
        compiler(folder.path(), &format!("echo >> {}; exec cc \"$@\"", counts.display()));
    let mut numbers = Vec::new();
    for (store, compiled) in [("store", 1), ("store", 1), ("off", 2), ("/proc/nowhere", 3)] {
        let store = if store == "store" { folder.at(store) } else { store.into() };
        let mut command = folder.command(&format!("simulate {BODY} --backend c --format json"));
        command.env("CC", &compiler).env("COADJOINT_CACHE", store);
        let ran = Ran::of(&command.output().unwrap()).ok().json();
        numbers.push(ran["momentum"].clone());
        assert_eq!(fs::read_to_string(&counts).unwrap().lines().count(), compiled);
    }
    assert!(numbers.iter().all(|momentum| *momentum == numbers[0] && momentum.is_array()));
}
