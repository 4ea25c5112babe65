//! Reading a file by the ending of its name.

use std::path::Path;

use super::columns::Columns;
use super::{csv, npy};
use crate::error::LearnError;

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
        Some("csv") => csv::read(path)?,
        Some("npz") => npy::read_npz(path)?,
        Some("npy") => npy::read_npy(path, dim, matrix_size)?,
        #[cfg(feature = "parquet")]
        Some("parquet") => super::parquet::read(path)?,
        #[cfg(not(feature = "parquet"))]
        Some("parquet") => {
            let reason = "this build cannot read it; build with --features parquet";
            return Err(LearnError::format(path, "Parquet", reason));
        }
        _ => return Err(LearnError::UnknownFormat { path: path.into() }),
    };
    if columns.rows() == 0 {
        return Err(LearnError::NoSamples);
    }
    Ok(columns)
}
