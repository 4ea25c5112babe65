//! How far a run has come, on the disk.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use coadjoint_run::simulate::{Drift, Steep, Tally};
use serde::{Deserialize, Serialize};

use super::sink::{Extent, failed};
use super::target::beside;
use crate::error::CliError;

/// The state of a run. Records that it counts are on the disk before it is. Numbers are kept as bits.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Checkpoint {
    /// What the run is; a run that goes on must agree in every entry.
    pub identity: BTreeMap<String, String>,
    /// Steps made.
    pub step: u64,
    /// μ.
    pub momentum: Vec<u64>,
    /// The entries of the blocks of g, row by row.
    pub element: Vec<u64>,
    /// The numbers that make g where steps are programs, which are other than its matrix.
    #[serde(default)]
    pub own: Option<Vec<u64>>,
    /// The largest drifts of the spatial momentum, the Casimirs and the energy; NaN for those that are not known.
    pub drift: [u64; 3],
    /// From these times on they cannot be measured.
    #[serde(default)]
    pub unmeasured: [Option<u64>; 3],
    /// The most iterations of a step.
    pub iterations: u64,
    /// The largest residual.
    pub residual: Option<u64>,
    /// The first step of a series that hardly converges: its number, and time and ratio as bits.
    pub steep: Option<[u64; 3]>,
    /// Bytes of the file of records.
    pub bytes: u64,
    /// Records in it.
    pub rows: u64,
    /// Times of `--at` recorded.
    pub times: usize,
    /// The moments kept for pictures.
    pub samples: Vec<Vec<u64>>,
    /// Whether the run has finished.
    pub complete: bool,
}

impl Checkpoint {
    /// The checkpoint at `path`, if there is one, which must be of this run.
    ///
    /// # Errors
    /// Where it cannot be read, or is of another run: by the name of what differs.
    pub fn read(
        path: &Path,
        identity: &BTreeMap<String, String>,
    ) -> Result<Option<Self>, CliError> {
        let text = match fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(CliError::Read { path: path.into(), source }),
        };
        let found: Self = serde_json::from_str(&text).map_err(|error| {
            CliError::Option(format!(
                "{} is no checkpoint of this version ({error}): remove it to begin anew",
                path.display()
            ))
        })?;
        for key in found.identity.keys().chain(identity.keys()) {
            let [was, is] =
                [&found.identity, identity].map(|i| i.get(key).map_or("not given", String::as_str));
            if was != is {
                return Err(CliError::Option(format!(
                    "{} is of a run with another `{key}`: {was} then, {is} now; give the same \
                     command as then, or another --checkpoint",
                    path.display()
                )));
            }
        }
        Ok(Some(found))
    }

    /// Writes it: the old checkpoint is there or the new one, never a piece.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), CliError> {
        let text = serde_json::to_string(self).map_err(|error| failed(path, &error))?;
        replace(path, &text)
    }

    /// The maxima and sums.
    pub fn tally(&self) -> Tally {
        Tally {
            drift: Drift::of_numbers(self.drift.map(f64::from_bits)),
            unmeasured: self.unmeasured.map(|time| time.map(f64::from_bits)),
            iterations: self.iterations,
            residual: self.residual.map(f64::from_bits),
            steep: self.steep.map(|[step, time, ratio]| Steep {
                step,
                time: f64::from_bits(time),
                ratio: f64::from_bits(ratio),
            }),
        }
    }

    /// Takes over the maxima and sums.
    pub fn set_tally(&mut self, tally: &Tally) {
        self.drift = tally.drift.numbers().map(f64::to_bits);
        self.unmeasured = tally.unmeasured.map(|time| time.map(f64::to_bits));
        self.iterations = tally.iterations;
        self.residual = tally.residual.map(f64::to_bits);
        self.steep = tally.steep.map(|s| [s.step, s.time.to_bits(), s.ratio.to_bits()]);
    }

    /// How much of the file of records is vouched for.
    pub fn extent(&self) -> Extent {
        Extent { bytes: self.bytes, rows: self.rows }
    }
}

/// Numbers as bits.
pub fn bits(values: impl Iterator<Item = f64>) -> Vec<u64> {
    values.map(f64::to_bits).collect()
}

/// Numbers of bits.
pub fn numbers(bits: &[u64]) -> Vec<f64> {
    bits.iter().copied().map(f64::from_bits).collect()
}

/// Puts a text in place of a file, which is never there in pieces.
///
/// # Errors
/// Where it cannot be written.
pub fn replace(path: &Path, text: &str) -> Result<(), CliError> {
    let next: PathBuf = beside(path, ".next");
    let write = || -> std::io::Result<()> {
        let mut file = File::create(&next)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()
    };
    write().map_err(|error| failed(&next, &error))?;
    rename(&next, path)
}

/// Renames, and writes the folder that holds the name.
///
/// # Errors
/// Where it cannot be renamed.
pub fn rename(from: &Path, to: &Path) -> Result<(), CliError> {
    fs::rename(from, to).map_err(|error| failed(to, &error))?;
    let folder = to.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}
