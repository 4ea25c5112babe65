//! How experiments are run.

use std::path::PathBuf;

use crate::outcome::Report;

/// How to run experiments.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Fewer samples and steps, smaller networks.
    pub quick: bool,
    /// The seed everything follows from.
    pub seed: u64,
    /// Where outcomes and the state of training are kept.
    pub out: Option<PathBuf>,
}

impl Options {
    /// An empty report.
    pub(super) fn report(&self, name: &str) -> Report {
        Report { name: name.into(), quick: self.quick, seed: self.seed, ..Report::default() }
    }

    /// A seed of its own for every use.
    pub(super) fn seed(&self, number: u64) -> u64 {
        self.seed.wrapping_mul(1_000_003).wrapping_add(number)
    }

    /// `full`, or `quick` in the short version.
    pub(super) fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}

/// The ending of the state of an unfinished training.
pub(super) const CHECKPOINT: &str = "checkpoint";
