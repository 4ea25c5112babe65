//! Compilers and caches that are broken: a clear error, or the step all the same.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crate::common::{bits, kernel, lane, state};
use coadjoint_native::{COptions, CacheFolder, Native, NativeError};
use coadjoint_program::{Kernel, Stepper};

fn alive(pid: &str) -> bool {
    let status = Command::new("kill").args(["-0", pid.trim()]).stderr(Stdio::null()).status();
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

fn small(seed: u64) -> Kernel {
    kernel(seed, [3, 4, 1], 20, true, 0.05)
}

fn options(cache: &Path) -> COptions {
    COptions { cache: CacheFolder::At(cache.to_owned()), ..COptions::default() }
}

/// A compiler that is this shell script; it gives its version unless the script does first.
fn script(folder: &Path, version: &str, body: &str) -> COptions {
    let path = folder.join("compiler");
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = --version ]; then {version}; echo script 1; exit 0; fi\n{body}\n"
    );
    fs::write(&path, text).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    COptions { compiler: Some(path.into()), cache: CacheFolder::None, ..COptions::default() }
}

fn same_bits(kernel: &Kernel, native: &Native) {
    let (slots, g, mu) = state(kernel, 9);
    for r in 0..4 {
        let (mut g, mut mu) = (lane(&g, r), lane(&mu, r));
        let (mut g_expected, mut mu_expected) = (g.clone(), mu.clone());
        let expected = kernel.advance(&slots, &mut g_expected, &mut mu_expected, 300);
        assert_eq!(native.entry.advance(&slots, &mut g, &mut mu, 300), expected);
        assert_eq!(bits(&g), bits(&g_expected));
        assert_eq!(bits(&mu), bits(&mu_expected));
    }
}

/// The entries of a cache.
fn entries(cache: &Path) -> Vec<PathBuf> {
    let mut list: Vec<PathBuf> =
        fs::read_dir(cache).unwrap().map(|entry| entry.unwrap().path()).collect();
    list.sort();
    list
}

fn is_one_line(error: &NativeError) -> String {
    let text = error.to_string();
    assert!(!text.contains('\n') && text.len() < 600, "{text}");
    text
}

#[test]
fn a_second_run_finds_the_first_ones_step() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("deep/cache");
    let kernel = small(1);
    let first = Native::by_c(&kernel, &options(&cache)).unwrap();
    let second = Native::by_c(&kernel, &options(&cache)).unwrap();
    assert!(!first.cached && second.cached);
    same_bits(&kernel, &first);
    same_bits(&kernel, &second);
    let other = Native::by_c(&small(2), &options(&cache)).unwrap();
    assert!(!other.cached, "another step is another entry");
    assert_eq!(entries(&cache).len(), 2);
    assert_eq!(fs::metadata(&cache).unwrap().mode() & 0o777, 0o700);
}

#[test]
fn a_missing_compiler_is_named() {
    let compiler = Some("/nowhere/no-such-compiler".into());
    let error = Native::by_c(&small(1), &COptions { compiler, ..COptions::default() }).unwrap_err();
    assert!(matches!(error, NativeError::Start { .. }), "{error:?}");
    assert!(is_one_line(&error).contains("/nowhere/no-such-compiler"));
}

#[test]
fn a_broken_compiler_is_named_with_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let says = "echo; echo 'In file x:' >&2; echo 'step.c:1: error: no such thing' >&2; exit 3";
    let error = Native::by_c(&small(1), &script(folder.path(), ":", says)).unwrap_err();
    assert!(matches!(error, NativeError::Failed { .. }), "{error:?}");
    let text = is_one_line(&error);
    assert!(text.contains("error: no such thing") && text.contains("exit status: 3"), "{text}");

    let silent = Native::by_c(&small(1), &script(folder.path(), ":", "exit 1")).unwrap_err();
    assert!(is_one_line(&silent).contains("it said nothing"));
    let killed = Native::by_c(&small(1), &script(folder.path(), ":", "kill -9 $$")).unwrap_err();
    assert!(is_one_line(&killed).contains("signal: 9"));
    let lazy = Native::by_c(&small(1), &script(folder.path(), ":", "exit 0")).unwrap_err();
    assert!(matches!(lazy, NativeError::NoLibrary { .. }), "{lazy:?}");
    let answer = Native::by_c(&small(1), &script(folder.path(), "exit 7", "")).unwrap_err();
    assert!(matches!(answer, NativeError::Failed { .. }), "{answer:?}");
}

#[test]
fn a_library_that_is_none_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let writes = "while [ \"$1\" != -o ]; do shift; done; echo rubbish > \"$2\"";
    let error = Native::by_c(&small(1), &script(folder.path(), ":", writes)).unwrap_err();
    assert!(matches!(error, NativeError::Load { .. }), "{error:?}");
    is_one_line(&error);
    let other =
        "while [ \"$1\" != -o ]; do shift; done; echo 'int x;' | cc -shared -xc - -o \"$2\"";
    let error = Native::by_c(&small(1), &script(folder.path(), ":", other)).unwrap_err();
    assert!(is_one_line(&error).contains("coadjoint_sizes"), "{error}");
}

