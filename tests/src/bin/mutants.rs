//! `cargo run -p coadjoint-tests --bin mutants [-- PART OF A PATH OR A TEXT]`
//!
//! Makes the changes of `tests/mutants.toml`, one after another, in a copy of the source tree, and runs the tests that must
//! notice: `runtime/tests/acceptance.rs`, `symbolic/tests/all/acceptance.rs`. Prints a table; ends with 1 where a mutant is
//! missed that is not known to be equivalent. The copy and its build lie in `target/mutants`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use serde::Deserialize;

/// A change of a file: a text that stands there once, what takes its place, and why no test can notice it, if none can.
#[derive(Clone, Debug, Deserialize)]
struct Mutant {
    file: String,
    from: String,
    to: String,
    equivalent: Option<String>,
}

/// The text of a file of this tree with a change made.
fn change(tree: &Path, Mutant { file, from, to, .. }: &Mutant) -> Result<String, String> {
    let text = std::fs::read_to_string(tree.join(file));
    let text = text.map_err(|error| format!("{file}: {error}"))?;
    match text.matches(from).count() {
        1 => Ok(text.replace(from, to)),
        _ => Err(format!("{file} has not exactly one {from:?}")),
    }
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let listed = Command::new("git").args(["ls-files", "-z"]).current_dir(from).output();
    let listed = listed.map_err(|error| format!("git: {error}"))?.stdout;
    for name in String::from_utf8_lossy(&listed).split('\0').filter(|name| !name.is_empty()) {
        let (source, target) = (from.join(name), to.join(name));
        if !source.is_file() {
            continue;
        }
        let folder = target.parent().unwrap_or(to);
        let same = std::fs::read(&source).ok() == std::fs::read(&target).ok();
        let made = std::fs::create_dir_all(folder).and_then(|()| match same {
            true => Ok(0),
            false => std::fs::copy(&source, &target),
        });
        made.map_err(|error| format!("{name}: {error}"))?;
    }
    Ok(())
}

/// The tests that judge this file: those of kernels, or of the generic step, which shares its limits with them.
fn tests(file: &str) -> &'static str {
    match file.starts_with("symbolic/") {
        true => "-p coadjoint-symbolic --features judge --test all acceptance",
        false => "-p coadjoint --no-default-features --features std --test acceptance",
    }
}

fn passes(tree: &Path, file: &str) -> Result<bool, String> {
    let status = Command::new("cargo")
        .arg("test")
        .args(tests(file).split(' '))
        .current_dir(tree)
        .env("CARGO_TARGET_DIR", tree.with_file_name("build"))
        .env("RUSTFLAGS", "-A warnings")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    Ok(status.map_err(|error| format!("cargo: {error}"))?.success())
}

fn run(only: &str) -> Result<bool, String> {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let tree = root.join("target/mutants/tree");
    copy(&root, &tree)?;
    let all: BTreeMap<String, Vec<Mutant>> =
        toml::from_str(include_str!("../../mutants.toml")).map_err(|error| error.to_string())?;
    let all = all.into_values().flatten().collect::<Vec<_>>();
    all.iter().try_for_each(|mutant| change(&root, mutant).map(drop))?;
    let (mut good, mut tried) = (true, "");
    for mutant in all.iter().filter(|one| one.file.contains(only) || one.from.contains(only)) {
        let Mutant { file, from, to, equivalent } = mutant;
        if tests(file) != tried {
            tried = tests(file);
            if !passes(&tree, file)? {
                return Err(format!("the tests of {file} fail without a change"));
            }
        }
        let path = tree.join(file);
        let write =
            |text: &str| std::fs::write(&path, text).map_err(|error| format!("{file}: {error}"));
        let text = std::fs::read_to_string(root.join(file)).map_err(|error| error.to_string())?;
        write(&change(&tree, mutant)?)?;
        let missed = passes(&tree, file);
        write(&text)?;
        let missed = missed?;
        good &= !missed || equivalent.is_some();
        let verdict = match (missed, equivalent) {
            (false, _) => "noticed".to_owned(),
            (true, Some(why)) => format!("equivalent: {why}"),
            (true, None) => "MISSED".to_owned(),
        };
        println!("{file}: {from:?} -> {to:?}: {verdict}");
    }
    Ok(good)
}

fn main() -> ExitCode {
    match run(&std::env::args().nth(1).unwrap_or_default()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
