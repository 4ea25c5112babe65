//! Rows of states in memory.

use super::engine::{Drift, Engine, Watch};
use super::layout::Layout;
use crate::error::RunError;

/// A row that has no end state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejected {
    /// Its number, from 1; in a file the line of names is not counted.
    pub row: u64,
    /// The step that could not be made, from 1; 0 where the row itself is at fault.
    pub step: u64,
    /// Why.
    pub reason: String,
}

/// Consecutive rows, numbers side by side.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// The number of the first one, from 1.
    pub first: u64,
    /// Row-major.
    pub values: Vec<f64>,
    /// Rows already known to be bad, ascending.
    pub rejected: Vec<Rejected>,
}

impl Rows {
    /// Empties it, to begin at row `first`.
    pub fn clear(&mut self, first: u64) {
        self.first = first;
        self.values.clear();
        self.rejected.clear();
    }
}

/// Rows taken at a time: enough for all threads, little enough to be noted often. A card has as many threads as rows.
pub fn piece(width: usize, steps: u64, card: bool) -> u64 {
    if card {
        return ((256 << 20) / (width as u64 * 8)).clamp(512, 1 << 20);
    }
    let memory = (8 << 20) / (width as u64 * 8);
    (2_000_000 / steps.max(1)).min(memory).clamp(512, 65_536)
}

/// Advances all rows in place, piece by piece. Rows that fail become NaN and are told. The watch is told the steps of all
/// rows together.
///
/// # Errors
/// As [`Engine::advance`].
pub fn advance_all(
    engine: &dyn Engine,
    layout: &Layout,
    steps: u64,
    values: &mut [f64],
    watch: &Watch<'_>,
) -> Result<(Vec<Rejected>, Drift), RunError> {
    let width = layout.width();
    let card = engine.device().is_some_and(|by| !by.processor);
    let length = piece(width, steps, card) as usize;
    let mut rows = Rows::default();
    let (mut rejected, mut drift) = (Vec::new(), Drift::default());
    for (number, own) in values.chunks_mut(length * width).enumerate() {
        let first = (number * length) as u64;
        rows.clear(first + 1);
        rows.values.extend_from_slice(own);
        let count = (own.len() / width) as u64;
        let made = |made: u64| (watch.made)(first.saturating_mul(steps) + count * made);
        let found = engine.advance(layout, steps, &mut rows, &Watch { made: &made, ..*watch })?;
        drift = drift.max(found);
        own.copy_from_slice(&rows.values);
        rejected.append(&mut rows.rejected);
    }
    Ok((rejected, drift))
}