#[test]
fn a_hanging_compiler_is_stopped_with_all_that_it_started() {
    let folder = tempfile::tempdir().unwrap();
    let started = folder.path().join("started");
    let hangs = format!("sleep 1000 & echo $! > {}; wait", started.display());
    for (version, body) in [(":", hangs.as_str()), (hangs.as_str(), ":")] {
        let limit = Duration::from_millis(700);
        let options = COptions { time_limit: limit, ..script(folder.path(), version, body) };
        let error = Native::by_c(&small(1), &options).unwrap_err();
        assert!(matches!(error, NativeError::TimedOut { .. }), "{error:?}");
        is_one_line(&error);
        let pid = fs::read_to_string(&started).unwrap();
        ends(&pid);
    }
}

#[test]
fn a_compiler_that_is_not_wanted_is_stopped_with_all_that_it_started() {
    let folder = tempfile::tempdir().unwrap();
    let started = folder.path().join("started");
    let hangs = format!("sleep 1000 & echo $! > {}; wait", started.display());
    let options = script(folder.path(), ":", &hangs);
    let stop = options.stop.clone();
    let compiling = std::thread::spawn(move || Native::by_c(&small(1), &options).unwrap_err());
    while fs::read_to_string(&started).unwrap_or_default().is_empty() {
        std::thread::sleep(Duration::from_millis(5));
    }
    stop.store(true, Ordering::Relaxed);
    let error = compiling.join().unwrap();
    assert!(matches!(error, NativeError::Stopped { .. }), "{error:?}");
    ends(&fs::read_to_string(&started).unwrap());
}

/// The environment variable by which a test asks for a copy of itself that compiles with this compiler.
const HANGING: &str = "COADJOINT_TEST_HANGING";

#[test]
fn no_compiler_outlives_a_process_that_is_killed() {
    if let Some(compiler) = std::env::var_os(HANGING) {
        let (compiler, cache) = (Some(compiler), CacheFolder::None);
        let _ = Native::by_c(&small(1), &COptions { compiler, cache, ..COptions::default() });
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let started = folder.path().join("started");
    let hangs = format!("sleep 1000 & echo $! > {}; wait", started.display());
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "faults::no_compiler_outlives_a_process_that_is_killed"])
        .env(HANGING, script(folder.path(), ":", &hangs).compiler.unwrap())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while fs::read_to_string(&started).unwrap_or_default().is_empty() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let pid = fs::read_to_string(&started).unwrap();
    assert!(alive(&pid));
    child.kill().unwrap();
    child.wait().unwrap();
    ends(&pid);
}

/// Where groups of users share files, new folders can be written to by the group unless they are made otherwise.
#[test]
fn the_cache_works_under_any_umask() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
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
    assert!(Native::by_c(&small(1), &options(&cache)).unwrap().cached);
}

#[test]
fn a_cache_that_cannot_be_used_is_done_without() {
    let folder = tempfile::tempdir().unwrap();
    let kernel = small(1);
    let file = folder.path().join("file");
    fs::write(&file, "a file").unwrap();
    // Written to by others.
    let open = folder.path().join("open");
    fs::DirBuilder::new().create(&open).unwrap();
    fs::set_permissions(&open, fs::Permissions::from_mode(0o777)).unwrap();
    // A link to a folder that would do.
    let (target, link) = (folder.path().join("target"), folder.path().join("link"));
    fs::DirBuilder::new().mode(0o700).create(&target).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    // Folders where nothing can be written, or that somebody else owns.
    let unwritable = PathBuf::from("/proc/self/coadjoint");
    for cache in [&file, &file.join("below"), &open, &link, &unwritable, &PathBuf::from("/proc")] {
        let native = Native::by_c(&kernel, &options(cache)).unwrap();
        assert!(!native.cached, "{}", cache.display());
        same_bits(&kernel, &native);
    }
    assert!(entries(&open).is_empty() && entries(&target).is_empty());
}

