//! Notes beside an output: how far a run has come, and what a finished one was.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use coadjoint_codegen::file::{self, Extent};
use coadjoint_codegen::step;
use coadjoint_run::ensemble::{Drift, Engine};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::{CliError, unread};
use crate::note::{Identity, agree};

/// The way to forget an earlier run.
pub(crate) const ANEW: &str = "begin anew with --restart";

/// The state of a run. Everything it counts is on the disk before it is.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(crate) struct Journal {
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
    /// The errors estimated at the ends of some rows so far.
    #[serde(default)]
    pub estimates: Vec<f64>,
    /// Whether all is written and only names are to be changed.
    pub complete: bool,
    /// The bytes of the whole file then, and their checksum.
    pub whole: [u64; 2],
}

impl Journal {
    /// How much there is of the output and of the list of rejected rows.
    pub(crate) fn extents(&self) -> [Extent; 2] {
        let output = Extent { bytes: self.output, crc32: self.output_crc32 };
        [output, Extent { bytes: self.rejected_bytes, crc32: self.rejected_crc32 }]
    }

    /// Refuses to go on with a run that is another.
    pub(crate) fn check(&self, path: &Path, identity: &Identity) -> Result<(), CliError> {
        agree(path, &self.identity, identity, &format!("go on as then, or {ANEW}"))
    }

    /// The median and the largest of the errors estimated.
    pub(crate) fn estimated(&self) -> Option<[f64; 2]> {
        let mut all = self.estimates.clone();
        all.sort_by(f64::total_cmp);
        Some([*all.get(all.len() / 2)?, *all.last()?])
    }

    /// The largest drifts so far.
    pub(crate) fn drift(&self) -> Drift {
        let [spatial_momentum, casimirs] =
            [self.spatial_momentum, self.casimirs].map(|drift| drift.map(f64::from_bits));
        let conserved = step::Drift { spatial_momentum, casimirs, energy: None };
        Drift { conserved, unmeasured: self.unmeasured, ratio: f64::from_bits(self.ratio) }
    }

    /// Takes note of drifts, and of what has made the steps.
    pub(crate) fn raise(&mut self, drift: Drift, engine: &Engine<'_>) {
        let Drift { conserved, unmeasured, ratio } = self.drift().max(drift);
        self.spatial_momentum = conserved.spatial_momentum.map(f64::to_bits);
        self.casimirs = conserved.casimirs.map(f64::to_bits);
        (self.unmeasured, self.ratio) = (unmeasured, ratio.to_bits());
        let maker = engine.device().map_or_else(|| engine.backend(), |device| device.to_string());
        if !self.made_by.contains(&maker) {
            self.made_by.push(maker);
        }
    }
}

/// The note that `--keep` leaves of a finished run, for the same command started again and for programs that join shards.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct Finished {
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
    pub(crate) fn of(
        out: &Path,
        list: &Path,
        first_row: u64,
        journal: Journal,
    ) -> Result<Self, CliError> {
        let rejected_sha256 = if journal.rejected > 0 { Some(sha256(list)?) } else { None };
        Ok(Self { first_row, sha256: sha256(out)?, rejected_sha256, journal })
    }

    /// Whether the files are those that it describes.
    pub(crate) fn is_whole(&self, out: &Path, list: &Path) -> Result<bool, CliError> {
        let same = |path: &Path, known: &str| -> Result<bool, CliError> {
            Ok(path.exists() && sha256(path)? == known)
        };
        let list_is = self.rejected_sha256.as_ref().map_or(Ok(true), |known| same(list, known))?;
        Ok(list_is && same(out, &self.sha256)?)
    }
}

/// SHA-256 of a file, in hexadecimal digits.
fn sha256(path: &Path) -> Result<String, CliError> {
    let mut hash = Sha256::new();
    let copied = file::open(path).and_then(|mut file| std::io::copy(&mut file, &mut hash));
    copied.map_err(unread(path))?;
    Ok(format!("{:x}", hash.finalize()))
}

/// Bytes read in one piece to recognise a file.
const PIECE: u64 = 1 << 20;
/// Pieces looked at.
const PIECES: u64 = 64;

/// The length of a file and a hash (FNV-1a, 64 bits) of it: of all of it up to 64 MiB, beyond of 64
/// pieces of 1 MiB from beginning to end.
pub(crate) fn fingerprint(path: &Path) -> Result<String, CliError> {
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
    hash().map_err(unread(path))
}
