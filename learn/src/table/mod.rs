//! Tables of numbers in files of every format, read row by row and written in pieces.

mod npy;
#[cfg(feature = "parquet")]
mod parquet;

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use ::csv::{ByteRecord, Position, Reader, ReaderBuilder, WriterBuilder};
use coadjoint_codegen::diagnostic::{check_table, read_text};
use coadjoint_codegen::file;
use serde_json::Value;

pub use self::npy::npy_header;
pub(crate) use self::npy::{matrix, numbered, quaternion};
#[cfg(feature = "parquet")]
pub use self::parquet::write_parquet;

use self::npy::{NpyHeader, npz_columns, row_major};
use crate::error::LearnError;

/// Bytes that are read at a time.
const PIECE: usize = 1 << 18;

/// A file of rows of numbers: `.npy`, `.npz`, `.parquet` (feature `parquet`), or CSV under any other name.
pub struct Table {
    path: PathBuf,
    source: Source,
    names: Vec<String>,
    width: usize,
    /// The number of the next row, from 0.
    next: u64,
    /// The entries that a file beside a matrix, or the maker of the rows, gives for them.
    head: BTreeMap<String, String>,
    /// Columns of a Parquet file that hold no floats.
    others: Vec<String>,
}

enum Source {
    Csv(Box<Reader<Remarks<File>>>),
    Npy(BufReader<File>, NpyHeader),
    Memory(Vec<f64>),
    #[cfg(feature = "parquet")]
    Parquet(Box<self::parquet::Cursor>),
}

/// A row as it was read.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// The cells, where they are text.
    record: ByteRecord,
    numbers: Vec<f64>,
}

impl Cells {
    /// The number of cells; a row of CSV may have too few or too many.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.record.len().max(self.numbers.len())
    }

    /// The number in a column.
    ///
    /// # Errors
    /// The text of a cell that is not a number.
    pub fn number(&self, column: usize) -> Result<f64, String> {
        if let Some(number) = self.numbers.get(column) {
            return Ok(*number);
        }
        let cell = self.record.get(column).unwrap_or_default().trim_ascii();
        let number = std::str::from_utf8(cell).ok().and_then(|text| text.parse().ok());
        number.ok_or_else(|| String::from_utf8_lossy(cell).into_owned())
    }

    /// The numbers in all columns; NaN for other cells.
    pub fn numbers(&self) -> Vec<f64> {
        (0..self.len()).map(|column| self.number(column).unwrap_or(f64::NAN)).collect()
    }

    /// The text of a cell as it stands in CSV; empty in other formats.
    pub fn cell(&self, column: usize) -> &[u8] {
        self.record.get(column).unwrap_or_default()
    }
}

fn in_csv(path: &Path) -> impl Fn(::csv::Error) -> LearnError + '_ {
    |error| LearnError::format(path, "CSV", error)
}

/// Cells are not trimmed, and rows may have any number of them.
fn csv_reader(path: &Path) -> Result<Reader<Remarks<File>>, LearnError> {
    let file = file::open(path).map_err(LearnError::file(path))?;
    let mut builder = ReaderBuilder::new();
    let builder = builder.comment(Some(b'#')).flexible(true).buffer_capacity(PIECE);
    Ok(builder.from_reader(Remarks::new(file)))
}

impl Table {
    /// Opens a file in the format that the ending of its name gives; a further ending `.partial` is ignored.
    ///
    /// # Errors
    /// Fails if the file cannot be read or is not in that format.
    pub fn open(path: &Path) -> Result<Self, LearnError> {
        let name = path.to_string_lossy().to_ascii_lowercase();
        match name.trim_end_matches(".partial").rsplit_once('.').map_or("", |(_, ending)| ending) {
            "npy" => Self::npy(path),
            "npz" => {
                let file = file::open_whole(path).map_err(LearnError::file(path))?;
                Self::of_columns(path, npz_columns(path, file)?)
            }
            #[cfg(feature = "parquet")]
            "parquet" => Self::parquet(path),
            #[cfg(not(feature = "parquet"))]
            "parquet" => {
                let what =
                    "this program was built without the feature `parquet`: write .csv or .npy";
                Err(LearnError::format(path, "Parquet", what))
            }
            _ => Self::csv(path),
        }
    }

