//! The files of a run. Inputs are read up to a size. An output is written under a passing name beside its own, gets that
//! name when it is whole, and never takes the place of an input.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Error, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;

/// The environment variable with the size, in megabytes, up to which files are read as a whole.
pub(crate) const LIMIT: &str = "COADJOINT_MAX_MEGABYTES";
/// The size without that variable.
const MEGABYTES: u64 = 64;
/// The ending of passing names.
const PASSING: &str = ".partial";
/// Bytes that are read at a time.
const PIECE: usize = 1 << 16;

fn refused(what: String) -> Error {
    Error::new(ErrorKind::InvalidInput, what)
}

/// Opens a file that is read piece by piece.
///
/// # Errors
/// Fails if there is no such file, or it is a folder, a device or a pipe; the standard input is allowed.
pub fn open(path: &Path) -> io::Result<File> {
    let data = fs::metadata(path)?;
    let standard = ["/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"].map(Path::new);
    if data.is_dir() {
        return Err(refused("this is a folder".into()));
    }
    if !data.is_file() && !standard.contains(&path) {
        return Err(refused("this is a device or a pipe: copy its content to a file".into()));
    }
    File::open(path)
}

/// Opens a file that is read as a whole.
///
/// # Errors
/// As [`open`], and where it has more than 64 megabytes or those that an environment variable allows.
pub fn open_whole(path: &Path) -> io::Result<File> {
    let file = open(path)?;
    check_size(file.metadata()?.len(), limit()?)?;
    Ok(file)
}

/// Reads a file as a whole.
///
/// # Errors
/// As [`open_whole`].
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let limit = limit()?;
    let mut bytes = Vec::new();
    // The standard input says nothing of its size.
    open_whole(path)?.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    check_size(bytes.len() as u64, limit)?;
    Ok(bytes)
}

fn limit() -> io::Result<u64> {
    let Some(given) = std::env::var_os(LIMIT) else { return Ok(MEGABYTES * 1_000_000) };
    let number = given.to_str().and_then(|text| text.parse::<u64>().ok());
    number.map(|megabytes| megabytes.saturating_mul(1_000_000)).ok_or_else(|| {
        refused(format!("{LIMIT} is {}: give a whole number of megabytes", given.display()))
    })
}

fn check_size(length: u64, limit: u64) -> io::Result<()> {
    if length <= limit {
        return Ok(());
    }
    let most = limit / 1_000_000;
    Err(refused(format!(
        "it has more than {most} MB, the most that is read; set {LIMIT} in the environment to read more"
    )))
}

/// The checksum of bytes.
#[must_use]
pub fn crc32(bytes: &[u8]) -> u32 {
    crc32fast::hash(bytes)
}

/// A JSON object with a checksum of all that follows it as its first entry.
#[must_use]
pub fn seal(json: &str) -> String {
    let rest = json.get(1..).unwrap_or_default();
    format!("{{\"crc32\":\"{:08x}\",{rest}", crc32(rest.as_bytes()))
}

/// True for a text made by [`seal`] and not changed since.
#[must_use]
pub fn is_sealed(text: &str) -> bool {
    let parts = text.strip_prefix("{\"crc32\":\"").and_then(|text| text.split_once("\","));
    parts.is_some_and(|(sum, rest)| sum == format!("{:08x}", crc32(rest.as_bytes())))
}

/// The identity of a file, whatever links lead to it; of a name without a file, the name in its folder.
#[derive(PartialEq, Eq)]
enum Identity {
    #[cfg(unix)]
    File(u64, u64),
    Name(PathBuf),
}

impl Identity {
    fn of(path: &Path) -> Self {
        #[cfg(unix)]
        if let Ok(data) = fs::metadata(path) {
            return Self::data(&data);
        }
        let inside = || Some(fs::canonicalize(folder(path)).ok()?.join(path.file_name()?));
        Self::Name(fs::canonicalize(path).ok().or_else(inside).unwrap_or_else(|| path.to_owned()))
    }

