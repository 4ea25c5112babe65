//! Compilers that are broken: a clear error.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::samples::Sample;
use coadjoint_native::{COptions, Native, NativeError};
use tempfile::TempDir;

fn by_c(seed: u64, options: &COptions) -> Result<Native, NativeError> {
    Native::by_c(&Sample::small(seed).kernel, options)
}

/// A compiler that is this shell script; it gives its version unless the script does first.
fn script(folder: &TempDir, version: &str, body: &str) -> COptions {
    let path = folder.path().join("compiler");
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = --version ]; then {version}; echo script 1; exit 0; fi\n{body}\n"
    );
    fs::write(&path, text).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    COptions { compiler: Some(path.into()), ..COptions::default() }
}

/// The name of an error's variant, and its message, which is one line.
fn told(error: NativeError) -> (String, String) {
    let text = error.to_string();
    assert!(!text.contains('\n') && text.len() < 600, "{text}");
    let debug = format!("{error:?}");
    (debug.split(' ').next().unwrap().to_owned(), text)
}

#[test]
fn compilers_that_are_broken_are_named_with_what_they_say() {
    let folder = tempfile::tempdir().unwrap();
    let compiler = Some("/nowhere/no-such-compiler".into());
    let error = by_c(1, &COptions { compiler, ..COptions::default() }).unwrap_err();
    let (kind, text) = told(error);
    assert!(kind == "Start" && text.contains("/nowhere/no-such-compiler"), "{text}");

    let says = "echo; echo 'In file x:' >&2; echo 'step.c:1: error: no such thing' >&2; exit 3";
    let writes = "while [ \"$1\" != -o ]; do shift; done; echo rubbish > \"$2\"";
    let other =
        "while [ \"$1\" != -o ]; do shift; done; echo 'int x;' | cc -shared -xc - -o \"$2\"";
    for (version, body, expected, parts) in [
        (":", says, "Failed", ["error: no such thing", "exit status: 3"]),
        (":", "exit 1", "Failed", ["it said nothing", ""]),
        (":", "kill -9 $$", "Failed", ["signal: 9", ""]),
        (":", "exit 0", "NoLibrary", ["", ""]),
        ("exit 7", "", "Failed", ["", ""]),
        (":", writes, "Load", ["", ""]),
        (":", other, "Load", ["coadjoint_sizes", ""]),
    ] {
        let (kind, text) = told(by_c(1, &script(&folder, version, body)).unwrap_err());
        assert_eq!(kind, expected, "{text}");
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
}

/// A file to which a script writes the process that it has started, and that script, which hangs.
fn hanging(folder: &TempDir) -> (PathBuf, String) {
    let started = folder.path().join("started");
    let script = format!("sleep 1000 & echo $! > {}; wait", started.display());
    (started, script)
}

/// The number of the process once it is there.
fn wait_for(started: &Path) -> String {
    loop {
        let text = fs::read_to_string(started).unwrap_or_default();
        if text.ends_with('\n') {
            return text.trim().to_owned();
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn alive(pid: &str) -> bool {
    let status = Command::new("kill").args(["-0", pid]).stderr(Stdio::null()).status();
    status.unwrap().success()
}

/// A process that was ended is there until its parent has heard of it.
fn ends(pid: &str) {
    let start = Instant::now();
    while alive(pid) && start.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(!alive(pid), "the child {pid} goes on");
}

#[test]
fn a_hanging_compiler_is_stopped_with_all_that_it_started() {
    let folder = tempfile::tempdir().unwrap();
    let (started, hangs) = hanging(&folder);
    for (version, body) in [(":", hangs.as_str()), (hangs.as_str(), ":")] {
        let limit = Duration::from_millis(700);
        let options = COptions { time_limit: limit, ..script(&folder, version, body) };
        assert_eq!(told(by_c(1, &options).unwrap_err()).0, "TimedOut");
        ends(&wait_for(&started));
    }
    fs::remove_file(&started).unwrap();
    // One that is not wanted any more.
    let options = script(&folder, ":", &hangs);
    let stop = options.stop.clone();
    let compiling = std::thread::spawn(move || by_c(1, &options).unwrap_err());
    let pid = wait_for(&started);
    stop.store(true, Ordering::Relaxed);
    assert_eq!(told(compiling.join().unwrap()).0, "Stopped");
    ends(&pid);
}

/// The environment variable by which a test asks for a copy of itself that compiles with this compiler.
const HANGING: &str = "COADJOINT_TEST_HANGING";

#[test]
fn no_compiler_outlives_a_process_that_is_killed() {
    if let Some(compiler) = std::env::var_os(HANGING) {
        let _ = by_c(1, &COptions { compiler: Some(compiler), ..COptions::default() });
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (started, hangs) = hanging(&folder);
    let compiler = script(&folder, ":", &hangs).compiler.unwrap();
    let test = "faults::no_compiler_outlives_a_process_that_is_killed";
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", test]).env(HANGING, compiler).stdout(Stdio::null());
    let mut child = command.spawn().unwrap();
    let pid = wait_for(&started);
    assert!(alive(&pid));
    child.kill().unwrap();
    child.wait().unwrap();
    ends(&pid);
}

#[test]
fn a_library_of_another_version_is_never_called() {
    let folder = tempfile::tempdir().unwrap();
    let compiler = "text=$(for last; do [ \"${last%.c}\" != \"$last\" ] && echo \"$last\"; done)\n\
                    sed -i 's/coadjoint_sizes\\[4\\] = {[0-9]*/coadjoint_sizes[4] = {0/' \"$text\"\nexec cc \"$@\"";
    let (_, text) = told(by_c(1, &script(&folder, ":", compiler)).unwrap_err());
    assert!(text.contains("sizes [0, 3, 4"), "{text}");
}
