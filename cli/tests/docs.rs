//! The commands on the pages run as they stand: every line of every `sh` block of README.md, the command's own
//! README and `docs/`, each page in a folder of its own. Files that a page shows (`toml` blocks that begin with
//! `# NAME.toml`) and the examples are there; what else a page supposes is made here.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use npyz::WriterBuilder;

mod support;

/// Pages with a test of their own, as they suppose files or must make some.
const WITH_FILES: [&str; 2] = ["ensembles.md", "learning.md"];

#[test]
fn the_two_commands_of_the_readme_stand_there() {
    let page = page("README.md");
    let commands = blocks(&page, "text").find(|block| block.contains("cargo")).unwrap();
    assert_eq!(
        commands,
        "cargo run --release -- simulate examples/rigid_body.toml\ncargo test --workspace\n"
    );
    let (code, out, err) = support::run(&["simulate", "examples/rigid_body.toml"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("drift"), "{out}");
}

#[test]
fn the_commands_own_readme() {
    let folder = tempfile::tempdir().unwrap();
    assert!(run("cli/README.md", folder.path()) >= 5);
    for made in ["run.csv", "run.svg", "body.rs"] {
        assert!(folder.path().join(made).exists(), "{made}");
    }
}

#[test]
fn learning() {
    let folder = tempfile::tempdir().unwrap();
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    for (name, count, seed) in [("train.csv", 60, 1), ("test.csv", 20, 2)] {
        let pairs = phase_pairs(&SO3::new(), &Quadratic::paper(), 0.1, wide, count, seed);
        write_pairs(&folder.path().join(name), &SO3::new(), &pairs).unwrap();
    }
    let system = support::root().join("examples/rigid_body.toml");
    std::fs::copy(system, folder.path().join("rigid_body.toml")).unwrap();
    assert!(run("docs/learning.md", folder.path()) >= 5);
    for made in ["model.json", "quartic.json", "run.csv", "quartic.rs"] {
        assert!(folder.path().join(made).exists(), "{made}");
    }
}

#[test]
fn ensembles() {
    let folder = tempfile::tempdir().unwrap();
    let file = std::fs::File::create(folder.path().join("states.npy")).unwrap();
    let options = npyz::WriteOptions::new().default_dtype().shape(&[2, 3]);
    let mut states = options.writer(file).begin_nd().unwrap();
    states.extend([2.0, 0.5, 1.0, 1.0, -0.5, 2.0]).unwrap();
    states.finish().unwrap();
    assert!(run("docs/ensembles.md", folder.path()) >= 2);
    assert!(folder.path().join("final.npy").exists());
}

#[test]
fn every_other_page() {
    let mut commands = run("README.md", tempfile::tempdir().unwrap().path());
    for entry in std::fs::read_dir(support::root().join("docs")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.ends_with(".md") && !WITH_FILES.contains(&name.as_str()) {
            commands += run(&format!("docs/{name}"), tempfile::tempdir().unwrap().path());
        }
    }
    assert!(commands >= 5, "{commands}");
}

fn page(path: &str) -> String {
    std::fs::read_to_string(support::root().join(path)).unwrap()
}

/// The fenced blocks of a language.
fn blocks<'a>(page: &'a str, language: &str) -> impl Iterator<Item = &'a str> {
    let fence = format!("```{language}\n");
    let starts: Vec<usize> = page.match_indices(&fence).map(|(at, _)| at + fence.len()).collect();
    starts.into_iter().map(|start| page[start..].split("```").next().unwrap())
}

/// Runs the commands of the page at `path` in `folder`, and counts them.
fn run(path: &str, folder: &Path) -> usize {
    let page = page(path);
    std::fs::create_dir_all(folder.join("examples")).unwrap();
    for entry in std::fs::read_dir(support::root().join("examples")).unwrap() {
        let file = entry.unwrap().path();
        if file.is_file() {
            std::fs::copy(&file, folder.join("examples").join(file.file_name().unwrap())).unwrap();
        }
    }
    for block in blocks(&page, "toml") {
        let first = block.lines().next().unwrap_or_default();
        let name = first.trim_start_matches('#').split([':', ' ']).find(|word| !word.is_empty());
        if let Some(name) = name.filter(|name| first.starts_with('#') && name.ends_with(".toml")) {
            std::fs::write(folder.join(name), block).unwrap();
        }
    }
    let commands: Vec<&str> = blocks(&page, "sh").flat_map(str::lines).collect();
    for command in &commands {
        let words: Vec<&str> = command.split_whitespace().collect();
        assert_eq!(words[0], "coadjoint", "{path}: {command}");
        let output = support::coadjoint().current_dir(folder).args(&words[1..]).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{path}: {command}: {said}");
    }
    commands.len()
}
