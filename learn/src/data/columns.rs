//! A table of named columns of numbers, which every file format is read into.

use crate::error::LearnError;

/// Named columns of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    names: Vec<String>,
    values: Vec<Vec<f64>>,
}

impl Columns {
    /// The table of the columns given.
    ///
    /// # Errors
    /// [`LearnError::Shape`] when they differ in length.
    pub fn new(columns: impl IntoIterator<Item = (String, Vec<f64>)>) -> Result<Self, LearnError> {
        let (names, values): (Vec<_>, Vec<_>) = columns.into_iter().unzip();
        let expected = values.first().map_or(0, Vec::len);
        for (name, column) in names.iter().zip(&values) {
            if column.len() != expected {
                let what = format!("column {name}");
                return Err(LearnError::Shape { what, expected, found: column.len() });
            }
        }
        Ok(Self { names, values })
    }

    /// The names, in order.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The columns, in the order of the names.
    #[must_use]
    pub fn values(&self) -> &[Vec<f64>] {
        &self.values
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// The column called `name`.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.names.iter().position(|n| n == name)?;
        Some(&self.values[index])
    }
}
