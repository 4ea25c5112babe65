//! Running the binary.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

pub(crate) mod page;

use serde_json::Value;
use tempfile::TempDir;

pub(crate) const BODY: &str = "examples/rigid_body.toml";

/// The root of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The text of a file of the workspace.
pub(crate) fn text_of(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// A command with these arguments, between blanks; an argument with blanks stands between single quotes.
fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
    command.current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.env("COADJOINT_CACHE", "off");
    for (number, part) in arguments.split('\'').enumerate() {
        match number % 2 {
            0 => command.args(part.split_whitespace()),
            _ => command.arg(part),
        };
    }
    command
}

/// Runs a command at the root of the workspace.
pub(crate) fn run(arguments: &str) -> Ran {
    Ran::of(&command(&root(), arguments).output().unwrap())
}

/// The JSON that a command prints at the root of the workspace.
pub(crate) fn json(arguments: &str) -> Value {
    run(&format!("{arguments} --format json")).json()
}

/// The outcome of a command: exit code, standard output, standard error.
#[derive(Debug)]
pub(crate) struct Ran {
    pub code: i32,
    pub out: String,
    pub error: String,
}

impl Ran {
    pub(crate) fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        let code = output.status.code().unwrap_or(-1);
        Self { code, out: text(&output.stdout), error: text(&output.stderr) }
    }

    /// It ended well.
    pub(crate) fn ok(self) -> Self {
        assert_eq!(self.code, 0, "{self:?}");
        self
    }

    /// It ended with this code, and the standard error says all of this.
    pub(crate) fn fails(self, code: i32, words: &[&str]) -> Self {
        assert_eq!(self.code, code, "{words:?}: {self:?}");
        self.says(words)
    }

    /// The standard error says all of this.
    pub(crate) fn says(self, words: &[&str]) -> Self {
        words.iter().for_each(|word| assert!(self.error.contains(word), "{word}: {self:?}"));
        self
    }

    /// The standard output says all of this.
    pub(crate) fn prints(self, words: &[&str]) -> Self {
        words.iter().for_each(|word| assert!(self.out.contains(word), "{word}: {self:?}"));
        self
    }

    /// The JSON that it printed, having ended well.
    pub(crate) fn json(self) -> Value {
        serde_json::from_str(&self.ok().out).unwrap()
    }
}

/// A folder of its own for a test, in which `examples` leads to those of the workspace.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        #[cfg(unix)]
        use std::os::unix::fs::symlink as link;
        #[cfg(windows)]
        use std::os::windows::fs::symlink_dir as link;
        link(root().join("examples").canonicalize().unwrap(), folder.path().join("examples"))
            .unwrap();
        Self(folder)
    }

    /// With the text of a system in `system.toml`.
    pub(crate) fn with(system: &str) -> Self {
        let folder = Self::new();
        folder.write("system.toml", system);
        folder
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(crate) fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.at(name), bytes).unwrap();
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.at(name)).unwrap()
    }

    pub(crate) fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.at(name)).unwrap()
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.at(name).exists()
    }

    pub(crate) fn remove(&self, name: &str) {
        std::fs::remove_file(self.at(name)).unwrap();
    }

    /// The command in this folder.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        command(self.path(), arguments)
    }

    pub(crate) fn run(&self, arguments: &str) -> Ran {
        Ran::of(&self.command(arguments).output().unwrap())
    }

    pub(crate) fn json(&self, arguments: &str) -> Value {
        self.run(&format!("{arguments} --format json")).json()
    }

    /// Commands that are bad input, each with the word that says so.
    pub(crate) fn refused(&self, cases: &[(&str, &str)]) {
        cases.iter().for_each(|(arguments, word)| drop(self.run(arguments).fails(2, &[word])));
    }

    /// The lines of a file of records without comments, cell by cell: names, then records.
    pub(crate) fn table(&self, name: &str) -> Vec<Vec<String>> {
        table(&self.text(name))
    }
}

/// The lines of a text of records without comments, cell by cell: names, then records.
pub(crate) fn table(text: &str) -> Vec<Vec<String>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The numbers of a JSON array.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The largest difference of two lists.
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
