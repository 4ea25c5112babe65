//! Writing end states: appended to a file of its own, which takes the real name when it is whole.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::layout::Layout;
use super::rows::Rows;
use crate::error::CliError;

/// The format of the file, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Names, then a line per row, in the shortest decimals that read back as the same numbers.
    Csv,
    /// One matrix of 64-bit floats.
    Npy,
    /// Columns of 64-bit floats; kept as bare numbers until all are there.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Form {
    /// By the ending of the name.
    pub fn of(path: &Path) -> Result<Self, CliError> {
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            _ => Err(CliError::Option(format!(
                "--out {}: the name must end in .csv or .npy, or in .parquet where the program \
                 was built with the feature `parquet`",
                path.display()
            ))),
        }
    }

    /// What stands before the first of `count` rows.
    pub fn header(self, layout: &Layout, count: u64) -> Vec<u8> {
        match self {
            Self::Csv => format!("{}\n", layout.names().join(",")).into_bytes(),
            Self::Npy => npy_header(count, layout.width()),
            #[cfg(feature = "parquet")]
            Self::Parquet => Vec::new(),
        }
    }

    /// The bytes of the rows.
    pub fn encode(self, layout: &Layout, rows: &Rows) -> Vec<u8> {
        if self != Self::Csv {
            return rows.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        }
        let width = layout.width();
        // Pieces of fixed size, joined in order: the same bytes whatever the threads.
        let pieces = rows.values.par_chunks(256 * width).map(|piece| {
            let mut text = Vec::with_capacity(piece.len() * 20);
            for row in piece.chunks(width) {
                for (column, value) in row.iter().enumerate() {
                    if column > 0 {
                        text.push(b',');
                    }
                    // Writing into memory cannot fail.
                    let _ = write!(text, "{value}");
                }
                text.push(b'\n');
            }
            text
        });
        pieces.collect::<Vec<_>>().concat()
    }
}

/// Version 1.0 of NumPy's format, the header padded to a multiple of 64 bytes.
fn npy_header(rows: u64, width: usize) -> Vec<u8> {
    let dictionary =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {width}), }}");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let length = (bytes.len() + 2 + dictionary.len() + 1).next_multiple_of(64) - bytes.len() - 2;
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(dictionary.bytes());
    bytes.resize(bytes.len() + length - dictionary.len() - 1, b' ');
    bytes.push(b'\n');
    bytes
}

/// A file that grows at its end.
#[derive(Debug)]
pub struct Appended {
    path: PathBuf,
    file: File,
    length: u64,
}

impl Appended {
    /// Opens or makes the file, cut to `length` bytes, and keeps other processes out of it.
    pub fn open(path: &Path, length: u64) -> Result<Self, CliError> {
        let failed = |error: std::io::Error| unwritten(path, &error);
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(CliError::Option(format!(
                    "{} is being written by another process: give each shard its own --out, and \
                     let the other one end",
                    path.display()
                )));
            }
            // Some file systems have no locks; then nothing keeps others out.
            Err(TryLockError::Error(_)) => {}
        }
        let found = file.metadata().map_err(failed)?.len();
        if found < length {
            return Err(CliError::Option(format!(
                "{} has {found} bytes where {length} were written; begin anew with --restart",
                path.display()
            )));
        }
        file.set_len(length).map_err(failed)?;
        file.seek(SeekFrom::Start(length)).map_err(failed)?;
        Ok(Self { path: path.into(), file, length })
    }

    /// Bytes so far.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Writes at the end.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), CliError> {
        self.file.write_all(bytes).map_err(|error| unwritten(&self.path, &error))?;
        self.length += bytes.len() as u64;
        Ok(())
    }

    /// Waits until everything is on the disk.
    pub fn sync(&self) -> Result<(), CliError> {
        self.file.sync_data().map_err(|error| unwritten(&self.path, &error))
    }
}

/// Gives `from` the name `to`, in one moment.
pub fn rename(from: &Path, to: &Path) -> Result<(), CliError> {
    fs::rename(from, to).map_err(|error| unwritten(to, &error))?;
    // The directory holds the name.
    let directory = to.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Ok(directory) = File::open(directory) {
        let _ = directory.sync_all();
    }
    Ok(())
}

/// `path` with `ending` added to its name.
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(ending);
    path.with_file_name(name)
}

/// A file that cannot be written.
pub fn unwritten(path: &Path, error: &dyn std::fmt::Display) -> CliError {
    CliError::Write { path: path.into(), message: error.to_string() }
}
