//! Parquet with columns of 64- or 32-bit floats (uncompressed or Snappy).

use std::fs::File;
use std::path::Path;

use ::parquet::errors::ParquetError;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::Field;

use super::columns::Columns;
use crate::error::LearnError;

/// Reads every column of numbers; others are left out.
pub(super) fn read(path: &Path) -> Result<Columns, LearnError> {
    let format = |e: ParquetError| LearnError::Format {
        path: path.into(),
        format: "Parquet",
        reason: e.to_string(),
    };
    let file = File::open(path).map_err(|source| LearnError::File { path: path.into(), source })?;
    let reader = SerializedFileReader::new(file).map_err(format)?;
    let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
    for row in reader.get_row_iter(None).map_err(format)? {
        let row = row.map_err(format)?;
        let mut numbers = 0;
        for (name, field) in row.get_column_iter() {
            let value = match field {
                Field::Double(v) => *v,
                Field::Float(v) => f64::from(*v),
                Field::Null => f64::NAN,
                _ => continue,
            };
            if columns.len() <= numbers {
                columns.push((name.clone(), Vec::new()));
            }
            columns[numbers].1.push(value);
            numbers += 1;
        }
    }
    Columns::new(columns)
}
