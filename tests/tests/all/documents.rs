//! The pages of the repository: what they link to exists, and what they repeat is the same everywhere.
#![allow(clippy::unwrap_used)]

use std::fs;

use coadjoint_tests::sources::{self, read, root};

/// Folders of crates that are published.
const PUBLISHED: [&str; 7] = ["draw", "codegen", "macros", "runtime", "learn", "run", "cli"];

/// The names in a folder that end in `ending`, sorted.
fn files(folder: &str, ending: &str) -> Vec<String> {
    let names = fs::read_dir(root().join(folder)).unwrap();
    let mut names: Vec<String> =
        names.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| name.ends_with(ending));
    names.sort();
    names
}

/// Every page of the repository, by its path from the root.
fn pages() -> Vec<String> {
    let mut pages = files(".", ".md");
    for folder in
        ["docs", "docs/book/src", "docs/measurements", "examples", "bench"].iter().chain(&PUBLISHED)
    {
        pages.extend(files(folder, ".md").iter().map(|name| format!("{folder}/{name}")));
    }
    pages
}

/// The text of a page without its fenced blocks.
fn prose(page: &str) -> String {
    page.split("\n```").step_by(2).collect()
}

/// The targets of links and pictures within the repository: file and heading.
fn links(page: &str) -> Vec<(String, String)> {
    let prose = prose(page);
    let starts = prose.match_indices("](").map(|(at, _)| at + 2);
    let pictures = prose.match_indices("src=\"").map(|(at, _)| at + 5);
    let targets = starts.chain(pictures).filter_map(|at| prose[at..].split([')', '"']).next());
    let targets = targets.filter(|target| !target.is_empty() && !target.contains(':'));
    let parts = targets.map(|target| target.split_once('#').unwrap_or((target, "")));
    parts.map(|(file, heading)| (file.to_owned(), heading.to_owned())).collect()
}

