//! A piece of an ensemble in memory.

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

    /// Adds a row that cannot be read: NaN in every column.
    pub fn reject(&mut self, row: u64, width: usize, reason: String) {
        self.values.resize(self.values.len() + width, f64::NAN);
        self.rejected.push(Rejected { row, step: 0, reason });
    }
}
