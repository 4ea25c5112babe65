//! Compiled steps kept on disk, for later processes of the same user.
//!
//! A step has a folder of its own: the library, and beside it its key, the whole text that was compiled after the compiler, its flags and
//! the processor. A key that differs in anything belongs to another step. A folder is made under another name and renamed once it
//! is whole, so that processes at work side by side never see half of one.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use tempfile::TempDir;

/// The environment variable with the folder of the store; `off` turns it off.
const VARIABLE: &str = "COADJOINT_CACHE";

/// The most bytes that steps may take together, of which the oldest ones are removed first.
const MOST: u64 = 64 << 20;

/// The age from which a folder that no process has finished is removed.
const ABANDONED: Duration = Duration::from_secs(3600);

/// The beginning of the names of folders that are not whole yet.
const NEW: &str = "new-";

/// The file with the key, beside the library.
const KEY: &str = "key";

/// A folder of compiled steps, for this user alone.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
    most: u64,
}

impl Store {
    /// The store of this user: the folder that the environment variable `COADJOINT_CACHE` names, else `coadjoint` in
    /// `$XDG_CACHE_HOME` or `~/.cache`. `None` where the variable is `off`, where there is no such folder, where others can write to it, and
    /// where the processor does not tell what it is.
    pub fn of_user() -> Option<Self> {
        let folder = match std::env::var_os(VARIABLE) {
            Some(named) if named == "off" || named.is_empty() => return None,
            Some(named) => PathBuf::from(named),
            None => {
                let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
                let of_home = || set("HOME").map(|home| Path::new(&home).join(".cache"));
                set("XDG_CACHE_HOME").map(PathBuf::from).or_else(of_home)?.join("coadjoint")
            }
        };
        Self::new(folder, MOST)
    }

    /// A store in this folder of at most this many bytes; `None` as for [`Store::of_user`].
    pub fn new(folder: PathBuf, most: u64) -> Option<Self> {
        processor()?;
        (folder.is_absolute() && own_folder(&folder)?).then_some(Self { folder, most })
    }

    /// The folder of the step with this key.
    fn place(&self, key: &str) -> PathBuf {
        let mut hasher = DefaultHasher::new();
        key.hash(&mut hasher);
        self.folder.join(format!("{:016x}", hasher.finish()))
    }

    /// The folder of the step with this key, if there is one. It counts as used from now on.
    pub(crate) fn find(&self, key: &str) -> Option<PathBuf> {
        let place = self.place(key);
        let found = fs::read(place.join(KEY)).ok()?;
        if found != key.as_bytes() {
            return None;
        }
        // A store that cannot be written any more still serves.
        let file = File::options().append(true).open(place.join(KEY));
        let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
        Some(place)
    }

    /// Removes the step with this key.
    pub(crate) fn remove(&self, key: &str) {
        let _ = fs::remove_dir_all(self.place(key));
    }

    /// A folder in which a step can be made for [`keep`](Self::keep).
    pub(crate) fn room(&self) -> Option<TempDir> {
        tempfile::Builder::new().prefix(NEW).tempdir_in(&self.folder).ok()
    }

    /// Keeps the step of this key, whose library is in a folder made by [`room`](Self::room), unless another process has kept it; then
    /// removes the oldest steps. A step that cannot be kept is lost.
    pub(crate) fn keep(&self, folder: TempDir, library: &str, key: &str) {
        // Once renamed, both files are whole whatever happens to the machine.
        let write = || -> io::Result<()> {
            fs::write(folder.path().join(KEY), key)?;
            File::open(folder.path().join(KEY))?.sync_all()?;
            File::open(folder.path().join(library))?.sync_all()?;
            for entry in fs::read_dir(folder.path())?.flatten() {
                if entry.file_name() != KEY && entry.file_name() != library {
                    fs::remove_file(entry.path())?;
                }
            }
            fs::rename(folder.path(), self.place(key))
        };
        if write().is_ok() {
            let _ = folder.keep();
        }
        self.trim();
    }