/// The anchors of a page's headings.
fn headings(page: &str) -> Vec<String> {
    let prose = prose(page);
    let titles = prose.lines().filter(|line| line.starts_with('#'));
    let name = |title: &str| {
        let title = title.trim_start_matches('#').trim().to_lowercase();
        let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
        title.chars().filter(kept).collect::<String>().replace(' ', "-")
    };
    titles.map(name).collect()
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut count = 0;
    let mut missing = Vec::new();
    for page in pages() {
        let folder = root().join(&page).parent().unwrap().to_owned();
        for (file, heading) in links(&read(&page)) {
            count += 1;
            let target = if file.is_empty() { root().join(&page) } else { folder.join(&file) };
            let there = target.exists()
                && (heading.is_empty()
                    || headings(&fs::read_to_string(&target).unwrap()).contains(&heading));
            if !there {
                missing.push(format!("{page} links to {file}#{heading}"));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
    assert!(count > 150, "{count}");
}

/// The manual's table of contents and its chapters are the same.
/// No page has marks that a merge left.
#[test]
fn pages_are_merged() {
    for page in pages() {
        let marked = read(&page)
            .lines()
            .any(|line| ["<<<<<<< ", ">>>>>>> "].iter().any(|mark| line.starts_with(mark)));
        assert!(!marked, "{page}");
    }
}

#[test]
fn every_chapter_is_in_the_contents() {
    let mut listed: Vec<String> =
        links(&read("docs/book/src/SUMMARY.md")).into_iter().map(|(file, _)| file).collect();
    listed.push("SUMMARY.md".into());
    listed.sort();
    assert_eq!(listed, files("docs/book/src", ".md"));
}

/// Chapters with Rust are compiled and run: `src/lib.rs` lists them.
#[test]
fn every_chapter_with_rust_is_tested() {
    let tested = read("tests/src/lib.rs");
    for name in files("docs/book/src", ".md") {
        let page = read(&format!("docs/book/src/{name}"));
        let listed = tested.contains(&format!("docs/book/src/{name}\";"));
        assert_eq!(page.contains("\n```rust"), listed, "{name}");
    }
}

#[test]
fn every_measurement_is_listed() {
    let overview = read("docs/measurements/README.md");
    for name in files("docs/measurements", ".md") {
        assert!(name == "README.md" || overview.contains(&format!("({name})")), "{name}");
    }
}

/// The tests that a text names as `file.rs::name`; each of them is there.
fn named_tests(text: &str) -> usize {
    let names: Vec<_> = text.split('`').filter_map(|word| word.split_once(".rs::")).collect();
    for (file, name) in &names {
        let source = read(&format!("{file}.rs"));
        assert!(source.contains(&format!("fn {name}(")), "{file}.rs::{name}");
    }
    names.len()
}

/// The map of the code is short, its files and folders are there, and every invariant names a test that holds it.
#[test]
fn the_map_of_the_code_is_true() {
    let page = read("ARCHITECTURE.md");
    let lines = page.lines().count();
    assert!(lines <= 120, "{lines}");
    let prose = prose(&page);
    for path in prose.split('`').skip(1).step_by(2).filter(|word| word.contains('/')) {
        let path = path.split("::").next().unwrap();
        let there = |folder: &str| root().join(folder).join(path).exists();
        let inside = || ["codegen/src", "symbolic/src"].iter().any(|folder| there(folder));
        assert!(there("") || inside(), "{path}");
    }
    let invariants = page.split("\n## Invariants\n").nth(1).unwrap();
    let invariants = invariants.split("\n## ").next().unwrap();
    // An item begins with its number; its other lines are indented.
    let items: Vec<String> = invariants.replace("\n   ", " ").lines().map(str::to_owned).collect();
    let items: Vec<_> = items.iter().filter(|line| !line.is_empty()).collect();
    assert!(items.len() >= 8, "{items:#?}");
    for item in items {
        assert!(named_tests(item) > 0, "no test holds this: {item}");
    }
}

/// A comment begins with its subject: no more than 20 begin with "What".
#[test]
fn comments_begin_with_their_subject() {
    let sources = sources::rust("");
    assert!(sources.len() > 300, "{}", sources.len());
    let (mut what, mut many) = (Vec::new(), Vec::new());
    for (path, text) in sources {
        for (number, line) in text.lines().enumerate() {
            let Some(comment) = line.trim_start().strip_prefix("//") else { continue };
            let place = || format!("{path}:{}: {line}", number + 1);
            if comment.trim_start_matches(['/', '!', ' ']).starts_with("What ") {
                what.push(place());
            }
            if comment.to_lowercase().contains("so many ") {
                many.push(place());
            }
        }
    }
    assert!(what.len() <= 20, "{what:#?}");
    assert!(many.is_empty(), "{many:#?}");
}

#[test]
fn every_example_is_listed() {
    let overview = read("examples/README.md");
    for name in files("examples", ".toml") {
        assert!(overview.contains(&format!("({name})")), "{name}");
    }
}

#[test]
fn crates_carry_the_licences_of_the_root() {
    for name in ["LICENSE-MIT", "LICENSE-APACHE"] {
        for folder in PUBLISHED {
            assert_eq!(read(&format!("{folder}/{name}")), read(name), "{folder}/{name}");
        }
    }
}

#[test]
fn readme_and_manual_name_the_version() {
    let manifest = read("Cargo.toml");
    let version = manifest.split("\nversion = \"").nth(1).unwrap().split('"').next().unwrap();
    let (series, _) = version.rsplit_once('.').unwrap();
    for page in ["README.md", "docs/book/src/start.md"] {
        assert!(read(page).contains(&format!("\ncoadjoint = \"{series}\"")), "{page}: {series}");
    }
    assert!(read("CHANGELOG.md").contains(version), "{version}");
}

#[test]
fn banned_crates_stay_out_of_the_lock_file() {
    let banned = read("deny.toml");
    let banned =
        banned.split("\n    { crate = \"").skip(1).map(|rest| rest.split('"').next().unwrap());
    let lock = read("Cargo.lock");
    let names: Vec<&str> = banned.collect();
    assert!(names.len() >= 5, "{names:?}");
    for name in names {
        assert!(!lock.contains(&format!("name = \"{name}\"\n")), "{name}");
    }
}
