//! How far a run has come, on the disk.

use coadjoint_run::simulate::Resume;
use serde::{Deserialize, Serialize};

use super::samples::Samples;
use crate::note::Identity;

/// The way to forget an earlier run.
pub(crate) const ANEW: &str = "remove it to begin anew";

/// The progress of a run. Records that it counts are on the disk before it is.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Checkpoint {
    /// The description of the run.
    pub identity: Identity,
    /// The state, and the maxima so far.
    pub resume: Resume,
    /// Bytes of the file of records.
    pub bytes: u64,
    /// The checksum of these.
    pub records_crc32: u32,
    /// Records in it.
    pub rows: u64,
    /// The moments kept for pictures, if any are.
    pub samples: Option<Samples>,
    /// Whether the run has finished.
    pub complete: bool,
}