    /// Rows in memory, one after the other, whose columns have these names, or none.
    pub fn of_rows(path: &Path, names: Vec<String>, width: usize, rows: Vec<f64>) -> Self {
        Self::new(path, Source::Memory(rows), width, names)
    }

    /// Named columns in memory.
    ///
    /// # Errors
    /// [`LearnError::Shape`] where they differ in length.
    pub fn of_columns(path: &Path, columns: Vec<(String, Vec<f64>)>) -> Result<Self, LearnError> {
        let expected = columns.first().map_or(0, |(_, column)| column.len());
        if let Some((name, column)) = columns.iter().find(|(_, own)| own.len() != expected) {
            let (what, found) = (format!("column {name}"), column.len());
            return Err(LearnError::Shape { what, expected, found });
        }
        let row = |row: usize| columns.iter().map(move |(_, column)| column[row]);
        let rows = (0..expected).flat_map(row).collect();
        let width = columns.len();
        Ok(Self::of_rows(path, columns.into_iter().map(|(name, _)| name).collect(), width, rows))
    }

    /// Sets what the table says about itself.
    pub fn saying(self, head: BTreeMap<String, String>) -> Self {
        Self { head, ..self }
    }

    fn new(path: &Path, source: Source, width: usize, names: Vec<String>) -> Self {
        let (head, others) = (BTreeMap::new(), Vec::new());
        Self { path: path.into(), source, names, width, next: 0, head, others }
    }

    fn csv(path: &Path) -> Result<Self, LearnError> {
        check_table(path).map_err(LearnError::file(path))?;
        let mut reader = csv_reader(path)?;
        let damaged = |what: &dyn std::fmt::Display| LearnError::format(path, "CSV", what);
        let names = reader.headers().map_err(|error| damaged(&error))?;
        let names: Vec<String> = names.iter().map(|name| name.trim().to_owned()).collect();
        if names.is_empty() {
            return Err(damaged(&"the file has no line with names of columns"));
        }
        if names.iter().all(|name| name.parse::<f64>().is_ok()) {
            let what = "the first line holds numbers; it must name the columns: mu_1, mu_2 …";
            return Err(damaged(&what));
        }
        Ok(Self::new(path, Source::Csv(Box::new(reader)), names.len(), names))
    }

    /// NumPy's header, and the JSON file beside the matrix, if there is one.
    fn npy(path: &Path) -> Result<Self, LearnError> {
        let file = file::open(path).map_err(LearnError::file(path))?;
        let length = file.metadata().map_err(LearnError::file(path))?.len();
        let mut reader = BufReader::with_capacity(PIECE, file);
        let damaged = |what: &dyn std::fmt::Display| LearnError::format(path, "NumPy", what);
        let header = NpyHeader::read(&mut reader, length).map_err(|error| damaged(&error))?;
        let &[rows, width] = header.shape.as_slice() else {
            return Err(damaged(&"the array must have two dimensions: states, columns"));
        };
        let source = if header.fortran && rows > 1 && width > 1 {
            let (bytes, mut values) =
                (file::read(path).map_err(LearnError::file(path))?, Vec::new());
            header.decode(bytes.get(header.length as usize..).unwrap_or_default(), &mut values);
            values.resize(header.count, f64::NAN);
            Source::Memory(row_major(&header.shape, &values))
        } else {
            Source::Npy(reader, header)
        };
        let mut table = Self::new(path, source, width, Vec::new());
        let beside = read_text(&file::beside(path, ".json")).ok();
        let beside = beside.and_then(|text| serde_json::from_str::<Value>(&text).ok());
        for (name, value) in beside.as_ref().and_then(Value::as_object).into_iter().flatten() {
            match value {
                Value::Array(list) if name == "columns" && list.len() == width => {
                    table.names = list.iter().map(remark).collect();
                }
                value => drop(table.head.insert(name.clone(), remark(value))),
            }
        }
        Ok(table)
    }

