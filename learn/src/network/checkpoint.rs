//! Where training stands, on disk: an interrupted run goes on and ends with the same bits.
//!
//! A line of JSON, the numbers as little-endian 64-bit floats, and a CRC-32 of all of these. A file is written beside
//! its place and moved there, so that there is always a whole one.

use std::collections::VecDeque;
use std::path::Path;

use coadjoint_codegen::file;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::error::LearnError;

/// The first field of every checkpoint.
const FORMAT: &str = "coadjoint-checkpoint-4";

/// The state between two evaluations of the loss: the stage of the method, and all losses so far.
pub(super) struct State {
    pub(super) stage: Stage,
    pub(super) history: Vec<f64>,
}

/// The unknowns, with the memory of the current method.
pub(super) enum Stage {
    /// Steps of Adam, with its two running means.
    Adam { weights: Vec<f64>, moments: [Vec<f64>; 2] },
    /// The memory of L-BFGS.
    Descent(Descent),
}

/// Where a descent stands: the best weights found with their loss and gradient, the last steps and
/// changes of the gradient, the latest last, and whether no step could be found that lowers the loss.
pub(super) struct Descent {
    pub(super) weights: DVector<f64>,
    pub(super) loss: f64,
    pub(super) gradient: DVector<f64>,
    pub(super) pairs: VecDeque<[DVector<f64>; 2]>,
    pub(super) stuck: bool,
}

/// The first line: the state but for its numbers, which follow in lists of these lengths.
#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    task: u32,
    lengths: Vec<usize>,
    /// Whether L-BFGS is at work, and whether it is stuck.
    descent: Option<bool>,
}

impl State {
    pub(super) fn new(weights: Vec<f64>) -> Self {
        let moments = [(); 2].map(|()| vec![0.0; weights.len()]);
        Self { stage: Stage::Adam { weights, moments }, history: Vec::new() }
    }

    /// Writes the state of the task with this fingerprint.
    pub(super) fn save(&self, path: &Path, task: u32) -> Result<(), LearnError> {
        let fail = LearnError::file(path);
        let mut lists = vec![self.history.as_slice()];
        let descent = match &self.stage {
            Stage::Adam { weights, moments: [first, second] } => {
                lists.extend([weights.as_slice(), first, second]);
                None
            }
            Stage::Descent(now) => {
                lists.push(std::slice::from_ref(&now.loss));
                let rows = [&now.weights, &now.gradient].into_iter();
                lists.extend(rows.chain(now.pairs.iter().flatten()).map(|row| row.as_slice()));
                Some(now.stuck)
            }
        };
        let lengths = lists.iter().map(|list| list.len()).collect();
        let header = Header { format: FORMAT.into(), task, lengths, descent };
        let mut bytes = serde_json::to_vec(&header).map_err(|e| fail(e.into()))?;
        bytes.push(b'\n');
        bytes.extend(lists.into_iter().flatten().flat_map(|v| v.to_le_bytes()));
        bytes.extend(file::crc32(&bytes).to_le_bytes());
        file::write(path, &[], &bytes).map_err(fail)
    }

    /// Reads the state of the task with this fingerprint; `None` if there is no file.
    pub(super) fn load(path: &Path, task: u32) -> Result<Option<Self>, LearnError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(LearnError::file(path)(error)),
        };
        let fail = |reason: &str| LearnError::Checkpoint(path.into(), reason.into());
        let (bytes, sum) = bytes.split_last_chunk::<4>().unwrap_or((&[], &[0; 4]));
        if file::crc32(bytes) != u32::from_le_bytes(*sum) {
            return Err(fail("it is damaged, or not a checkpoint of this version"));
        }
        let end = bytes.iter().position(|&b| b == b'\n').unwrap_or(0);
        let header = serde_json::from_slice(&bytes[..end]).ok();
        let header = header.filter(|header: &Header| header.format == FORMAT);
        let header = header.ok_or_else(|| fail("it is not a checkpoint of this version"))?;
        if header.task != task {
            return Err(fail("it belongs to other data or other options"));
        }
        let mut numbers = bytes[end + 1..].as_chunks().0.iter().map(|&c| f64::from_le_bytes(c));
        let lists = header.lengths.iter().map(|&n| numbers.by_ref().take(n).collect());
        Self::of(lists, header.descent).map(Some).ok_or_else(|| fail("it is cut off"))
    }

    fn of(mut lists: impl Iterator<Item = Vec<f64>>, descent: Option<bool>) -> Option<Self> {
        let history = lists.next()?;
        let stage = match descent {
            None => Stage::Adam { weights: lists.next()?, moments: [lists.next()?, lists.next()?] },
            Some(stuck) => {
                let loss = *lists.next()?.first()?;
                let (weights, gradient) = (lists.next()?.into(), lists.next()?.into());
                let rows: Vec<DVector<f64>> = lists.map(DVector::from_vec).collect();
                let pairs = rows.as_chunks().0.iter().cloned().collect();
                Stage::Descent(Descent { weights, loss, gradient, pairs, stuck })
            }
        };
        Some(Self { stage, history })
    }
}
