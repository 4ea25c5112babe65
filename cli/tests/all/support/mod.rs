//! Running the binary.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

pub mod page;

use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use serde_json::Value;
use tempfile::TempDir;

/// The command, run at the root of the workspace.
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

/// A folder of its own for a test.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The whole name of a file.
    pub fn name(&self, name: &str) -> String {
        self.at(name).to_str().unwrap().to_owned()
    }

    /// Writes a file; its whole name.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> String {
        std::fs::write(self.at(name), bytes).unwrap();
        self.name(name)
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.at(name)).unwrap()
    }

    pub fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.at(name)).unwrap()
    }

    /// The command with these arguments, between blanks, in this folder.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
        command.current_dir(self.path()).args(arguments.split(' '));
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub fn run(&self, arguments: &str) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Pairs of phase points of a quadratic generating function on SO(3), to learn from.
    pub fn pairs(&self, name: &str, count: usize, seed: u64) -> String {
        let wide = MomentumBox { low: -2.0, high: 2.0 };
        let pairs = phase_pairs(&SO3::new(), &Quadratic::paper(), 0.1, wide, count, seed);
        write_pairs(&self.at(name), &SO3::new(), &pairs).unwrap();
        self.name(name)
    }
}

/// The standard error of a process.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A system file in a folder of its own, which is there as long as the folder lives.
pub fn system(text: &str) -> (Folder, String) {
    let folder = Folder::new();
    let name = folder.write("system.toml", text);
    (folder, name)
}

/// The numbers of a JSON array.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}
