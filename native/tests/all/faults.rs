//! Compilers and caches that are broken: a clear error, or the step all the same.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::samples::{Chance, Sample, Seen, compare};
use coadjoint_native::{COptions, CacheFolder, Native, NativeError};
use tempfile::TempDir;

fn by_c(seed: u64, options: &COptions) -> Result<Native, NativeError> {
    Native::by_c(&Sample::small(seed).kernel, options)
}

/// The step of the small kernel of this seed, through this cache: whether it was found there, and that it is right.
fn cached(seed: u64, cache: &Path) -> bool {
    let options = COptions { cache: CacheFolder::At(cache.to_owned()), ..COptions::default() };
    let native = by_c(seed, &options).unwrap();
    let mut seen = Seen::default();
    compare(&Sample::small(seed), &native.entry, 300, &mut Chance(9), &mut seen);
    native.cached
}

/// A folder, and the path of a cache in it that is not there yet.
fn new_cache() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("deep/cache");
    (folder, cache)
}

/// The entries of a cache.
fn entries(cache: &Path) -> Vec<PathBuf> {
    let mut list: Vec<PathBuf> =
        fs::read_dir(cache).unwrap().map(|entry| entry.unwrap().path()).collect();
    list.sort();
    list
}

/// A compiler that is this shell script; it gives its version unless the script does first.
fn script(folder: &TempDir, version: &str, body: &str) -> COptions {
    let path = folder.path().join("compiler");
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = --version ]; then {version}; echo script 1; exit 0; fi\n{body}\n"
    );
    fs::write(&path, text).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    COptions { compiler: Some(path.into()), cache: CacheFolder::None, ..COptions::default() }
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

/// The environment variables by which a test asks for a copy of itself that compiles with this compiler, or in this cache.
const HANGING: &str = "COADJOINT_TEST_HANGING";
const CHILD: &str = "COADJOINT_TEST_CACHE";

/// A copy of this program that runs one test with a variable set.
fn copy(test: &str, variable: &str, value: impl AsRef<std::ffi::OsStr>) -> Child {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", test]).env(variable, value).stdout(Stdio::null()).spawn().unwrap()
}

