//! The layers of crates and folders: dependencies point downwards only.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;

use coadjoint_tests::sources;

/// Folders and files of `src`, the lowest first: each may use those before it, and itself.
const LAYERS: [&str; 18] = [
    "number",
    "error",
    "linear",
    "group",
    "table",
    "chart",
    "generating",
    "solve",
    "step",
    "collocation",
    "lanes",
    "lattice",
    "groups",
    "steps",
    "laws",
    "plumbing",
    "systems",
    "lib",
];

/// The crates, the lowest first.
const CRATES: [&str; 12] = [
    "draw", "geometry", "program", "native", "symbolic", "codegen", "macros", "runtime", "learn",
    "run", "cli", "paper",
];

/// The layer of a file of `src`.
fn layer(file: &str) -> usize {
    let first = file.split('/').next().unwrap();
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
    let files = sources::rust("runtime/src");
    assert!(files.len() > 40, "{} files", files.len());
    let mut uses = 0;
    for (file, text) in files {
        let own = layer(file.trim_start_matches("runtime/src/"));
        for name in used(&text) {
            let Some(other) = LAYERS.iter().position(|layer| *layer == name) else { continue };
            uses += 1;
            assert!(other <= own, "{file} is below {name}");
        }
    }
    assert!(uses > 100, "{uses} uses");
}

#[test]
fn crates_depend_only_on_what_is_below() {
    let names: Vec<String> = CRATES
        .iter()
        .map(|krate| match *krate {
            "runtime" => "coadjoint".to_owned(),
            krate => format!("coadjoint-{krate}"),
        })
        .collect();
    for (own, krate) in CRATES.iter().enumerate() {
        let manifest = sources::read(&format!("{krate}/Cargo.toml"));
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
