//! Reading a file by the ending of its name.

use std::path::Path;

use coadjoint_codegen::file;

use super::columns::Columns;
use super::npy;
use crate::error::LearnError;
use crate::table::{Row, Table};

/// Reads the columns of a data file: `.csv` with a header, `.npz` with named arrays, `.npy` with
/// one matrix, `.parquet` (feature `parquet`).
///
/// `dim` is n and `matrix_size` is d, the size of group elements as matrices; only `.npy`, which
/// has no names, needs them.
///
/// # Errors
/// [`LearnError::UnknownFormat`] for another ending, else what is wrong with the file.
pub fn read_columns(path: &Path, dim: usize, matrix_size: usize) -> Result<Columns, LearnError> {
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let columns = match ending.as_deref() {
        Some("npz") => npy::read_npz(path)?,
        Some("npy") => {
            let table = open(path)?;
            let names = npy::names(path, table.width(), dim, matrix_size)?;
            all_of(path, table, names)?
        }
        Some("csv" | "parquet") => {
            let table = open(path)?;
            let names = table.names().to_vec();
            all_of(path, table, names)?
        }
        _ => return Err(LearnError::UnknownFormat(path.into())),
    };
    if columns.rows() == 0 {
        return Err(LearnError::NoSamples);
    }
    Ok(columns)
}

/// A table that fits into memory.
fn open(path: &Path) -> Result<Table, LearnError> {
    file::open_whole(path).map_err(LearnError::file(path))?;
    Table::open(path)
}

/// Reads all rows; columns that are not ours may hold any text.
fn all_of(path: &Path, mut table: Table, names: Vec<String>) -> Result<Columns, LearnError> {
    let ours = |name: &str| ["mu_", "g_", "q_"].iter().any(|start| name.starts_with(start));
    let mut values = vec![Vec::new(); names.len()];
    let mut cells = Row::default();
    while table.read(&mut cells)? {
        let row = table.number() as usize;
        if cells.len() != names.len() {
            let reason = format!("row {row} has {} cells in place of {}", cells.len(), names.len());
            return Err(LearnError::format(path, "CSV", reason));
        }
        for (place, (name, column)) in names.iter().zip(&mut values).enumerate() {
            column.push(match cells.number(place) {
                Ok(value) => value,
                Err(_) if !ours(name) => f64::NAN,
                Err(text) => {
                    return Err(LearnError::NotANumber { row, column: name.clone(), text });
                }
            });
        }
    }
    Columns::new(names.into_iter().zip(values))
}
