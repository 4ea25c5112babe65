//! CSV with a header of column names.

use std::path::Path;

use super::columns::Columns;
use crate::error::LearnError;

/// Reads a CSV file; cells may have blanks around them.
pub(super) fn read(path: &Path) -> Result<Columns, LearnError> {
    let format = |e: ::csv::Error| LearnError::Format {
        path: path.into(),
        format: "CSV",
        reason: e.to_string(),
    };
    let mut reader = ::csv::ReaderBuilder::new()
        .trim(::csv::Trim::All)
        .comment(Some(b'#'))
        .from_path(path)
        .map_err(format)?;
    let names: Vec<String> = reader.headers().map_err(format)?.iter().map(Into::into).collect();
    let mut values = vec![Vec::new(); names.len()];
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(format)?;
        for ((cell, name), column) in record.iter().zip(&names).zip(&mut values) {
            column.push(cell.parse().map_err(|_| LearnError::NotANumber {
                row: row + 1,
                column: name.clone(),
                text: cell.into(),
            })?);
        }
    }
    Columns::new(names.into_iter().zip(values))
}