    #[cfg(unix)]
    fn data(data: &fs::Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self::File(data.dev(), data.ino())
    }
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// `path` with `ending` added to its name.
#[must_use]
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// The name under which a file is written until it is whole: that of the file itself, not of a link to it.
#[must_use]
pub fn passing(path: &Path) -> PathBuf {
    beside(&resolved(path), PASSING)
}

fn resolved(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// A device or a pipe, which is written as it is.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir())
}

/// Refuses a name that no output may have.
///
/// # Errors
/// [`ErrorKind::InvalidInput`] where it is a folder or lies in one that is not there, or where it or its passing name is
/// one of `others` (the inputs of the run, its other outputs), through whatever links;
/// [`ErrorKind::PermissionDenied`] where the file is read-only.
pub fn check(path: &Path, others: &[&Path]) -> io::Result<()> {
    if path.is_dir() {
        return Err(refused("this is a folder: give the name of a file".into()));
    }
    if !folder(path).is_dir() {
        return Err(refused(format!(
            "there is no folder {}: make it first",
            folder(path).display()
        )));
    }
    if is_special(path) {
        return Ok(());
    }
    let own = [path.to_owned(), passing(path)].map(|path| Identity::of(&path));
    if let Some(other) = others.iter().find(|other| own.contains(&Identity::of(other))) {
        return Err(refused(format!(
            "{} is the same file, which this run uses: give another name",
            other.display()
        )));
    }
    match fs::metadata(path) {
        Ok(data) if data.permissions().readonly() => {
            Err(Error::new(ErrorKind::PermissionDenied, "the file is read-only"))
        }
        _ => Ok(()),
    }
}

/// Writes a file: all of it, or nothing.
///
/// # Errors
/// As [`check`], and where it cannot be written; what was there before is then as it was.
pub fn write(path: &Path, inputs: &[&Path], bytes: &[u8]) -> io::Result<()> {
    let mut output = Output::open(path, inputs)?;
    let written = output.begin(&[]).and_then(|()| output.append(bytes));
    let written = written.and_then(|()| output.publish());
    if written.is_err() {
        output.discard();
    }
    written
}

/// The length of the known part of a file, and its checksum without a head that may change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    /// Bytes.
    pub bytes: u64,
    /// CRC-32.
    pub crc32: u32,
}

/// The extent of a whole file.
///
/// # Errors
/// Fails if the file cannot be read.
pub fn extent(path: &Path) -> io::Result<Extent> {
    let file = open(path)?;
    let bytes = file.metadata()?.len();
    Ok(Extent { bytes, crc32: checksum(&file, bytes)?.finalize() })
}

/// The checksum of the next bytes, that many.
fn checksum(mut file: &File, bytes: u64) -> io::Result<Hasher> {
    let mut hasher = Hasher::new();
    let mut piece = vec![0; PIECE];
    let mut left = bytes;
    while left > 0 {
        let take = left.min(PIECE as u64) as usize;
        file.read_exact(&mut piece[..take])?;
        hasher.update(&piece[..take]);
        left -= take as u64;
    }
    Ok(hasher)
}

/// A file that is written under its passing name, or a device. As long as this lives no other process writes it, where
/// the file system has locks.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    passing: PathBuf,
    file: File,
    special: bool,
    /// Bytes at the beginning that are written anew as the file grows.
    head: u64,
    bytes: u64,
    hasher: Hasher,
    /// True once [`Output::begin`] or [`Output::resume`] was called.
    begun: bool,
}

impl Output {
    /// Opens the passing file of `path`, made where there is none, whose content stays as it is for now.
    ///
    /// # Errors
    /// As [`check`], where it cannot be written, or [`ErrorKind::ResourceBusy`] where another process writes it.
    pub fn open(path: &Path, inputs: &[&Path]) -> io::Result<Self> {
        Self::open_as(path, &passing(path), inputs)
    }

