//! Writing end states: appended to a file of its own, which takes the real name when it is whole.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use coadjoint_learn::npy_header;

use super::table::{Piece, Table};
use crate::error::CliError;
use coadjoint_run::ensemble::Layout;

/// Rows turned into text at a time.
const PIECE: usize = 256;

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
    pub fn header(self, layout: &Layout, table: Option<&Table>, count: u64) -> Vec<u8> {
        match self {
            Self::Csv => {
                let names = table.map_or_else(|| layout.names(), |table| table.header.clone());
                let mut line = Vec::new();
                for (column, name) in names.iter().enumerate() {
                    if column > 0 {
                        line.push(b',');
                    }
                    push_cell(&mut line, name.as_bytes());
                }
                line.push(b'\n');
                line
            }
            Self::Npy => npy_header(&[count, layout.width() as u64]),
            #[cfg(feature = "parquet")]
            Self::Parquet => Vec::new(),
        }
    }

    /// The bytes of the rows; in CSV, in the order of the `table`'s columns.
    pub fn encode(self, layout: &Layout, table: Option<&Table>, read: &Piece) -> Vec<u8> {
        if self != Self::Csv {
            return read.rows.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        }
        let width = layout.width();
        // Pieces of fixed size, joined in order: the same bytes whatever the threads.
        let own: Vec<Option<usize>> =
            table.map_or_else(|| (0..width).map(Some).collect(), |table| table.own.clone());
        let pieces =
            read.rows.values.par_chunks(PIECE * width).enumerate().map(|(number, piece)| {
                let mut text = Vec::with_capacity(piece.len() * 20);
                for (place, row) in piece.chunks(width).enumerate() {
                    let mut others = read.others.get(number * PIECE + place).into_iter().flatten();
                    for (cell, own) in own.iter().enumerate() {
                        if cell > 0 {
                            text.push(b',');
                        }
                        match own {
                            // Writing into memory cannot fail.
                            Some(column) => drop(write!(text, "{}", row[*column])),
                            None => push_cell(&mut text, others.next().unwrap_or_default()),
                        }
                    }
                    text.push(b'\n');
                }
                text
            });
        pieces.collect::<Vec<_>>().concat()
    }
}

/// Adds a cell, in quotes where it would be read as something else without.
fn push_cell(text: &mut Vec<u8>, cell: &[u8]) {
    if !cell.iter().any(|byte| matches!(byte, b',' | b'"' | b'\r' | b'\n' | b'#')) {
        return text.extend(cell);
    }
    text.push(b'"');
    for &byte in cell {
        if byte == b'"' {
            text.push(b'"');
        }
        text.push(byte);
    }
    text.push(b'"');
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