#[test]
fn a_file_in_the_place_of_an_entry_gives_way() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let kernel = small(1);
    Native::by_c(&kernel, &options(&cache)).unwrap();
    let entry = entries(&cache).remove(0);
    fs::remove_dir_all(&entry).unwrap();
    fs::write(&entry, "not a folder").unwrap();
    let native = Native::by_c(&kernel, &options(&cache)).unwrap();
    assert!(!native.cached);
    same_bits(&kernel, &native);
    assert!(Native::by_c(&kernel, &options(&cache)).unwrap().cached);
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
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let kernel = small(1);
    Native::by_c(&kernel, &options(&cache)).unwrap();
    let entry = entries(&cache).remove(0);
    let library = entry.join("step.so");
    let whole = fs::read(&library).unwrap();
    let try_again = |what: &str| {
        let native = Native::by_c(&kernel, &options(&cache)).unwrap();
        assert!(!native.cached, "{what}");
        same_bits(&kernel, &native);
        assert!(Native::by_c(&kernel, &options(&cache)).unwrap().cached, "{what}: mended");
        assert_eq!(fs::read(&library).unwrap().len(), whole.len());
    };
    let replace = |bytes: &[u8]| {
        // A new file: the old one may be in use.
        fs::remove_file(&library).unwrap();
        fs::write(&library, bytes).unwrap();
        fs::set_permissions(&library, fs::Permissions::from_mode(0o600)).unwrap();
    };
    replace(&whole[..whole.len() / 2]);
    try_again("half a file");
    let mut changed = whole.clone();
    let middle = changed.len() / 2;
    changed[middle] ^= 1;
    replace(&changed);
    try_again("a bit");
    replace(&[]);
    try_again("nothing");
    fs::remove_file(entry.join("sha256")).unwrap();
    try_again("no hash");
    fs::set_permissions(&library, fs::Permissions::from_mode(0o666)).unwrap();
    try_again("written to by others");
    fs::rename(&library, entry.join("elsewhere")).unwrap();
    std::os::unix::fs::symlink(entry.join("elsewhere"), &library).unwrap();
    try_again("a link");
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
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    let kernel = small(1);
    Native::by_c(&kernel, &options(&one)).unwrap();
    let entry = entries(&one).remove(0);
    // A library with other sizes under this entry's name, hash and all.
    Native::by_c(&crate::common::kernel(1, [4, 4, 1], 20, true, 0.05), &options(&two)).unwrap();
    let replace = |from: &Path| {
        for name in ["step.so", "sha256"] {
            fs::remove_file(entry.join(name)).unwrap();
            fs::copy(from.join(name), entry.join(name)).unwrap();
        }
    };
    replace(&entries(&two)[0]);
    let native = Native::by_c(&kernel, &options(&one)).unwrap();
    assert!(!native.cached);
    same_bits(&kernel, &native);
    // The same step, by a version that exported something else.
    let old = folder.path().join("three");
    let compiler = "text=$(for last; do [ \"${last%.c}\" != \"$last\" ] && echo \"$last\"; done)\n\
                    sed -i 's/coadjoint_sizes\\[4\\] = {[0-9]*/coadjoint_sizes[4] = {0/' \"$text\"\nexec cc \"$@\"";
    let by_old =
        COptions { cache: CacheFolder::At(old.clone()), ..script(folder.path(), ":", compiler) };
    let error = Native::by_c(&kernel, &by_old).unwrap_err();
    assert!(is_one_line(&error).contains("sizes [0, 3, 4"), "{error}");
    replace(&entries(&old)[0]);
    let native = Native::by_c(&kernel, &options(&one)).unwrap();
    same_bits(&kernel, &native);
    assert!(!native.cached);
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
    Native::by_c(&small(1), &options(&cache)).unwrap();
    assert!(!old.exists() && new.exists());
}

/// The environment variable by which a test asks for a copy of itself that compiles in this cache.
const CHILD: &str = "COADJOINT_TEST_CACHE";

/// Compiles some steps, in a process that [`child`] has started; else it starts one itself.
#[test]
fn a_process_compiles() {
    match std::env::var_os(CHILD) {
        Some(cache) => {
            for seed in 1..5 {
                let native = Native::by_c(&small(seed), &options(Path::new(&cache))).unwrap();
                same_bits(&small(seed), &native);
            }
        }
        None => {
            let folder = tempfile::tempdir().unwrap();
            assert!(child(&folder.path().join("cache")).wait().unwrap().success());
        }
    }
}

fn child(cache: &Path) -> std::process::Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "faults::a_process_compiles"])
        .env(CHILD, cache)
        .stdout(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
fn processes_that_compile_at_once_leave_one_whole_entry_each() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let mut children: Vec<_> = (0..3).map(|_| child(&cache)).collect();
    for child in &mut children {
        assert!(child.wait().unwrap().success());
    }
    assert_eq!(entries(&cache).len(), 4);
    for seed in 1..5 {
        let native = Native::by_c(&small(seed), &options(&cache)).unwrap();
        assert!(native.cached);
        same_bits(&small(seed), &native);
    }
}

#[test]
fn a_process_killed_at_any_moment_leaves_nothing_that_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    for pause in [20, 60, 110, 170, 240, 320] {
        let mut child = child(&cache);
        std::thread::sleep(Duration::from_millis(pause));
        let _ = child.kill();
        let _ = child.wait();
    }
    for seed in 1..5 {
        let native = Native::by_c(&small(seed), &options(&cache)).unwrap();
        same_bits(&small(seed), &native);
    }
}
