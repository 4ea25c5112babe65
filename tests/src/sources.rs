//! The files of the repository, committed texts among them.

use std::fs;
use std::path::{Path, PathBuf};

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

pub fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// The paths from the root of all Rust files below a folder, with their texts; folders of builds are left out.
pub fn rust(folder: &str) -> Vec<(String, String)> {
    files(folder, ".rs")
}

/// As [`rust`], of all files whose names end so.
pub fn files(folder: &str, ending: &str) -> Vec<(String, String)> {
    let root = root();
    let (mut folders, mut files) = (vec![root.join(folder)], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy();
            if path.is_dir() {
                let skipped = name.starts_with('.') || name == "target" || name == "node_modules";
                folders.extend((!skipped).then_some(path));
            } else if name.ends_with(ending) {
                let inside = path.strip_prefix(&root).unwrap().to_string_lossy();
                files.push((inside.into_owned(), fs::read_to_string(&path).unwrap()));
            }
        }
    }
    files
}

/// Compares a text with the committed file of this name in `tests/golden`; with `COADJOINT_BLESS` set, writes the file.
pub fn golden(name: &str, text: &str) {
    let path = root().join("tests/golden").join(name);
    if std::env::var_os("COADJOINT_BLESS").is_some() {
        fs::write(&path, text).expect("a file that can be written");
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "{} differs from the text written now", path.display());
}