    /// As [`Output::open`], with another passing name on the same file system.
    pub fn open_as(path: &Path, passing: &Path, inputs: &[&Path]) -> io::Result<Self> {
        check(path, inputs)?;
        let special = is_special(path);
        let passing = if special { path } else { passing };
        let file = loop {
            let mut options = OpenOptions::new();
            let file = options.read(!special).write(true).create(!special).open(passing)?;
            if special {
                break file;
            }
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => {
                    return Err(Error::new(
                        ErrorKind::ResourceBusy,
                        "another process is writing it: let that end, or give another name",
                    ));
                }
                // Some file systems have no locks; then nothing keeps others out.
                Err(TryLockError::Error(_)) | Ok(()) => {}
            }
            // The one who held the lock may have given the file its own name.
            #[cfg(unix)]
            if Identity::data(&file.metadata()?) != Identity::of(passing) {
                continue;
            }
            break file;
        };
        let (path, passing) = (resolved(path), passing.to_owned());
        let (head, bytes, hasher, begun) = (0, 0, Hasher::new(), false);
        Ok(Self { path, passing, file, special, head, bytes, hasher, begun })
    }

    /// True if there was no passing file, or an empty one.
    #[must_use]
    pub fn is_fresh(&self) -> bool {
        !self.begun && self.file.metadata().is_ok_and(|data| data.len() == 0)
    }

    /// Begins anew with `head`, bytes that may be written again by [`Output::set_head`].
    ///
    /// # Errors
    /// Fails if the file cannot be written.
    pub fn begin(&mut self, head: &[u8]) -> io::Result<()> {
        self.begun = true;
        if !self.special {
            self.file.set_len(0)?;
            self.file.seek(SeekFrom::Start(0))?;
        }
        (self.head, self.bytes, self.hasher) = (0, 0, Hasher::new());
        self.append(head)?;
        (self.head, self.hasher) = (self.bytes, Hasher::new());
        Ok(())
    }

    /// Goes on behind the first bytes, which must be those that were written; what follows them is cut off. A head of
    /// `head` bytes is not looked at.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidData`] where they are not, else where it cannot be read or written.
    pub fn resume(&mut self, extent: Extent, head: u64) -> io::Result<()> {
        let wrong = |what: String| Err(Error::new(ErrorKind::InvalidData, what));
        let found = self.file.metadata()?.len();
        if found < extent.bytes {
            return wrong(format!("it has {found} bytes where {} were written", extent.bytes));
        }
        self.file.seek(SeekFrom::Start(head))?;
        let hasher = checksum(&self.file, extent.bytes.saturating_sub(head))?;
        if hasher.clone().finalize() != extent.crc32 {
            return wrong("it is damaged: its checksum is not that of what was written".into());
        }
        self.begun = true;
        self.file.set_len(extent.bytes)?;
        self.file.seek(SeekFrom::End(0))?;
        (self.head, self.bytes, self.hasher) = (head, extent.bytes, hasher);
        Ok(())
    }

    /// Writes at the end: all of the bytes, or none of them.
    ///
    /// # Errors
    /// Fails if the file cannot be written.
    pub fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let written = self.file.write_all(bytes);
        if written.is_ok() {
            self.hasher.update(bytes);
            self.bytes += bytes.len() as u64;
        } else if !self.special {
            // The failure itself is what is reported.
            let _ = self.file.set_len(self.bytes);
            let _ = self.file.seek(SeekFrom::Start(self.bytes));
        }
        written
    }

    /// Writes the head again.
    ///
    /// # Errors
    /// Fails if the file cannot be written, or if the length of the head changes.
    pub fn set_head(&mut self, head: &[u8]) -> io::Result<()> {
        if head.len() as u64 != self.head {
            return Err(refused(format!("a head of {} bytes", head.len())));
        }
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(head)?;
        self.file.seek(SeekFrom::End(0)).map(|_| ())
    }

    /// The extent written so far.
    #[must_use]
    pub fn extent(&self) -> Extent {
        Extent { bytes: self.bytes, crc32: self.hasher.clone().finalize() }
    }

    /// Waits until everything is on the disk.
    ///
    /// # Errors
    /// Fails if the file cannot be written.
    pub fn sync(&self) -> io::Result<()> {
        if self.special { Ok(()) } else { self.file.sync_data() }
    }

    /// Gives the file its name, in one moment, with the permissions of the one that it replaces. The lock is held until this
    /// is dropped.
    ///
    /// # Errors
    /// Fails if the file cannot be written or renamed.
    pub fn publish(&mut self) -> io::Result<()> {
        if self.special {
            return Ok(());
        }
        if let Ok(before) = fs::metadata(&self.path) {
            self.file.set_permissions(before.permissions())?;
        }
        self.sync()?;
        fs::rename(&self.passing, &self.path)?;
        // The folder holds the name.
        if let Ok(folder) = File::open(folder(&self.path)) {
            let _ = folder.sync_all();
        }
        Ok(())
    }

    /// Removes the passing file.
    pub fn discard(&self) {
        #[cfg(unix)]
        let own = self
            .file
            .metadata()
            .is_ok_and(|data| Identity::data(&data) == Identity::of(&self.passing));
        #[cfg(not(unix))]
        let own = true;
        if !self.special && own {
            let _ = fs::remove_file(&self.passing);
        }
    }
}

/// One that nothing was asked of leaves no empty file.
impl Drop for Output {
    fn drop(&mut self) {
        if self.is_fresh() {
            self.discard();
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.append(bytes).map(|()| bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
