//! The note that `--keep` leaves beside the file of a finished run: it says what the file is.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::journal::{ANEW, Journal};
use crate::error::CliError;
use crate::note;

/// A finished run, for the same command started again and for whatever joins shards.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Finished {
    /// The first row of the input that it has, from 1.
    pub first_row: u64,
    /// SHA-256 of the file.
    pub sha256: String,
    /// SHA-256 of the list of rejected rows, where there is one.
    pub rejected_sha256: Option<String>,
    /// The run and its findings.
    pub journal: Journal,
}

impl Finished {
    /// Describes files that have their names already.
    pub fn of(out: &Path, list: &Path, first_row: u64, journal: Journal) -> Result<Self, CliError> {
        let rejected_sha256 = if journal.rejected > 0 { Some(sha256(list)?) } else { None };
        Ok(Self { first_row, sha256: sha256(out)?, rejected_sha256, journal })
    }

    /// The note at `path`; `None` where there is none.
    pub fn read(path: &Path) -> Result<Option<Self>, CliError> {
        note::read(path, "note", ANEW)
    }

    /// Writes the note: all of it or nothing.
    pub fn write(&self, path: &Path, inputs: &[&Path]) -> Result<(), CliError> {
        note::write(self, path, inputs)
    }

    /// Whether the files are those that it describes.
    pub fn is_whole(&self, out: &Path, list: &Path) -> Result<bool, CliError> {
        let same = |path: &Path, known: &str| -> Result<bool, CliError> {
            Ok(path.exists() && sha256(path)? == known)
        };
        let list_is = self.rejected_sha256.as_ref().map_or(Ok(true), |known| same(list, known))?;
        Ok(list_is && same(out, &self.sha256)?)
    }
}

/// SHA-256 of a file, in hexadecimal digits.
fn sha256(path: &Path) -> Result<String, CliError> {
    let hash = || -> std::io::Result<String> {
        let mut file = File::open(path)?;
        let mut hash = Sha256::new();
        let mut piece = vec![0; 1 << 20];
        loop {
            match file.read(&mut piece)? {
                0 => return Ok(format!("{:x}", hash.finalize())),
                read => hash.update(&piece[..read]),
            }
        }
    };
    hash().map_err(|source| CliError::Read { path: path.into(), source })
}
