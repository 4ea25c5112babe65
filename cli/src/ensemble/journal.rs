//! The note beside an output: how far a run has come.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use coadjoint_codegen::file;
use coadjoint_codegen::step;
use coadjoint_run::ensemble::{Drift, Engine};
use serde::{Deserialize, Serialize};

use crate::error::{CliError, unread};
use crate::note::Identity;

/// The way to forget an earlier run.
pub(crate) const ANEW: &str = "begin anew with --restart";

/// The state of a run. Everything it counts is on the disk before it is.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(crate) struct Journal {
    /// The identity of the run.
    pub identity: Identity,
    /// Rows written.
    pub rows: u64,
    /// The output and the list of rejected rows so far: bytes, and their checksum.
    pub files: [(u64, u32); 2],
    /// Rejected rows so far.
    pub rejected: u64,
    /// The position of the next row in the input.
    pub position: u64,
    /// The largest drift of J_L so far, as bits, if one is known.
    pub spatial_momentum: Option<u64>,
    /// The largest drift of Casimirs so far, as bits, if one is known.
    pub casimirs: Option<u64>,
    /// Rows whose drift could not be measured.
    pub unmeasured: u64,
    /// The largest ratio of the last two terms of the series worth a warning so far, as bits.
    pub ratio: u64,
    /// The steps that the generic solver made so far.
    pub rescued: u64,
    /// The backends that have made the steps so far. All give the same bits, but for what the identity says.
    pub made_by: Vec<String>,
    /// Rows of which a device has refused steps that others then made.
    pub redone: u64,
    /// The errors estimated at the ends of some rows so far.
    pub estimates: Vec<f64>,
    /// The number of those rows without an estimate, and the reason of the first.
    pub unknown: u64,
    pub why: Option<String>,
}

impl Journal {
    /// The median and the largest of the errors estimated.
    pub(crate) fn estimated(&self) -> Option<[f64; 2]> {
        let mut all = self.estimates.clone();
        all.sort_by(f64::total_cmp);
        Some([*all.get(all.len() / 2)?, *all.last()?])
    }

    /// Takes note of estimates.
    pub(crate) fn note(&mut self, found: Vec<Result<f64, String>>) {
        for one in found {
            match one {
                Ok(error) => self.estimates.push(error),
                Err(why) => {
                    self.unknown += 1;
                    self.why.get_or_insert(why);
                }
            }
        }
    }

    /// The largest drifts so far.
    pub(crate) fn drift(&self) -> Drift {
        let [spatial_momentum, casimirs] =
            [self.spatial_momentum, self.casimirs].map(|drift| drift.map(f64::from_bits));
        let conserved = step::Drift { spatial_momentum, casimirs, energy: None };
        let &Self { unmeasured, rescued, ratio, .. } = self;
        Drift { conserved, unmeasured, ratio: f64::from_bits(ratio), rescued }
    }

    /// Takes note of drifts, and of what has made the steps.
    pub(crate) fn raise(&mut self, drift: Drift, engine: &Engine<'_>) {
        let Drift { conserved, unmeasured, ratio, rescued } = self.drift().max(drift);
        self.spatial_momentum = conserved.spatial_momentum.map(f64::to_bits);
        self.casimirs = conserved.casimirs.map(f64::to_bits);
        (self.unmeasured, self.ratio, self.rescued) = (unmeasured, ratio.to_bits(), rescued);
        let maker = engine.device().map_or_else(|| engine.backend(), |device| device.to_string());
        if !self.made_by.contains(&maker) {
            self.made_by.push(maker);
        }
    }
}

/// Bytes read in one piece to recognise a file.
const PIECE: u64 = 1 << 20;
/// Pieces looked at.
const PIECES: u64 = 64;

/// The length of a file and a hash (FNV-1a, 64 bits, of words in place of bytes) of it: of all of it up to 64 MiB, beyond of
/// 64 pieces of 1 MiB from beginning to end.
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
            let (words, rest) = piece.as_chunks();
            let words = words.iter().map(|word| u64::from_le_bytes(*word));
            for word in words.chain(rest.iter().map(|byte| u64::from(*byte))) {
                hash = (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
        Ok(format!("{length} bytes, {hash:016x}"))
    };
    hash().map_err(unread(path))
}
