//! Steps compiled by the system's C compiler, in a private folder or in a store.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use coadjoint_program::print::native_unit;
use coadjoint_program::{Kernel, Trajectories};
use tempfile::TempDir;

use crate::entry::Entry;
use crate::error::{NativeError, first_errors};
use crate::library::load;
use crate::store::{Store, key};

/// A step as machine code, and its origin.
#[derive(Clone, Debug)]
pub struct Native {
    /// The step.
    pub entry: Entry,
    /// The command of the compiler.
    pub compiler: String,
    /// The time until it was ready.
    pub ready: Duration,
}

impl Native {
    /// The step of a kernel, compiled by a C compiler with the machine's own instructions, or as the store has it; the bits are those
    /// of the interpreter.
    ///
    /// # Errors
    /// [`NativeError`] where there is no compiler, it fails, is stopped or does not end in time, no temporary file can be written, or
    /// the library cannot be loaded.
    pub fn by_c(kernel: &Kernel, options: &COptions) -> Result<Self, NativeError> {
        let start = Instant::now();
        let text = native_unit(kernel, options.trajectories);
        if let Some(kept) = Self::find(kernel, options, &text, start) {
            return Ok(kept);
        }
        let room = options.store.as_ref().and_then(|store| Some((store, store.room()?)));
        let (store, folder) = match room {
            Some((store, folder)) => (Some(store), folder),
            None => (None, private_folder()?),
        };
        let compiler = Compiler::find(options, folder.path())?;
        let library = compiler.compile(&text, folder.path())?;
        let entry = load(kernel, options.trajectories, &library)?;
        match (store, compiler.key(&text)) {
            // A loaded library can be moved, except on Windows, where there is no store.
            (Some(store), Some(key)) => store.keep(folder, LIBRARY, &key),
            _ if cfg!(windows) => drop(folder.keep()),
            _ => {}
        }
        Ok(Self { entry, compiler: compiler.name(), ready: start.elapsed() })
    }

    /// The step of a kernel if the store has it.
    pub fn kept(kernel: &Kernel, options: &COptions) -> Option<Self> {
        let start = Instant::now();
        options.store.as_ref()?;
        Self::find(kernel, options, &native_unit(kernel, options.trajectories), start)
    }

    /// The step with this text, if the store has it. A library that cannot be loaded is removed from there.
    fn find(kernel: &Kernel, options: &COptions, text: &str, start: Instant) -> Option<Self> {
        let store = options.store.as_ref()?;
        let compilers = Compiler::candidates(options).into_iter();
        let keyed = |compiler: Compiler| Some((compiler.key(text)?, compiler));
        let (key, compiler) = compilers.filter_map(keyed).next()?;
        let place = store.find(&key)?;
        match load(kernel, options.trajectories, &place.join(LIBRARY)) {
            Ok(entry) => Some(Self { entry, compiler: compiler.name(), ready: start.elapsed() }),
            Err(_) => {
                store.remove(&key);
                None
            }
        }
    }
}

/// A folder for this user alone, removed when it is dropped.
fn private_folder() -> Result<TempDir, NativeError> {
    tempfile::Builder::new()
        .prefix("coadjoint-")
        .tempdir()
        .map_err(|source| NativeError::Write { path: std::env::temp_dir(), source })
}

/// A C compiler that answers.
#[derive(Clone, Debug)]
struct Compiler {
    program: OsString,
    arguments: Vec<OsString>,
    limit: Duration,
    stop: Arc<AtomicBool>,
}

/// The time limit for asking the version.
const VERSION_LIMIT: Duration = Duration::from_secs(10);

impl Compiler {
    /// The compiler that was named, or that of the environment variable CC, else `cc`, `gcc` and `clang`.
    fn candidates(options: &COptions) -> Vec<Self> {
        let named = options.compiler.clone();
        let environment = || std::env::var_os("CC").filter(|command| !command.is_empty());
        let commands = match named.or_else(environment) {
            Some(command) => vec![command],
            None => ["cc", "gcc", "clang"].map(OsString::from).to_vec(),
        };
        let compiler = |command: OsString| {
            let (program, arguments) = split(&command);
            let (limit, stop) = (options.time_limit, options.stop.clone());
            Self { program, arguments, limit, stop }
        };
        commands.into_iter().map(compiler).collect()
    }

    /// The first of the candidates that answers.
    fn find(options: &COptions, folder: &Path) -> Result<Self, NativeError> {
        let candidates = Self::candidates(options);
        let tried = || candidates.iter().map(Self::name).collect::<Vec<_>>().join(", ");
        let (mut first, several) = (None, candidates.len() > 1);
        for compiler in &candidates {
            match compiler.ask(folder) {
                Ok(()) => return Ok(compiler.clone()),
                Err(NativeError::Start { source, .. })
                    if several && source.kind() == std::io::ErrorKind::NotFound => {}
                Err(error) => {
                    first.get_or_insert(error);
                }
            }
        }
        Err(first.unwrap_or_else(|| NativeError::NoCompiler { tried: tried() }))
    }

