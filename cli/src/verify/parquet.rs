//! Rows of a Parquet file.

use std::path::{Path, PathBuf};

use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::Field;
use ::parquet::record::reader::RowIter;

use coadjoint_codegen::file;

use super::table::damaged;
use crate::error::{CliError, unread};

/// The rows of a Parquet file, as numbers; a null, and what is no number, is NaN.
pub struct Rows {
    path: PathBuf,
    rows: RowIter<'static>,
}

impl Rows {
    /// The names of the columns, and the rows.
    ///
    /// # Errors
    /// Where the file is damaged.
    pub fn open(path: &Path) -> Result<(Vec<String>, Self), CliError> {
        let file = file::open(path).map_err(unread(path))?;
        let reader = SerializedFileReader::new(file).map_err(|error| damaged(path, &error))?;
        let columns = reader.metadata().file_metadata().schema_descr().columns();
        let names = columns.iter().map(|column| column.path().string()).collect();
        let rows = RowIter::from_file_into(Box::new(reader));
        Ok((names, Self { path: path.into(), rows }))
    }

    /// The next row.
    ///
    /// # Errors
    /// Where the file is damaged.
    pub fn next_row(&mut self) -> Result<Option<Vec<f64>>, CliError> {
        let Some(row) = self.rows.next() else { return Ok(None) };
        let row = row.map_err(|error| damaged(&self.path, &error))?;
        let number = |(_, field): (&String, &Field)| match field {
            Field::Double(value) => *value,
            Field::Float(value) => f64::from(*value),
            _ => f64::NAN,
        };
        Ok(Some(row.get_column_iter().map(number).collect()))
    }
}
