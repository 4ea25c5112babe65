//! Finding a C compiler and having it compile.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::options::{COptions, LIBRARY};
use super::process::{Fault, Finished, run};
use crate::error::{NativeError, first_errors};

/// A C compiler that answers.
#[derive(Clone, Debug)]
pub(super) struct Compiler {
    program: OsString,
    arguments: Vec<OsString>,
    /// Its version text.
    version: String,
    limit: Duration,
    stop: Arc<AtomicBool>,
}

/// The time limit for asking the version.
const VERSION_LIMIT: Duration = Duration::from_secs(10);

impl Compiler {
    /// The compiler that was named, or that of the environment variable CC, else the first of `cc`, `gcc` and `clang`
    /// that answers.
    pub(crate) fn find(options: &COptions, folder: &Path) -> Result<Self, NativeError> {
        let named = options.compiler.as_deref();
        let environment = std::env::var_os("CC").filter(|command| !command.is_empty());
        if let Some(command) = named.map(OsStr::to_owned).or(environment) {
            return Self::ask(&command, options, folder);
        }
        let candidates = ["cc", "gcc", "clang"];
        let mut first = None;
        for candidate in candidates {
            match Self::ask(OsStr::new(candidate), options, folder) {
                Ok(compiler) => return Ok(compiler),
                Err(NativeError::Start { source, .. })
                    if source.kind() == std::io::ErrorKind::NotFound => {}
                Err(error) => {
                    first.get_or_insert(error);
                }
            }
        }
        Err(first.unwrap_or_else(|| NativeError::NoCompiler { tried: candidates.join(", ") }))
    }

    /// A command with its version. It may have arguments, as in `ccache gcc`.
    fn ask(command: &OsStr, options: &COptions, folder: &Path) -> Result<Self, NativeError> {
        let (program, arguments) = split(command);
        let (limit, stop, version) = (options.time_limit, options.stop.clone(), String::new());
        let mut compiler = Self { program, arguments, version, limit, stop };
        let mut command = compiler.command();
        command.arg("--version");
        let finished = compiler.run(command, limit.min(VERSION_LIMIT), folder)?;
        compiler.version = finished.output;
        Ok(compiler)
    }

    /// The name it was called by.
    pub(crate) fn name(&self) -> String {
        self.program.to_string_lossy().into_owned()
    }

    /// Its version text, which tells it from other compilers.
    pub(crate) fn version(&self) -> &str {
        &self.version
    }

    /// The arguments it is given, but those that name files. Nothing may be contracted or reordered; long straight-line
    /// programs gain nothing from the vectoriser, and operations are in a good order already.
    pub(crate) fn flags() -> &'static [&'static str] {
        &[
            "-std=gnu99",
            "-O1",
            #[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
            "-march=native",
            #[cfg(target_arch = "aarch64")]
            "-mcpu=native",
            "-ffp-contract=off",
            "-fno-math-errno",
            "-fno-trapping-math",
            "-fno-tree-vectorize",
            "-fno-tree-slp-vectorize",
            "-fvisibility=hidden",
            #[cfg(not(windows))]
            "-fPIC",
            "-shared",
            "-w",
        ]
    }

    /// Compiles a unit in a folder of its own; the library.
    pub(crate) fn compile(&self, text: &str, folder: &Path) -> Result<PathBuf, NativeError> {
        let (unit, library) = (folder.join("step.c"), folder.join(LIBRARY));
        std::fs::write(&unit, text)
            .map_err(|source| NativeError::Write { path: unit.clone(), source })?;
        let mut command = self.command();
        command.args(Self::flags()).arg("-o").arg(&library).arg(&unit).arg("-lm");
        // The compiler's own temporary files go with the folder, whatever happens.
        for variable in ["TMPDIR", "TMP", "TEMP"] {
            command.env(variable, folder);
        }
        self.run(command, self.limit, folder)?;
        let written =
            std::fs::metadata(&library).is_ok_and(|data| data.is_file() && data.len() > 0);
        match written {
            true => Ok(library),
            false => Err(NativeError::NoLibrary { compiler: self.name() }),
        }
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.args(&self.arguments).env("LC_ALL", "C");
        command
    }

    fn run(
        &self,
        mut command: Command,
        limit: Duration,
        folder: &Path,
    ) -> Result<Finished, NativeError> {
        let compiler = self.name();
        let finished =
            run(&mut command, limit, &self.stop, folder).map_err(|fault| match fault {
                Fault::Start(source) => NativeError::Start { compiler: compiler.clone(), source },
                Fault::Output(source) => NativeError::Write { path: folder.to_owned(), source },
                Fault::Stopped => NativeError::Stopped { compiler: compiler.clone() },
                Fault::TimedOut => NativeError::TimedOut {
                    compiler: compiler.clone(),
                    seconds: limit.as_secs_f64(),
                },
            })?;
        if finished.status.success() {
            return Ok(finished);
        }
        let message = first_errors(&format!("{}\n{}", finished.errors, finished.output));
        Err(NativeError::Failed { compiler, status: finished.status.to_string(), message })
    }
}

/// A command and its arguments; a file whose name has spaces is a command as it stands.
fn split(command: &OsStr) -> (OsString, Vec<OsString>) {
    let words = command.to_str().filter(|_| !Path::new(command).is_file());
    let mut words = words.into_iter().flat_map(str::split_whitespace).map(OsString::from);
    match words.next() {
        Some(program) => (program, words.collect()),
        None => (command.to_owned(), Vec::new()),
    }
}
