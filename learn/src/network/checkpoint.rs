//! Where training stands, on disk: an interrupted run goes on and ends with the same bits.
//!
//! A line of JSON, then the numbers as little-endian 64-bit floats. A file is written beside its
//! place and moved there, so that there is always a whole one.

use std::io::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::adam::Adam;
use crate::error::LearnError;

/// The first field of every checkpoint.
const FORMAT: &str = "coadjoint-checkpoint-1";

/// The state between two evaluations of the loss.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct State {
    /// The unknowns.
    pub(super) weights: Vec<f64>,
    /// Adam's moments.
    pub(super) adam: Adam,
    /// The loss of every evaluation so far.
    pub(super) history: Vec<f64>,
    /// Whether there is nothing more to gain.
    pub(super) finished: bool,
}

#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    task: u64,
    unknowns: usize,
    evaluations: usize,
    finished: bool,
}

impl State {
    pub(super) fn new(weights: Vec<f64>) -> Self {
        let adam = Adam::new(weights.len());
        Self { weights, adam, history: Vec::new(), finished: false }
    }

    /// Writes the state of the task with this fingerprint.
    pub(super) fn save(&self, path: &Path, task: u64) -> Result<(), LearnError> {
        let fail = |source| LearnError::File { path: path.into(), source };
        let header = Header {
            format: FORMAT.into(),
            task,
            unknowns: self.weights.len(),
            evaluations: self.history.len(),
            finished: self.finished,
        };
        let mut bytes = serde_json::to_vec(&header).map_err(|e| fail(e.into()))?;
        bytes.push(b'\n');
        for part in [&self.weights, &self.adam.first, &self.adam.second, &self.history] {
            bytes.extend(part.iter().flat_map(|v| v.to_le_bytes()));
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
        let numbers: Vec<f64> =
            bytes[end + 1..].chunks_exact(8).map(|c| f64::from_le_bytes(eight(c))).collect();
        let (n, m) = (header.unknowns, header.evaluations);
        if n.checked_mul(3).and_then(|k| k.checked_add(m)) != Some(numbers.len()) {
            return Err(fail("it is cut off"));
        }
        let part = |from: usize, to: usize| numbers[from..to].to_vec();
        Ok(Some(Self {
            weights: part(0, n),
            adam: Adam { first: part(n, 2 * n), second: part(2 * n, 3 * n) },
            history: part(3 * n, 3 * n + m),
            finished: header.finished,
        }))
    }
}

/// The eight bytes of a chunk of eight.
fn eight(chunk: &[u8]) -> [u8; 8] {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(chunk);
    bytes
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
        state.adam.second[1] = 0.25;
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
