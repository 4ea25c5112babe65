//! Parquet with columns of 64- or 32-bit floats.

use std::fs::File;
use std::path::{Path, PathBuf};

use ::parquet::column::reader::ColumnReader;
use ::parquet::errors::ParquetError;
use ::parquet::file::reader::{FileReader, SerializedFileReader};

use super::{Input, damaged};
use crate::ensemble::table::Piece;
use crate::error::{CliError, unread};
use coadjoint_codegen::file;
use coadjoint_run::ensemble::{Found, Known, Layout, Shape};

/// A `.parquet` file, read row group by row group; a null is no number.
pub struct ParquetInput {
    path: PathBuf,
    reader: SerializedFileReader<File>,
    layout: Layout,
    /// The column of each number; none for those that are 0.
    places: Vec<Option<usize>>,
    total: u64,
    next: u64,
    /// The readers of the current row group, the group's number and the rows left in it.
    group: Option<(Vec<Option<ColumnReader>>, usize, usize)>,
}

impl ParquetInput {
    /// Reads the footer.
    pub fn open(path: &Path, shape: Shape, known: &Known) -> Result<Self, CliError> {
        let file = file::open(path).map_err(unread(path))?;
        let reader = SerializedFileReader::new(file).map_err(|error| damaged(path, error))?;
        let metadata = reader.metadata().file_metadata();
        let columns = metadata.schema_descr().columns();
        let names: Vec<String> = columns.iter().map(|c| c.path().string()).collect();
        let total = u64::try_from(metadata.num_rows()).unwrap_or(0);
        let Found { layout, places, unused } = Layout::find(shape, known, &names)?;
        if !unused.is_empty() {
            eprintln!("not carried through, as only .csv files are: {}", unused.join(", "));
        }
        Ok(Self { path: path.into(), reader, layout, places, total, next: 0, group: None })
    }

    fn damaged(&self) -> impl Fn(ParquetError) -> CliError + '_ {
        |error| damaged(&self.path, error)
    }

    /// Rows in row group `number`; none beyond the last.
    fn rows_in(&self, number: usize) -> Option<usize> {
        let group = self.reader.metadata().row_groups().get(number)?;
        usize::try_from(group.num_rows()).ok()
    }

    /// Opens row group `number` and passes over its first `skip` rows.
    fn enter(&mut self, number: usize, skip: usize) -> Result<(), CliError> {
        let Some(rows) = self.rows_in(number) else {
            return Err(damaged(&self.path, "it ends before its rows do"));
        };
        let group = self.reader.get_row_group(number).map_err(self.damaged())?;
        let column =
            |place: &Option<usize>| place.map(|at| group.get_column_reader(at)).transpose();
        let columns = self.places.iter().map(column);
        let mut columns = columns.collect::<Result<Vec<_>, _>>().map_err(self.damaged())?;
        for column in columns.iter_mut().flatten() {
            let skipped = match column {
                ColumnReader::DoubleColumnReader(reader) => reader.skip_records(skip),
                ColumnReader::FloatColumnReader(reader) => reader.skip_records(skip),
                _ => {
                    let reason = "its columns must be of 64- or 32-bit floats";
                    return Err(damaged(&self.path, reason));
                }
            };
            skipped.map_err(self.damaged())?;
        }
        self.group = Some((columns, number, rows - skip));
        Ok(())
    }
}

/// The next `count` numbers of a column, NaN for null.
fn read_column(column: &mut ColumnReader, count: usize) -> Result<Vec<f64>, ParquetError> {
    let mut levels = Vec::new();
    let (mut wide, mut narrow) = (Vec::new(), Vec::new());
    match column {
        ColumnReader::DoubleColumnReader(reader) => {
            reader.read_records(count, Some(&mut levels), None, &mut wide)?;
        }
        ColumnReader::FloatColumnReader(reader) => {
            reader.read_records(count, Some(&mut levels), None, &mut narrow)?;
            wide.extend(narrow.drain(..).map(f64::from));
        }
        _ => {}
    }
    if levels.is_empty() {
        return Ok(wide);
    }
    let mut present = wide.into_iter();
    let number = |level: i16| if level > 0 { present.next() } else { None };
    Ok(levels.into_iter().map(number).map(|value| value.unwrap_or(f64::NAN)).collect())
}

impl Input for ParquetInput {
    fn layout(&self) -> Layout {
        self.layout
    }

    fn total(&self) -> u64 {
        self.total
    }

    fn seek(&mut self, row: u64, _position: Option<u64>) -> Result<(), CliError> {
        self.next = row;
        self.group = None;
        let mut rest = usize::try_from(row).unwrap_or(usize::MAX);
        let mut number = 0;
        while let Some(rows) = self.rows_in(number) {
            if rest < rows {
                return self.enter(number, rest);
            }
            rest -= rows;
            number += 1;
        }
        Ok(())
    }

    fn position(&self) -> u64 {
        self.next
    }

    fn read(&mut self, count: usize, piece: &mut Piece) -> Result<(), CliError> {
        let rows = &mut piece.rows;
        let width = self.layout.width();
        let mut missing = count;
        while missing > 0 {
            match &self.group {
                None => self.enter(0, 0)?,
                Some((_, number, 0)) => self.enter(number + 1, 0)?,
                Some(_) => {}
            }
            let Some((columns, _, left)) = &mut self.group else { continue };
            let take = missing.min(*left);
            let start = rows.values.len();
            rows.values.resize(start + take * width, f64::NAN);
            for (place, column) in columns.iter_mut().enumerate() {
                let Some(column) = column else {
                    (0..take).for_each(|i| rows.values[start + i * width + place] = 0.0);
                    continue;
                };
                let numbers =
                    read_column(column, take).map_err(|error| damaged(&self.path, error))?;
                for (i, number) in numbers.into_iter().enumerate().take(take) {
                    rows.values[start + i * width + place] = number;
                }
            }
            *left -= take;
            missing -= take;
        }
        self.next += count as u64;
        Ok(())
    }
}