#[test]
fn no_compiler_outlives_a_process_that_is_killed() {
    if let Some(compiler) = std::env::var_os(HANGING) {
        let (compiler, cache) = (Some(compiler), CacheFolder::None);
        let _ = by_c(1, &COptions { compiler, cache, ..COptions::default() });
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (started, hangs) = hanging(&folder);
    let compiler = script(&folder, ":", &hangs).compiler.unwrap();
    let test = "faults::no_compiler_outlives_a_process_that_is_killed";
    let mut child = copy(test, HANGING, compiler);
    let pid = wait_for(&started);
    assert!(alive(&pid));
    child.kill().unwrap();
    child.wait().unwrap();
    ends(&pid);
}

/// Compiles some steps, in a copy of this program; else it starts one itself.
#[test]
fn a_process_compiles() {
    if let Some(cache) = std::env::var_os(CHILD) {
        for seed in 1..5 {
            cached(seed, Path::new(&cache));
        }
        return;
    }
    let (_folder, cache) = new_cache();
    assert!(child(&cache).wait().unwrap().success());
}

fn child(cache: &Path) -> Child {
    copy("faults::a_process_compiles", CHILD, cache)
}

#[test]
fn a_second_run_finds_the_first_ones_step() {
    let (_folder, cache) = new_cache();
    assert!(!cached(1, &cache) && cached(1, &cache));
    assert!(!cached(2, &cache), "another step is another entry");
    assert_eq!(entries(&cache).len(), 2);
    assert_eq!(fs::metadata(&cache).unwrap().mode() & 0o777, 0o700);
}

/// Where groups of users share files, new folders can be written to by the group unless they are made otherwise.
#[test]
fn the_cache_works_under_any_umask() {
    let (_folder, cache) = new_cache();
    for _ in 0..2 {
        let status = Command::new("sh")
            .args(["-c", "umask 002; exec \"$0\" --exact faults::a_process_compiles"])
            .arg(std::env::current_exe().unwrap())
            .env(CHILD, &cache)
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert!(status.success());
    }
    assert!(cached(1, &cache));
}

#[test]
fn a_cache_that_cannot_be_used_is_done_without() {
    let folder = tempfile::tempdir().unwrap();
    let [file, open, target, link] =
        ["file", "open", "target", "link"].map(|name| folder.path().join(name));
    fs::write(&file, "a file").unwrap();
    // Written to by others.
    fs::create_dir(&open).unwrap();
    fs::set_permissions(&open, fs::Permissions::from_mode(0o777)).unwrap();
    // A link to a folder that would do.
    fs::DirBuilder::new().mode(0o700).create(&target).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    // Folders where nothing can be written, or that somebody else owns.
    let unwritable = PathBuf::from("/proc/self/coadjoint");
    for cache in [&file, &file.join("below"), &open, &link, &unwritable, &PathBuf::from("/proc")] {
        assert!(!cached(1, cache), "{}", cache.display());
    }
    assert!(entries(&open).is_empty() && entries(&target).is_empty());
}

/// In a namespace of its own, where a disk of two pages can be mounted without anybody's leave.
#[test]
fn a_full_disk_is_done_without() {
    let namespace = || {
        let mut command = Command::new("unshare");
        command.args(["--map-root-user", "--mount", "sh", "-c"]);
        command
    };
    let folder = tempfile::tempdir().unwrap();
    let mount = "mount -t tmpfs -o size=8k,mode=700 none \"$0\"";
    let status = namespace().args([mount, "."]).current_dir(&folder).stderr(Stdio::null()).status();
    if !status.is_ok_and(|status| status.success()) {
        println!("skipped: no disk can be mounted in a namespace (unshare, util-linux)");
        return;
    }
    let cache = folder.path().join("cache");
    fs::DirBuilder::new().mode(0o700).create(&cache).unwrap();
    let full = format!(
        "{mount} && echo filled > \"$0/file\" && \"$1\" --exact faults::a_process_compiles && ls -A \"$0\""
    );
    let output = namespace()
        .args([full.as_str(), cache.to_str().unwrap()])
        .arg(std::env::current_exe().unwrap())
        .env(CHILD, &cache)
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    assert!(output.stdout.ends_with(b"\nfile\n"), "{output:?}");
}

#[test]
fn entries_that_were_changed_are_never_loaded() {
    let (_folder, cache) = new_cache();
    cached(1, &cache);
    let entry = entries(&cache).remove(0);
    let library = entry.join("step.so");
    let whole = fs::read(&library).unwrap();
    let try_again = |what: &str| {
        assert!(!cached(1, &cache), "{what}");
        assert!(cached(1, &cache), "{what}: mended");
        assert_eq!(fs::read(&library).unwrap().len(), whole.len());
    };
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 1;
    for (what, bytes) in
        [("half a file", &whole[..whole.len() / 2]), ("a bit", &changed), ("nothing", &[])]
    {
        // A new file: the old one may be in use.
        fs::remove_file(&library).unwrap();
        fs::write(&library, bytes).unwrap();
        fs::set_permissions(&library, fs::Permissions::from_mode(0o600)).unwrap();
        try_again(what);
    }
    fs::remove_file(entry.join("sha256")).unwrap();
    try_again("no hash");
    fs::set_permissions(&library, fs::Permissions::from_mode(0o666)).unwrap();
    try_again("written to by others");
    fs::rename(&library, entry.join("elsewhere")).unwrap();
    std::os::unix::fs::symlink(entry.join("elsewhere"), &library).unwrap();
    try_again("a link");
    fs::remove_dir_all(&entry).unwrap();
    fs::write(&entry, "not a folder").unwrap();
    try_again("a file in the place of the entry");
    if fs::metadata(&cache).unwrap().uid() == 0 {
        std::os::unix::fs::chown(&library, Some(12345), None).unwrap();
        try_again("somebody else's");
    } else {
        println!("not run as root: an entry of another owner was not made");
    }
}

#[test]
fn entries_of_other_steps_and_versions_are_never_called() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, three] = ["one", "two", "three"].map(|name| folder.path().join(name));
    cached(1, &one);
    let entry = entries(&one).remove(0);
    let replace = |from: &Path| {
        for name in ["step.so", "sha256"] {
            fs::remove_file(entry.join(name)).unwrap();
            fs::copy(from.join(name), entry.join(name)).unwrap();
        }
        assert!(!cached(1, &one));
    };
    // A library with other sizes under this entry's name, hash and all.
    let options = COptions { cache: CacheFolder::At(two.clone()), ..COptions::default() };
    Native::by_c(&Sample::with_element(1, 5).kernel, &options).unwrap();
    replace(&entries(&two)[0]);
    // The same step, by a version that exported something else.
    let compiler = "text=$(for last; do [ \"${last%.c}\" != \"$last\" ] && echo \"$last\"; done)\n\
                    sed -i 's/coadjoint_sizes\\[4\\] = {[0-9]*/coadjoint_sizes[4] = {0/' \"$text\"\nexec cc \"$@\"";
    let by_old =
        COptions { cache: CacheFolder::At(three.clone()), ..script(&folder, ":", compiler) };
    let (_, text) = told(by_c(1, &by_old).unwrap_err());
    assert!(text.contains("sizes [0, 3, 4"), "{text}");
    replace(&entries(&three)[0]);
}

#[test]
fn what_a_killed_writer_left_is_removed_when_it_is_old() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    fs::DirBuilder::new().mode(0o700).create(&cache).unwrap();
    let (old, new) = (cache.join(".stage-old"), cache.join(".stage-new"));
    for stage in [&old, &new] {
        fs::create_dir(stage).unwrap();
        fs::write(stage.join("step.so"), "half").unwrap();
    }
    let status = Command::new("touch").args(["-d", "2 days ago"]).arg(&old).status().unwrap();
    assert!(status.success());
    cached(1, &cache);
    assert!(!old.exists() && new.exists());
}

#[test]
fn processes_that_compile_at_once_leave_one_whole_entry_each() {
    let (_folder, cache) = new_cache();
    let children: Vec<_> = (0..3).map(|_| child(&cache)).collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    assert_eq!(entries(&cache).len(), 4);
    assert!((1..5).all(|seed| cached(seed, &cache)));
}

#[test]
fn a_process_killed_at_any_moment_leaves_nothing_that_is_wrong() {
    let (_folder, cache) = new_cache();
    for pause in [20, 60, 110, 170, 240, 320] {
        let mut child = child(&cache);
        std::thread::sleep(Duration::from_millis(pause));
        let _ = child.kill();
        let _ = child.wait();
    }
    for seed in 1..5 {
        cached(seed, &cache);
    }
}
