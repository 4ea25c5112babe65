//! Reading states piece by piece.

mod csv;
mod npy;
#[cfg(feature = "parquet")]
mod parquet;

use std::path::Path;

use super::table::{Piece, Table};
use crate::error::CliError;
use coadjoint_run::ensemble::{Known, Layout, Shape};

/// A file of states that is read forwards.
pub trait Input {
    /// The columns.
    fn layout(&self) -> Layout;

    /// All columns, where they have names and cells of any kind that can be carried through.
    fn table(&self) -> Option<&Table> {
        None
    }

    /// The number of rows.
    fn total(&self) -> u64;

    /// Goes to a row, counted from 0; `position` is what [`Input::position`] said there, if it
    /// is known.
    fn seek(&mut self, row: u64, position: Option<u64>) -> Result<(), CliError>;

    /// Where the next row begins, for [`Input::seek`].
    fn position(&self) -> u64;

    /// Adds the next `count` rows.
    fn read(&mut self, count: usize, piece: &mut Piece) -> Result<(), CliError>;
}

/// Opens a file by the ending of its name.
pub fn open(path: &Path, shape: Shape, known: &Known) -> Result<Box<dyn Input>, CliError> {
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("csv") => Ok(Box::new(csv::CsvInput::open(path, shape, known)?)),
        Some("npy") => Ok(Box::new(npy::NpyInput::open(path, shape)?)),
        #[cfg(feature = "parquet")]
        Some("parquet") => Ok(Box::new(parquet::ParquetInput::open(path, shape, known)?)),
        _ => Err(CliError::Option(format!(
            "--initial {}: the name must end in .csv or .npy, or in .parquet where the program \
             was built with the feature `parquet`",
            path.display()
        ))),
    }
}

/// An error in a data file.
fn damaged(path: &Path, reason: impl std::fmt::Display) -> CliError {
    CliError::Option(format!("{}: {reason}", path.display()))
}
