//! Parquet with columns of 64- or 32-bit floats (uncompressed or Snappy).

use std::fs::File;
use std::io::Write;
use std::sync::Arc;

use ::parquet::basic::{Repetition, Type as PhysicalType};
use ::parquet::column::reader::ColumnReader;
use ::parquet::data_type::DoubleType;
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;

/// Rows that are read at a time.
const ROWS: usize = 1024;

/// The rows of a file, row group by row group.
pub(crate) struct Cursor {
    reader: SerializedFileReader<File>,
    /// The columns that hold floats.
    columns: Vec<usize>,
    /// The readers of the current row group, and how many of its rows are unread.
    open: Vec<ColumnReader>,
    left: usize,
    /// The row group after it.
    group: usize,
    /// Rows that are read, one after the other, and the numbers of them that were handed out.
    values: Vec<f64>,
    taken: usize,
}

impl Cursor {
    /// The rows, the names of the columns of floats, and those of others.
    pub(crate) fn open(file: File) -> Result<(Self, Vec<String>, Vec<String>), ParquetError> {
        let reader = SerializedFileReader::new(file)?;
        let (mut columns, mut names, mut others) = (Vec::new(), Vec::new(), Vec::new());
        let schema = reader.metadata().file_metadata().schema_descr();
        for (place, column) in schema.columns().iter().enumerate() {
            let name = column.path().string();
            let floats =
                matches!(column.physical_type(), PhysicalType::DOUBLE | PhysicalType::FLOAT);
            if floats && column.max_rep_level() == 0 {
                columns.push(place);
                names.push(name);
            } else {
                others.push(name);
            }
        }
        let (open, values) = (Vec::new(), Vec::new());
        let source = Self { reader, columns, open, left: 0, group: 0, values, taken: 0 };
        Ok((source, names, others))
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> u64 {
        u64::try_from(self.reader.metadata().file_metadata().num_rows()).unwrap_or(0)
    }

    /// Opens the next row group that reaches beyond `skip` rows, and passes over these.
    fn enter(&mut self, mut skip: usize) -> Result<bool, ParquetError> {
        let rows = loop {
            let groups = self.reader.metadata().row_groups();
            let Some(group) = groups.get(self.group) else { return Ok(false) };
            let rows = usize::try_from(group.num_rows()).unwrap_or(0);
            self.group += 1;
            if rows > skip {
                break rows;
            }
            skip -= rows;
        };
        let group = self.reader.get_row_group(self.group - 1)?;
        let columns = self.columns.iter().map(|&place| group.get_column_reader(place));
        self.open = columns.collect::<Result<_, _>>()?;
        for column in &mut self.open {
            match column {
                ColumnReader::DoubleColumnReader(reader) => drop(reader.skip_records(skip)?),
                ColumnReader::FloatColumnReader(reader) => drop(reader.skip_records(skip)?),
                _ => {}
            }
        }
        self.left = rows - skip;
        Ok(true)
    }

    /// Goes to a row.
    pub(crate) fn seek(&mut self, row: u64) -> Result<(), ParquetError> {
        (self.group, self.left, self.taken) = (0, 0, 0);
        self.values.clear();
        self.enter(usize::try_from(row).unwrap_or(usize::MAX)).map(drop)
    }

    /// Adds the numbers of the next row, if there is one; NaN for null.
    pub(crate) fn read(&mut self, numbers: &mut Vec<f64>) -> Result<bool, ParquetError> {
        let width = self.columns.len();
        if self.taken == self.values.len() {
            if self.left == 0 && !self.enter(0)? {
                return Ok(false);
            }
            let count = self.left.min(ROWS);
            self.left -= count;
            self.taken = 0;
            self.values.clear();
            self.values.resize(count * width, f64::NAN);
            for (place, column) in self.open.iter_mut().enumerate() {
                let own = self.values.iter_mut().skip(place).step_by(width);
                own.zip(read_column(column, count)?).for_each(|(value, read)| *value = read);
            }
        }
        numbers.extend_from_slice(&self.values[self.taken..self.taken + width]);
        self.taken += width;
        Ok(true)
    }
}

/// The next `count` numbers of a column, NaN for null.
fn read_column(column: &mut ColumnReader, count: usize) -> Result<Vec<f64>, ParquetError> {
    let (mut levels, mut wide, mut narrow) = (Vec::new(), Vec::new(), Vec::new());
    match column {
        ColumnReader::DoubleColumnReader(reader) => {
            reader.read_records(count, Some(&mut levels), None, &mut wide)?;
        }
        ColumnReader::FloatColumnReader(reader) => {
            reader.read_records(count, Some(&mut levels), None, &mut narrow)?;
            wide.extend(narrow.into_iter().map(f64::from));
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

/// Writes rows, one after the other in each piece that `next` gives until one is empty, as required columns of 64-bit
/// floats; a row group a piece.
pub fn write_parquet(
    to: impl Write + Send,
    names: &[String],
    mut next: impl FnMut() -> std::io::Result<Vec<f64>>,
) -> Result<(), ParquetError> {
    let column = |name: &String| {
        let column = Type::primitive_type_builder(name, PhysicalType::DOUBLE);
        column.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
    };
    let columns = names.iter().map(column).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("states").with_fields(columns).build()?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(to, Arc::new(schema), properties)?;
    loop {
        let rows = next()?;
        if rows.is_empty() {
            return writer.close().map(drop);
        }
        let mut group = writer.next_row_group()?;
        let mut place = 0;
        while let Some(mut column) = group.next_column()? {
            let values: Vec<f64> = rows.iter().skip(place).step_by(names.len()).copied().collect();
            column.typed::<DoubleType>().write_batch(&values, None, None)?;
            column.close()?;
            place += 1;
        }
        group.close()?;
    }
}
