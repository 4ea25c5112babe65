//! Where training stands, on disk: an interrupted run goes on and ends with the same bits.
//!
//! A line of JSON, then the numbers as little-endian 64-bit floats. A file is written beside its
//! place and moved there, so that there is always a whole one.

use std::collections::VecDeque;
use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::adam::Adam;
use super::lbfgs::{Descent, Pair};
use crate::error::LearnError;

/// The first field of every checkpoint.
const FORMAT: &str = "coadjoint-checkpoint-2";

/// The state between two evaluations of the loss.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct State {
    /// What is being done.
    pub(super) stage: Stage,
    /// The loss of every evaluation so far.
    pub(super) history: Vec<f64>,
}

/// The unknowns, with what the method at work remembers.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stage {
    /// Steps of Adam.
    Adam { weights: Vec<f64>, moments: Adam },
    /// The memory of L-BFGS.
    Descent(Descent),
}

#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    task: u64,
    unknowns: usize,
    evaluations: usize,
    /// L-BFGS: the pairs it remembers, and whether it is stuck.
    descent: Option<(usize, bool)>,
}

impl State {
    pub(super) fn new(weights: Vec<f64>) -> Self {
        let moments = Adam::new(weights.len());
        Self { stage: Stage::Adam { weights, moments }, history: Vec::new() }
    }

    /// Writes the state of the task with this fingerprint.
    pub(super) fn save(&self, path: &Path, task: u64) -> Result<(), LearnError> {
        let fail = |source| LearnError::File { path: path.into(), source };
        let (weights, descent) = match &self.stage {
            Stage::Adam { weights, .. } => (weights, None),
            Stage::Descent(descent) => {
                (&descent.weights, Some((descent.pairs.len(), descent.stuck)))
            }
        };
        let header = Header {
            format: FORMAT.into(),
            task,
            unknowns: weights.len(),
            evaluations: self.history.len(),
            descent,
        };
        let mut bytes = serde_json::to_vec(&header).map_err(|e| fail(e.into()))?;
        bytes.push(b'\n');
        let mut put = |part: &[f64]| bytes.extend(part.iter().flat_map(|v| v.to_le_bytes()));
        put(&self.history);
        put(weights);
        match &self.stage {
            Stage::Adam { moments, .. } => {
                put(&moments.first);
                put(&moments.second);
            }
            Stage::Descent(descent) => {
                put(&descent.gradient);
                for pair in &descent.pairs {
                    put(&pair.moved);
                    put(&pair.change);
                }
                put(&[descent.loss]);
            }
        }
        let mut beside = path.as_os_str().to_owned();
        beside.push(".new");
        let write = || -> std::io::Result<()> {
            let mut file = std::fs::File::create(&beside)?;
            file.write_all(&bytes)?;
            file.sync_all()?;
            std::fs::rename(&beside, path)
        };
        write().map_err(fail)
    }

    /// Reads the state of the task with this fingerprint; `None` if there is no file.
    pub(super) fn load(path: &Path, task: u64) -> Result<Option<Self>, LearnError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(LearnError::File { path: path.into(), source }),
        };
        let fail =
            |reason: &str| LearnError::Checkpoint { path: path.into(), reason: reason.into() };
        let end = bytes.iter().position(|&b| b == b'\n').unwrap_or(0);
        let header: Header = serde_json::from_slice(&bytes[..end])
            .ok()
            .filter(|h: &Header| h.format == FORMAT)
            .ok_or_else(|| fail("it is damaged, or no checkpoint of this version"))?;
        if header.task != task {
            return Err(fail("it belongs to other data or other options"));
        }
        let mut numbers = Numbers { bytes: &bytes[end + 1..] };
        let mut take = |count| numbers.take(count).ok_or_else(|| fail("it is cut off"));
        let n = header.unknowns;
        let (history, weights) = (take(header.evaluations)?, take(n)?);
        let stage = match header.descent {
            None => Stage::Adam { weights, moments: Adam { first: take(n)?, second: take(n)? } },
            Some((count, stuck)) => {
                let gradient = take(n)?;
                let mut pairs = VecDeque::new();
                for _ in 0..count {
                    pairs.push_back(Pair::new(take(n)?, take(n)?));
                }
                let loss = take(1)?[0];
                Stage::Descent(Descent { weights, loss, gradient, pairs, stuck })
            }
        };
        Ok(Some(Self { stage, history }))
    }
}

/// Numbers not yet read.
struct Numbers<'a> {
    bytes: &'a [u8],
}

impl Numbers<'_> {
    /// The next numbers, if there are so many.
    fn take(&mut self, count: usize) -> Option<Vec<f64>> {
        let (these, rest) = self.bytes.split_at_checked(count.checked_mul(8)?)?;
        self.bytes = rest;
        Some(these.as_chunks().0.iter().map(|&c| f64::from_le_bytes(c)).collect())
    }
}

/// A number that tells tasks apart: the FNV-1a hash (Fowler, Noll and Vo) of words and numbers,
/// the same in every build.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fingerprint(u64);

impl Fingerprint {
    pub(super) fn new(words: &str) -> Self {
        Self(0xcbf2_9ce4_8422_2325).bytes(words.as_bytes())
    }

    fn bytes(mut self, bytes: &[u8]) -> Self {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
        self
    }

    pub(super) fn numbers(self, numbers: &[f64]) -> Self {
        numbers.iter().fold(self, |hash, v| hash.bytes(&v.to_le_bytes()))
    }

    pub(super) fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn reads_back_and_refuses_damaged_and_foreign_files() {
        let path =
            std::env::temp_dir().join(format!("coadjoint-{}.checkpoint", std::process::id()));
        let task = Fingerprint::new("a").numbers(&[1.0, 2.0]).value();
        assert_ne!(task, Fingerprint::new("a").numbers(&[1.0, 2.5]).value());
        assert_eq!(State::load(&path, task).unwrap(), None);
        let mut state = State::new(vec![0.1, -1e-300, f64::MAX]);
        state.history = vec![3.0, 2.0];
        state.save(&path, task).unwrap();
        assert_eq!(State::load(&path, task).unwrap(), Some(state.clone()));
        let row = |seed: f64| vec![seed, 0.25 - seed, 7.0 * seed];
        let pair = |seed| Pair::new(row(seed), row(-seed));
        state.stage = Stage::Descent(Descent {
            weights: row(1.0),
            loss: f64::INFINITY,
            gradient: row(2.0),
            pairs: [pair(3.0), pair(4.0)].into(),
            stuck: true,
        });
        state.save(&path, task).unwrap();
        assert_eq!(State::load(&path, task).unwrap(), Some(state));
        let reason = |task| State::load(&path, task).unwrap_err().to_string();
        assert!(reason(task + 1).contains("other data"), "{}", reason(task + 1));
        let whole = std::fs::read(&path).unwrap();
        std::fs::write(&path, &whole[..whole.len() - 8]).unwrap();
        assert!(reason(task).contains("cut off"));
        std::fs::write(&path, b"hello").unwrap();
        assert!(reason(task).contains("damaged") && reason(task).contains("delete it"));
        std::fs::remove_file(&path).unwrap();
    }
}
