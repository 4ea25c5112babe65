//! How far a run has come, on the disk.

use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::file::{self, Extent};
use coadjoint_run::simulate::{Drift, Steep, Tally};
use serde::{Deserialize, Serialize};

use crate::error::{CliError, unread, unwritten};

/// The state of a run. Records that it counts are on the disk before it is. Numbers are kept as bits.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Checkpoint {
    /// The settings of the run; a run that resumes must agree in every entry.
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
    /// The checksum of these.
    pub records_crc32: u32,
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
    /// Where it cannot be read, is damaged, or is of another run: by the name of what differs.
    pub fn read(
        path: &Path,
        identity: &BTreeMap<String, String>,
    ) -> Result<Option<Self>, CliError> {
        let text = match read_text(path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(unread(path)(error)),
        };
        let refuse = |what: &dyn std::fmt::Display| {
            CliError::Option(format!(
                "{} is damaged, or is no checkpoint of this version ({what}): remove it to begin anew",
                path.display()
            ))
        };
        if !file::is_sealed(&text) {
            return Err(refuse(&"its checksum is not that of its content"));
        }
        let found: Self = serde_json::from_str(&text).map_err(|error| refuse(&error))?;
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
    pub fn write(&self, path: &Path, inputs: &[&Path]) -> Result<(), CliError> {
        let text = serde_json::to_string(self).map_err(Error::other);
        let written = text.and_then(|text| file::write(path, inputs, file::seal(&text).as_bytes()));
        written.map_err(unwritten(path))
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

    /// The part of the file of records that the checksum covers, and the number of records in it.
    pub fn extent(&self) -> (Extent, u64) {
        (Extent { bytes: self.bytes, crc32: self.records_crc32 }, self.rows)
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
