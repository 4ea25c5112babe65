//! Running the binary.

use std::path::{Path, PathBuf};

pub mod page;

use assert_cmd::Command;
use serde_json::Value;

/// The binary, run at the root of the workspace.
pub fn coadjoint() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
    command.current_dir(root());
    command
}

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Exit code, standard output, standard error.
pub fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = coadjoint().args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The JSON that a successful run prints.
pub fn json(arguments: &[&str]) -> Value {
    let (code, out, err) = run(arguments);
    assert_eq!(code, 0, "{err}");
    serde_json::from_str(&out).unwrap()
}

/// Writes a system file into a directory of its own.
pub fn file(directory: &tempfile::TempDir, text: &str) -> String {
    let path = directory.path().join("system.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The numbers of a JSON array.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}