    /// Removes what was abandoned, and the oldest steps as long as all together are too large.
    fn trim(&self) {
        let now = SystemTime::now();
        let mut steps: Vec<(SystemTime, u64, PathBuf)> = Vec::new();
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let time = |path: &Path| fs::metadata(path).and_then(|data| data.modified());
            let new = entry.file_name().to_string_lossy().starts_with(NEW);
            let changed = time(&if new { path.clone() } else { path.join(KEY) });
            let changed = changed.unwrap_or(UNIX_EPOCH);
            match new {
                true if now.duration_since(changed).is_ok_and(|age| age > ABANDONED) => {
                    let _ = fs::remove_dir_all(path);
                }
                true => {}
                false => steps.push((changed, size(&path), path)),
            }
        }
        steps.sort();
        let mut sum: u64 = steps.iter().map(|step| step.1).sum();
        for (_, size, path) in steps {
            if sum <= self.most {
                break;
            }
            let _ = fs::remove_dir_all(path);
            sum = sum.saturating_sub(size);
        }
    }
}

/// The key of a text compiled by this command with these flags on this processor; `None` where the command or the processor
/// cannot be told.
pub(crate) fn key(
    program: &OsStr,
    arguments: &[impl AsRef<OsStr>],
    flags: &[&str],
    text: &str,
) -> Option<String> {
    let path = fs::canonicalize(find_program(program)?).ok()?;
    let data = fs::metadata(&path).ok()?;
    let changed = data.modified().ok()?.duration_since(UNIX_EPOCH).ok()?.as_nanos();
    let arguments = arguments.iter().map(AsRef::as_ref).collect::<Vec<_>>();
    let (length, processor) = (data.len(), processor()?);
    Some(format!("{path:?} {length} {changed} {arguments:?} {flags:?}\n{processor}\n{text}"))
}

/// The file that a command runs.
fn find_program(program: &OsStr) -> Option<PathBuf> {
    let path = Path::new(program);
    if path.components().count() > 1 {
        return Some(path.to_owned());
    }
    let folders = std::env::var_os("PATH")?;
    std::env::split_paths(&folders).map(|folder| folder.join(path)).find(|path| path.is_file())
}

/// The model and the instructions of this processor, for which code is compiled: homes are shared between machines. `None` on systems that
/// do not have them in a file.
fn processor() -> Option<&'static str> {
    static PROCESSOR: OnceLock<Option<String>> = OnceLock::new();
    let read = || {
        const NAMES: [&str; 11] = [
            "vendor_id",
            "cpu family",
            "model",
            "model name",
            "stepping",
            "flags",
            "Features",
            "CPU implementer",
            "CPU architecture",
            "CPU variant",
            "CPU part",
        ];
        let text = fs::read_to_string("/proc/cpuinfo").ok()?;
        let first = text.split("\n\n").next()?;
        let named =
            |line: &&str| NAMES.contains(&line.split(':').next().unwrap_or_default().trim());
        let lines: Vec<&str> = first.lines().filter(named).collect();
        (!lines.is_empty()).then(|| lines.join("\n"))
    };
    PROCESSOR.get_or_init(read).as_deref()
}

/// Makes a folder, if it is not there; true if it belongs to this user and nobody else can write to it.
#[cfg(unix)]
fn own_folder(folder: &Path) -> Option<bool> {
    use std::os::unix::fs::{DirBuilderExt, MetadataExt};
    if !folder.exists() {
        fs::DirBuilder::new().recursive(true).mode(0o700).create(folder).ok()?;
    }
    let data = fs::metadata(folder).ok()?;
    let own = data.uid() == rustix::process::geteuid().as_raw();
    Some(data.is_dir() && own && data.mode() & 0o022 == 0)
}

#[cfg(not(unix))]
fn own_folder(_: &Path) -> Option<bool> {
    None
}

/// The bytes of the files in a folder.
fn size(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.metadata().ok()).map(|data| data.len()).sum()
}
