//! Compilers that hang or fail do not keep a run waiting.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::support::{Folder, coadjoint, root};

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
    let states = folder.at("states.csv");
    fs::write(&states, "mu_1,mu_2,mu_3\n2,0.5,1\n").unwrap();
    let (states, out) = (states.to_str().unwrap(), folder.at("out.csv"));
    let simulate = ["simulate", "examples/rigid_body.toml", "--time", "80000"];
    let ensemble =
        ["ensemble", "examples/rigid_body.toml", "--initial", states, "--time", "16000", "--out"];
    let ensemble = ensemble.into_iter().chain(out.to_str()).collect();
    let fails = "echo 'error: out of paper' >&2; exit 1";
    for (arguments, script) in [(Vec::from(simulate), hangs.as_str()), (ensemble, fails)] {
        let run = || {
            let mut command = coadjoint();
            command.current_dir(root()).env("CC", compiler(folder.path(), script));
            command.env("XDG_CACHE_HOME", folder.path());
            let output = command.args(&arguments).args(["--format", "json"]).output().unwrap();
            let error = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success(), "{error}");
            (String::from_utf8(output.stdout).unwrap(), error)
        };
        let (report, error) = run();
        assert!(report.contains("interpreter") && !report.contains("machine code"), "{report}");
        if script == hangs {
            let pid = fs::read_to_string(&started).unwrap();
            let begun = Instant::now();
            // It is there until whoever inherits it has heard of its end.
            while alive(&pid) && begun.elapsed() < Duration::from_secs(20) {
                std::thread::sleep(Duration::from_millis(20));
            }
            assert!(!alive(&pid), "{pid} goes on");
        } else {
            assert!(error.contains("out of paper; the run goes on without it"), "{error}");
        }
    }
}
