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

/// The state between two evaluations of the loss: what is being done, and all losses so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct State {
    pub(super) stage: Stage,
    pub(super) history: Vec<f64>,
}

/// The unknowns, with what the method at work remembers.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stage {
    /// Steps of Adam, with its two running means.
    Adam { weights: Vec<f64>, moments: [Vec<f64>; 2] },
    /// The memory of L-BFGS.
    Descent(Descent),
}

/// Where a descent stands: the best weights found with their loss and gradient, the last steps and
/// changes of the gradient, the latest last, and whether no step could be found that lowers the loss.
#[derive(Clone, Debug, PartialEq)]
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
    task: u64,
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
    pub(super) fn save(&self, path: &Path, task: u64) -> Result<(), LearnError> {
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
    pub(super) fn load(path: &Path, task: u64) -> Result<Option<Self>, LearnError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(LearnError::file(path)(error)),
        };
        let fail =
            |reason: &str| LearnError::Checkpoint { path: path.into(), reason: reason.into() };
        let (bytes, sum) = bytes.split_last_chunk::<4>().unwrap_or((&[], &[0; 4]));
        if file::crc32(bytes) != u32::from_le_bytes(*sum) {
            return Err(fail("it is damaged, or no checkpoint of this version"));
        }
        let end = bytes.iter().position(|&b| b == b'\n').unwrap_or(0);
        let header: Header = serde_json::from_slice(&bytes[..end])
            .ok()
            .filter(|h: &Header| h.format == FORMAT)
            .ok_or_else(|| fail("it is no checkpoint of this version"))?;
        if header.task != task {
            return Err(fail("it belongs to other data or other options"));
        }
        let (numbers, _) = bytes[end + 1..].as_chunks();
        if numbers.len() != header.lengths.iter().sum::<usize>() {
            return Err(fail("it is cut off"));
        }
        let mut numbers = numbers.iter().map(|&c| f64::from_le_bytes(c));
        let mut lists = header.lengths.iter().map(|&n| numbers.by_ref().take(n).collect());
        let mut list = || lists.next().ok_or_else(|| fail("it is cut off"));
        let history = list()?;
        let stage = match header.descent {
            None => Stage::Adam { weights: list()?, moments: [list()?, list()?] },
            Some(stuck) => {
                let loss = list()?.first().copied().ok_or_else(|| fail("it has no loss"))?;
                let (weights, gradient) = (list()?.into(), list()?.into());
                let rows: Vec<DVector<f64>> = lists.map(DVector::from_vec).collect();
                let pairs = rows.as_chunks().0.iter().cloned().collect();
                Stage::Descent(Descent { weights, loss, gradient, pairs, stuck })
            }
        };
        Ok(Some(Self { stage, history }))
    }
}

/// A number that tells tasks apart: the FNV-1a hash (Fowler, Noll and Vo) of words and numbers,
/// the same in every build.
pub(super) fn task(words: &str, data: &[&[f64]]) -> u64 {
    let numbers = data.iter().flat_map(|part| part.iter()).flat_map(|v| v.to_le_bytes());
    let mix = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    words.bytes().chain(numbers).fold(0xcbf2_9ce4_8422_2325, mix)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn reads_back_and_refuses_damaged_and_foreign_files() {
        let path =
            std::env::temp_dir().join(format!("coadjoint-{}.checkpoint", std::process::id()));
        let own = task("a", &[&[1.0, 2.0]]);
        assert_ne!(own, task("a", &[&[1.0, 2.5]]));
        assert_eq!(State::load(&path, own).unwrap(), None);
        let mut state = State::new(vec![0.1, -1e-300, f64::MAX]);
        state.history = vec![3.0, 2.0];
        state.save(&path, own).unwrap();
        assert_eq!(State::load(&path, own).unwrap(), Some(state.clone()));
        let row = |seed: f64| DVector::from_vec(vec![seed, 0.25 - seed, 7.0 * seed]);
        let (weights, gradient, loss) = (row(1.0), row(2.0), f64::INFINITY);
        let pairs = [[row(3.0), row(-3.0)], [row(4.0), row(-4.0)]].into();
        state.stage = Stage::Descent(Descent { weights, loss, gradient, pairs, stuck: true });
        state.save(&path, own).unwrap();
        assert_eq!(State::load(&path, own).unwrap(), Some(state));
        let reason = |task| State::load(&path, task).unwrap_err().to_string();
        assert!(reason(own + 1).contains("other data"), "{}", reason(own + 1));
        let whole = std::fs::read(&path).unwrap();
        for (place, bit) in (0..whole.len()).map(|place| (place, place % 8)) {
            let mut changed = whole.clone();
            changed[place] ^= 1 << bit;
            std::fs::write(&path, &changed).unwrap();
            assert!(reason(own).contains("damaged"), "byte {place}");
        }
        std::fs::write(&path, &whole[..whole.len() - 8]).unwrap();
        assert!(reason(own).contains("damaged"));
        std::fs::write(&path, b"hello").unwrap();
        assert!(reason(own).contains("damaged") && reason(own).contains("delete it"));
        std::fs::remove_file(&path).unwrap();
    }
}
