//! Compiled steps kept from run to run, by their content.
//!
//! An entry is a folder named by a hash of all that the library depends on. It holds the library and a hash of it. It is
//! written beside its place and renamed, so that every entry is whole. A damaged one (a disk that failed, a file that
//! somebody changed) does not match its hash and is never loaded. The folder belongs to the user alone.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use sha2::{Digest, Sha256};

use super::options::{CacheFolder, LIBRARY};

/// A folder that only this user can write to.
#[derive(Debug)]
pub(super) struct Cache {
    folder: PathBuf,
}

const HASH: &str = "sha256";
/// Entries that are kept.
const ENTRIES: usize = 256;
/// Files left by writers that were killed are removed at this age.
const STALE: Duration = Duration::from_secs(24 * 3600);

/// The name of an entry that depends on these texts.
pub(super) fn key(texts: &[&str]) -> String {
    let mut hasher = Sha256::new();
    for text in texts {
        hasher.update((text.len() as u64).to_le_bytes());
        hasher.update(text);
    }
    hexadecimal(hasher)
}

fn hexadecimal(hasher: Sha256) -> String {
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn hash(bytes: &[u8]) -> String {
    let mut hasher = Sha256::new();
    hasher.update(bytes);
    hexadecimal(hasher)
}

impl Cache {
    /// The folder, made where there is none. None where it cannot be made or is not this user's alone.
    pub(crate) fn open(choice: &CacheFolder) -> Option<Self> {
        let folder = match choice {
            CacheFolder::User => user_folder()?,
            CacheFolder::At(folder) => folder.clone(),
            CacheFolder::None => return None,
        };
        private().recursive(true).create(&folder).ok()?;
        let data = fs::symlink_metadata(&folder).ok()?;
        (data.is_dir() && is_ours(&data)).then_some(Self { folder })
    }

    /// The library of an entry that is whole and ours.
    pub(crate) fn get(&self, key: &str) -> Option<PathBuf> {
        let entry = self.folder.join(key);
        let library = entry.join(LIBRARY);
        let mark = entry.join(HASH);
        let data = fs::symlink_metadata(&entry).ok()?;
        if !(data.is_dir() && is_ours(&data)) {
            return None;
        }
        for file in [&library, &mark] {
            let data = fs::symlink_metadata(file).ok()?;
            if !(data.is_file() && is_ours(&data)) {
                return None;
            }
        }
        let expected = fs::read_to_string(&mark).ok()?;
        (hash(&fs::read(&library).ok()?) == expected).then_some(library)
    }

    /// Keeps a library and returns its place in the cache. A whole one that is already there stays, a damaged one is replaced.
    pub(crate) fn put(&self, key: &str, library: &Path) -> io::Result<PathBuf> {
        self.clean();
        let bytes = fs::read(library)?;
        let stage = tempfile::Builder::new().prefix(STAGE).tempdir_in(&self.folder)?;
        let staged = stage.path().join(key);
        private().create(&staged)?;
        write(&staged.join(LIBRARY), &bytes)?;
        write(&staged.join(HASH), hash(&bytes).as_bytes())?;
        let entry = self.folder.join(key);
        if fs::rename(&staged, &entry).is_err() {
            if let Some(library) = self.get(key) {
                return Ok(library);
            }
            fs::rename(&entry, stage.path().join("damaged"))?;
            fs::rename(&staged, &entry)?;
        }
        Ok(entry.join(LIBRARY))
    }

    /// Removes files of killed writers, and the oldest entries where there are too many. Files that cannot be removed stay.
    fn clean(&self) {
        let Ok(entries) = fs::read_dir(&self.folder) else {
            return;
        };
        let mut kept: Vec<(SystemTime, PathBuf)> = Vec::new();
        for entry in entries.flatten() {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            let made =
                entry.metadata().and_then(|data| data.modified()).unwrap_or(SystemTime::now());
            if name.starts_with(STAGE) {
                if made.elapsed().is_ok_and(|age| age > STALE) {
                    let _ = fs::remove_dir_all(entry.path());
                }
            } else if name.len() == 64 && name.bytes().all(|byte| byte.is_ascii_hexdigit()) {
                kept.push((made, entry.path()));
            }
        }
        kept.sort();
        for (_, path) in kept.iter().rev().skip(ENTRIES - 1) {
            let _ = fs::remove_dir_all(path);
        }
    }
}

const STAGE: &str = ".stage-";

/// A builder of folders for the user alone.
fn private() -> fs::DirBuilder {
    #[allow(unused_mut)]
    let mut builder = fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder
}

/// A file for the user alone, on the disk before it is renamed.
fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut options = fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Whether a file or folder belongs to this user and nobody else can write to it.
#[cfg(unix)]
fn is_ours(data: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    data.uid() == rustix::process::geteuid().as_raw() && data.mode() & 0o022 == 0
}

/// Folders of a user are the user's alone by inheritance.
#[cfg(not(unix))]
fn is_ours(_: &fs::Metadata) -> bool {
    true
}

fn user_folder() -> Option<PathBuf> {
    let variable =
        |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = |below: &str| variable("HOME").map(|home| home.join(below));
    let base = if cfg!(windows) {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        home("Library/Caches")
    } else {
        variable("XDG_CACHE_HOME").or_else(|| home(".cache"))
    };
    Some(base?.join("coadjoint").join("native"))
}
