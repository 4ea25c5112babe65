//! Rows of states that Python has given, for those who read rows one by one.

use coadjoint_run::{RunError, verify};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};

/// Rows that Python has given.
pub struct Given {
    values: Vec<f64>,
    /// Numbers of a row.
    pub width: usize,
    next: usize,
}

impl Given {
    /// Copies the rows, whatever their strides.
    pub fn new(rows: &PyReadonlyArray2<'_, f64>) -> Self {
        Self { values: rows.as_array().iter().copied().collect(), width: rows.shape()[1], next: 0 }
    }
}

impl verify::Rows for Given {
    type Error = RunError;

    fn next_row(&mut self) -> Result<Option<Vec<f64>>, RunError> {
        let row = self.values.get(self.next..self.next + self.width);
        self.next += self.width;
        Ok(row.filter(|row| !row.is_empty()).map(<[f64]>::to_vec))
    }

    fn value(&self, _: &str) -> Option<&str> {
        None
    }

    fn numbers(&self, _: &str) -> Option<Vec<f64>> {
        None
    }
}
