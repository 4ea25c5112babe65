//! How far a run has come: what a restart needs.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use coadjoint_codegen::file::{self, Extent};
use coadjoint_codegen::step;
use coadjoint_run::ensemble::{Drift, Engine};
use serde::{Deserialize, Serialize};

use crate::error::CliError;
use crate::note;
pub use crate::note::Identity;

/// The way to forget an earlier run.
pub const ANEW: &str = "begin anew with --restart";

/// The state of a run. Everything it counts is on the disk before it is.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Journal {
    /// The identity of the run.
    pub identity: Identity,
    /// Rows written.
    pub rows: u64,
    /// Bytes of the output so far.
    pub output: u64,
    /// The checksum of these.
    pub output_crc32: u32,
    /// Bytes of the list of rejected rows so far.
    pub rejected_bytes: u64,
    /// The checksum of these.
    pub rejected_crc32: u32,
    /// Rejected rows so far.
    pub rejected: u64,
    /// Where the next row begins in the input.
    pub position: u64,
    /// The largest drift of J_L so far, as bits, if one is known.
    pub spatial_momentum: Option<u64>,
    /// The largest drift of Casimirs so far, as bits, if one is known.
    pub casimirs: Option<u64>,
    /// Rows whose drift could not be measured.
    #[serde(default)]
    pub unmeasured: u64,
    /// The largest ratio of the last two terms of the series worth a warning so far, as bits.
    #[serde(default)]
    pub ratio: u64,
    /// The backends that have made the steps so far. All give the same bits, but for what the identity says.
    #[serde(default)]
    pub made_by: Vec<String>,
    /// Rows of which a device has refused steps that others then made.
    #[serde(default)]
    pub redone: u64,
    /// Whether all is written and only names are to be changed.
    pub complete: bool,
    /// The bytes of the whole file then, and their checksum.
    pub whole: [u64; 2],
}

impl Journal {
    /// The journal at `path`; `None` where there is none.
    pub fn read(path: &Path) -> Result<Option<Self>, CliError> {
        note::read(path, "journal", ANEW)
    }

    /// Writes it: the old journal or the new one, never a piece.
    pub fn write(&self, path: &Path, inputs: &[&Path]) -> Result<(), CliError> {
        note::write(self, path, inputs)
    }

    /// How much of the output there is.
    pub fn extent(&self) -> Extent {
        Extent { bytes: self.output, crc32: self.output_crc32 }
    }

    /// How much of the list of rejected rows there is.
    pub fn rejected_extent(&self) -> Extent {
        Extent { bytes: self.rejected_bytes, crc32: self.rejected_crc32 }
    }

    /// Refuses to go on with a run that is another.
    pub fn check(&self, path: &Path, identity: &Identity) -> Result<(), CliError> {
        let advice = format!("go on as then, or {ANEW}");
        note::agree(path, &self.identity, identity, &advice)
    }

    /// The largest drifts so far.
    pub fn drift(&self) -> Drift {
        let conserved = step::Drift {
            spatial_momentum: self.spatial_momentum.map(f64::from_bits),
            casimirs: self.casimirs.map(f64::from_bits),
            energy: None,
        };
        Drift { conserved, unmeasured: self.unmeasured, ratio: f64::from_bits(self.ratio) }
    }

    /// Takes note of what makes the steps now.
    pub fn made_by(&mut self, engine: &dyn Engine) {
        let maker = engine.device().map_or_else(|| engine.backend(), |device| device.to_string());
        if !self.made_by.contains(&maker) {
            self.made_by.push(maker);
        }
    }

    /// Takes note of drifts.
    pub fn raise(&mut self, drift: Drift) {
        let drift = self.drift().max(drift);
        self.spatial_momentum = drift.conserved.spatial_momentum.map(f64::to_bits);
        self.casimirs = drift.conserved.casimirs.map(f64::to_bits);
        self.unmeasured = drift.unmeasured;
        self.ratio = drift.ratio.to_bits();
    }
}

/// Bytes read in one piece to recognise a file.
const PIECE: u64 = 1 << 20;
/// Pieces looked at.
const PIECES: u64 = 64;

/// The length of a file and a hash (FNV-1a, 64 bits) of it: of all of it up to 64 MiB, beyond of 64
/// pieces of 1 MiB from beginning to end.
pub fn fingerprint(path: &Path) -> Result<String, CliError> {
    let hash = || -> std::io::Result<String> {
        let mut file = file::open(path)?;
        let length = file.metadata()?.len();
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let mut piece = Vec::new();
        for number in 0..length.div_ceil(PIECE).min(PIECES) {
            // Whole files piece by piece; large ones at even distances, the last piece last.
            let start = if length <= PIECE * PIECES {
                number * PIECE
            } else {
                (length - PIECE) / (PIECES - 1) * number
            };
            file.seek(SeekFrom::Start(start))?;
            piece.clear();
            Read::by_ref(&mut file).take(PIECE).read_to_end(&mut piece)?;
            for &byte in &piece {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
        Ok(format!("{length} bytes, {hash:016x}"))
    };
    hash().map_err(|source| CliError::Read { path: path.into(), source })
}
