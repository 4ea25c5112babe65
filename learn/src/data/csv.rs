//! CSV with a header of column names.

use std::path::Path;

use coadjoint_codegen::diagnostic::check_table;
use coadjoint_codegen::file;

use super::columns::Columns;
use crate::error::LearnError;

/// Reads a CSV file; cells may have blanks around them, and columns that are not ours any text.
pub(super) fn read(path: &Path) -> Result<Columns, LearnError> {
    let format = |e: ::csv::Error| LearnError::format(path, "CSV", e);
    check_table(path).map_err(LearnError::file(path))?;
    let file = file::open_whole(path).map_err(LearnError::file(path))?;
    let mut reader =
        ::csv::ReaderBuilder::new().trim(::csv::Trim::All).comment(Some(b'#')).from_reader(file);
    let names: Vec<String> = reader.headers().map_err(format)?.iter().map(Into::into).collect();
    if !names.is_empty() && names.iter().all(|name| name.parse::<f64>().is_ok()) {
        let reason = "the first line holds numbers; it must name the columns: mu_1, mu_2 …";
        return Err(LearnError::format(path, "CSV", reason));
    }
    let ours = |name: &str| ["mu_", "g_", "q_"].iter().any(|start| name.starts_with(start));
    let mut values = vec![Vec::new(); names.len()];
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(format)?;
        for ((cell, name), column) in record.iter().zip(&names).zip(&mut values) {
            column.push(match cell.parse() {
                Ok(value) => value,
                Err(_) if !ours(name) => f64::NAN,
                Err(_) => {
                    let (row, column, text) = (row + 1, name.clone(), cell.into());
                    return Err(LearnError::NotANumber { row, column, text });
                }
            });
        }
    }
    Columns::new(names.into_iter().zip(values))
}