    /// Asks for the version. A command may have arguments, as in `ccache gcc`.
    fn ask(&self, folder: &Path) -> Result<(), NativeError> {
        let mut command = self.command();
        command.arg("--version");
        self.run(command, self.limit.min(VERSION_LIMIT), folder)
    }

    /// The key of what this compiler makes of a text.
    fn key(&self, text: &str) -> Option<String> {
        key(&self.program, &self.arguments, Self::flags(), text)
    }

    /// The name it was called by.
    fn name(&self) -> String {
        self.program.to_string_lossy().into_owned()
    }

    /// The arguments it is given, but those that name files. Nothing may be contracted or reordered; long straight-line
    /// programs gain nothing from the vectoriser, and operations are in a good order already.
    fn flags() -> &'static [&'static str] {
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
    fn compile(&self, text: &str, folder: &Path) -> Result<PathBuf, NativeError> {
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

    /// Runs a command until it ends, the time limit passes or it is to stop. Neither it nor its children outlive this
    /// process. Its outputs go through files in `folder`: a pipe would stay open as long as anything that the command
    /// started.
    fn run(&self, mut command: Command, limit: Duration, folder: &Path) -> Result<(), NativeError> {
        let started = |source| NativeError::Start { compiler: self.name(), source };
        let kept = |source| NativeError::Write { path: folder.to_owned(), source };
        let (output, errors) = (folder.join("output"), folder.join("errors"));
        let create = |path: &Path| File::create(path).map_err(kept);
        command.stdin(Stdio::null()).stdout(create(&output)?).stderr(create(&errors)?);
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn().map_err(started)?;
        let watcher = Watcher::new(child.id());
        let status = self.wait(&mut child, limit);
        drop(watcher);
        let status = status?;
        if status.success() {
            return Ok(());
        }
        let mut log = String::new();
        for path in [errors, output] {
            let bytes = std::fs::read(path).map_err(kept)?;
            log += &String::from_utf8_lossy(&bytes);
            log.push('\n');
        }
        let (status, message) = (status.to_string(), first_errors(&log));
        Err(NativeError::Failed { compiler: self.name(), status, message })
    }

    /// Waits for a command. Past the time limit, or on request, it is killed with the processes it started.
    fn wait(&self, child: &mut Child, limit: Duration) -> Result<ExitStatus, NativeError> {
        let compiler = self.name();
        let start = Instant::now();
        let mut pause = Duration::from_micros(500);
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return Ok(status),
                Ok(None) => {}
                Err(source) => return Err(NativeError::Start { compiler, source }),
            }
            let left = limit.saturating_sub(start.elapsed());
            if self.stop.load(Ordering::Relaxed) {
                end(child);
                return Err(NativeError::Stopped { compiler });
            }
            if left.is_zero() {
                end(child);
                return Err(NativeError::TimedOut { compiler, seconds: limit.as_secs_f64() });
            }
            std::thread::sleep(pause.min(left));
            pause = (pause * 3 / 2).min(Duration::from_millis(5));
        }
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

/// A shell that ends a group of processes when this process ends, in whatever way: its input is closed then.
struct Watcher(Child);

impl Watcher {
    /// The watcher of the group that this process leads; `None` where there are no groups or no shell.
    fn new(leader: u32) -> Option<Self> {
        if !cfg!(unix) {
            return None;
        }
        let mut command = Command::new("sh");
        command.args(["-c", "read _; kill -KILL \"-$1\"", "sh", &leader.to_string()]);
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
        // Signals that a terminal sends to this process must not end the watcher.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        command.spawn().ok().map(Self)
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Ends a command and, where there are process groups, all that it started.
fn end(child: &mut Child) {
    #[cfg(unix)]
    if let Some(group) = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw) {
        // The group may be gone already, which is as well.
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
    let _ = child.kill();
    let _ = child.wait();
}

/// The name of the library that a compiler writes.
const LIBRARY: &str = if cfg!(windows) { "step.dll" } else { "step.so" };

/// Options of compiling a step with a C compiler.
#[derive(Clone, Debug)]
pub struct COptions {
    /// The compiler's command; without one that of the environment variable CC, else the first of `cc`, `gcc` and
    /// `clang` that answers.
    pub compiler: Option<OsString>,
    /// The time it may take.
    pub time_limit: Duration,
    /// The trajectories compiled for: either half takes about half the time.
    pub trajectories: Trajectories,
    /// The store in which steps are kept and looked for; none if they are compiled anew.
    pub store: Option<Store>,
    /// Set it from another thread to end the compiler and all that it has started.
    pub stop: Arc<AtomicBool>,
}

impl Default for COptions {
    fn default() -> Self {
        Self {
            compiler: None,
            time_limit: Duration::from_secs(120),
            trajectories: Trajectories::Both,
            store: None,
            stop: Arc::default(),
        }
    }
}
