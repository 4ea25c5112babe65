//! The layers of crates and folders: dependencies point downwards only.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders and files of `src`, the lowest first: each may use those before it, and itself.
const LAYERS: [&str; 16] = [
    "number",
    "error",
    "linear",
    "group",
    "table",
    "chart",
    "generating",
    "solve",
    "step",
    "lanes",
    "groups",
    "steps",
    "laws",
    "plumbing",
    "systems",
    "lib",
];

/// The crates, the lowest first.
const CRATES: [&str; 11] = [
    "draw", "program", "native", "symbolic", "codegen", "macros", "runtime", "learn", "run", "cli",
    "paper",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The layer of a file of `src`.
fn layer(src: &Path, file: &Path) -> usize {
    let inside = file.strip_prefix(src).unwrap();
    let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
    let name = first.strip_suffix(".rs").unwrap_or(first);
    LAYERS.iter().position(|layer| *layer == name).unwrap_or_else(|| panic!("{name} has no layer"))
}

/// The names after `crate::` in code, not in comments.
fn used(text: &str) -> BTreeSet<&str> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let paths = code.flat_map(|line| line.split("crate::").skip(1));
    let name =
        |path: &'_ str| path.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(path.len());
    paths.map(|path| path.split_at(name(path)).0).collect()
}

#[test]
fn folders_of_the_runtime_use_only_what_is_below() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime/src");
    let mut files = Vec::new();
    sources(&src, &mut files);
    assert!(files.len() > 60, "{} files", files.len());
    let mut uses = 0;
    for file in files {
        let own = layer(&src, &file);
        let text = fs::read_to_string(&file).unwrap();
        for name in used(&text) {
            let Some(other) = LAYERS.iter().position(|layer| *layer == name) else { continue };
            uses += 1;
            assert!(other <= own, "{} is below {name}", file.display());
        }
    }
    assert!(uses > 100, "{uses} uses");
}

#[test]
fn crates_depend_only_on_what_is_below() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let names: Vec<String> = CRATES
        .iter()
        .map(|krate| match *krate {
            "runtime" => "coadjoint".to_owned(),
            krate => format!("coadjoint-{krate}"),
        })
        .collect();
    for (own, krate) in CRATES.iter().enumerate() {
        let manifest = fs::read_to_string(root.join(krate).join("Cargo.toml")).unwrap();
        let dependencies = manifest.split("[dependencies]").nth(1).unwrap_or_default();
        let dependencies = dependencies.split("\n[").next().unwrap_or_default();
        for line in dependencies.lines() {
            let name = line.split(['.', ' ', '=']).next().unwrap_or_default();
            if let Some(other) = names.iter().position(|known| known == name) {
                assert!(other < own, "{krate} is below {name}");
            }
        }
    }
}