    #[cfg(feature = "parquet")]
    fn parquet(path: &Path) -> Result<Self, LearnError> {
        let file = file::open(path).map_err(LearnError::file(path))?;
        let opened = self::parquet::Cursor::open(file);
        let (source, names, others) =
            opened.map_err(|error| LearnError::format(path, "Parquet", error))?;
        let source = Source::Parquet(Box::new(source));
        Ok(Self { others, ..Self::new(path, source, names.len(), names) })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The names of the columns; none where the file has none.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The names of columns of a Parquet file that hold no floats; they are not read.
    pub fn others(&self) -> &[String] {
        &self.others
    }

    /// True if rows are text, whose cells can be kept as they are.
    pub fn is_text(&self) -> bool {
        matches!(self.source, Source::Csv(_))
    }

    /// The entry of this name: in CSV a line `# name: value` among those read so far.
    pub fn value(&self, name: &str) -> Option<&str> {
        let head = match &self.source {
            Source::Csv(reader) => &reader.get_ref().head,
            _ => &self.head,
        };
        head.get(name).map(String::as_str)
    }

    /// The numbers that the file says under this name.
    pub fn values(&self, name: &str) -> Option<Vec<f64>> {
        self.value(name)?.split(',').map(|number| number.trim().parse().ok()).collect()
    }

    /// The number of rows; those of CSV are counted.
    ///
    /// # Errors
    /// Fails if the file cannot be read.
    pub fn count(&self) -> Result<u64, LearnError> {
        Ok(match &self.source {
            Source::Npy(_, header) => header.shape[0] as u64,
            Source::Memory(rows) => (rows.len() / self.width.max(1)) as u64,
            #[cfg(feature = "parquet")]
            Source::Parquet(source) => source.rows(),
            Source::Csv(_) => {
                let (mut reader, mut record) = (csv_reader(&self.path)?, ByteRecord::new());
                let mut rows = 0;
                while reader.read_byte_record(&mut record).map_err(in_csv(&self.path))? {
                    rows += 1;
                }
                rows
            }
        })
    }

    /// The position of the next row in the file, for [`Table::seek`].
    pub fn position(&self) -> u64 {
        match &self.source {
            Source::Csv(reader) => reader.position().byte(),
            _ => self.next,
        }
    }

    /// Goes to a row, counted from 0; `position` is what [`Table::position`] returned there, if that is known.
    ///
    /// # Errors
    /// Fails if the file cannot be read.
    pub fn seek(&mut self, row: u64, position: Option<u64>) -> Result<(), LearnError> {
        match &mut self.source {
            Source::Csv(reader) => {
                if let Some(byte) = position {
                    let mut at = Position::new();
                    at.set_byte(byte);
                    reader.seek(at).map_err(in_csv(&self.path))?;
                    self.next = row;
                }
                let mut record = ByteRecord::new();
                while self.next < row
                    && reader.read_byte_record(&mut record).map_err(in_csv(&self.path))?
                {
                    self.next += 1;
                }
            }
            Source::Npy(reader, header) => {
                let at = header.length + row * (self.width * header.width) as u64;
                reader.seek(SeekFrom::Start(at)).map_err(LearnError::file(&self.path))?;
            }
            Source::Memory(_) => {}
            #[cfg(feature = "parquet")]
            Source::Parquet(source) => {
                source
                    .seek(row)
                    .map_err(|error| LearnError::format(&self.path, "Parquet", error))?;
            }
        }
        self.next = row;
        Ok(())
    }

    /// Reads the next row; returns false at the end.
    ///
    /// # Errors
    /// Fails if the file cannot be read.
    pub fn read(&mut self, row: &mut Cells) -> Result<bool, LearnError> {
        let Self { path, source, width, next, .. } = self;
        row.numbers.clear();
        let more = match source {
            Source::Csv(reader) => {
                let read = reader.read_byte_record(&mut row.record);
                read.map_err(in_csv(path))?
            }
            Source::Npy(reader, header) => {
                let more = (*next as usize) < header.shape[0];
                if more {
                    let taken = header.take(reader, *width, &mut row.numbers);
                    taken.map_err(LearnError::file(path))?;
                }
                more
            }
            Source::Memory(rows) => {
                let own = rows.chunks_exact((*width).max(1)).nth(*next as usize);
                row.numbers.extend_from_slice(own.unwrap_or_default());
                own.is_some()
            }
            #[cfg(feature = "parquet")]
            Source::Parquet(source) => {
                let read = source.read(&mut row.numbers);
                read.map_err(|error| LearnError::format(path, "Parquet", error))?
            }
        };
        *next += u64::from(more);
        Ok(more)
    }

    /// Adds the numbers of up to `count` next rows, NaN for cells that are none; returns the number of rows.
    ///
    /// # Errors
    /// As [`Table::read`].
    pub fn take(&mut self, count: u64, numbers: &mut Vec<f64>) -> Result<u64, LearnError> {
        if let Source::Npy(reader, header) = &mut self.source {
            let rows = count.min((header.shape[0] as u64).saturating_sub(self.next));
            let taken = header.take(reader, rows as usize * self.width, numbers);
            taken.map_err(LearnError::file(&self.path))?;
            self.next += rows;
            return Ok(rows);
        }
        let (mut row, mut rows) = (Cells::default(), 0);
        while rows < count && self.read(&mut row)? {
            numbers.extend((0..self.width).map(|column| row.number(column).unwrap_or(f64::NAN)));
            rows += 1;
        }
        Ok(rows)
    }

    /// The number of the row read last, from 1.
    pub fn number(&self) -> u64 {
        self.next
    }
}

/// The shape and the numbers, row by row, of an array in a file: of any shape in `.npy`, of rows in other formats.
///
/// # Errors
/// Fails if the file cannot be read or is not in the format of its ending.
pub fn array(path: &Path) -> Result<(Vec<usize>, Vec<f64>), LearnError> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy")) {
        let bytes = file::read(path).map_err(LearnError::file(path))?;
        let damaged = |error| LearnError::format(path, "NumPy", error);
        let header = NpyHeader::read(&mut &bytes[..], bytes.len() as u64).map_err(damaged)?;
        let mut numbers = Vec::new();
        header.decode(bytes.get(header.length as usize..).unwrap_or_default(), &mut numbers);
        numbers.truncate(header.count);
        let turned = header.fortran && header.shape.len() > 1;
        let numbers = if turned { row_major(&header.shape, &numbers) } else { numbers };
        return Ok((header.shape, numbers));
    }
    let (mut table, mut numbers) = (Table::open(path)?, Vec::new());
    table.take(u64::MAX, &mut numbers)?;
    let width = table.width();
    Ok((vec![numbers.len() / width.max(1), width], numbers))
}

/// Lines of CSV; cells are in quotes where they would be read as something else without.
pub fn csv_lines<R>(rows: impl IntoIterator<Item = R>) -> Vec<u8>
where
    R: IntoIterator<Item: AsRef<[u8]>>,
{
    let mut writer = WriterBuilder::new().comment(Some(b'#')).from_writer(Vec::new());
    // Writing into memory cannot fail.
    rows.into_iter().for_each(|row| drop(writer.write_record(row)));
    writer.into_inner().unwrap_or_default()
}

/// A value of JSON as a line `# name: value` has it.
pub fn remark(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(list) => list.iter().map(remark).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}

/// Passes bytes on, and takes note of the lines `# name: value` among them.
struct Remarks<R> {
    inner: R,
    /// The values by their names.
    head: BTreeMap<String, String>,
    /// The part of the current line that has been read, where it begins with `#`.
    line: Option<Vec<u8>>,
    /// True if the next byte begins a line.
    fresh: bool,
}

impl<R> Remarks<R> {
    /// Reads on from the beginning of a line.
    fn new(inner: R) -> Self {
        Self { inner, head: BTreeMap::new(), line: None, fresh: true }
    }

    fn end_line(&mut self) {
        let Some(line) = self.line.take() else { return };
        let line = String::from_utf8_lossy(&line);
        if let Some((name, value)) = line.trim_start_matches('#').split_once(':') {
            self.head.insert(name.trim().to_owned(), value.trim().to_owned());
        }
    }
}

impl<R: Read> Read for Remarks<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let mut count = self.inner.read(buffer)?;
        // A remark at the very end is taken for a row where its line does not end.
        if count == 0 && !self.fresh && !buffer.is_empty() {
            (buffer[0], count) = (b'\n', 1);
        }
        for part in buffer[..count].split_inclusive(|byte| *byte == b'\n') {
            if self.fresh && part[0] == b'#' {
                self.line = Some(Vec::new());
            }
            if let Some(line) = &mut self.line {
                line.extend_from_slice(part);
            }
            self.fresh = part.ends_with(b"\n");
            if self.fresh {
                self.end_line();
            }
        }
        Ok(count)
    }
}

impl<R: Seek> Seek for Remarks<R> {
    /// Seeks the beginning of a line.
    fn seek(&mut self, position: SeekFrom) -> std::io::Result<u64> {
        (self.line, self.fresh) = (None, true);
        self.inner.seek(position)
    }
}
