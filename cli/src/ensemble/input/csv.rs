//! CSV with a header of column names.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use ::csv::{ByteRecord, Position, Reader, ReaderBuilder};
use coadjoint_codegen::diagnostic::check_table;

use super::{Input, damaged};
use crate::ensemble::table::{Piece, Table};
use crate::error::{CliError, unread};
use coadjoint_codegen::file;
use coadjoint_run::ensemble::{Found, Known, Layout, Shape};

/// A CSV file; blanks around cells and lines that begin with # are passed over.
pub struct CsvInput {
    path: PathBuf,
    reader: Reader<BufReader<File>>,
    layout: Layout,
    /// The cell of each number; none for those that are 0.
    places: Vec<Option<usize>>,
    table: Table,
    total: u64,
    /// The number of the next row, from 0.
    next: u64,
    record: ByteRecord,
}

impl CsvInput {
    /// Reads the header and counts the rows.
    pub fn open(path: &Path, shape: Shape, known: &Known) -> Result<Self, CliError> {
        check_table(path).map_err(unread(path))?;
        let mut reader = reader(path)?;
        let header = reader.headers().map_err(|error| damaged(path, error))?;
        let header: Vec<String> = header.iter().map(|name| name.trim().into()).collect();
        let Found { layout, places, .. } = Layout::find(shape, known, &header)?;
        let mut record = ByteRecord::new();
        let mut total = 0;
        let mut counter = self::reader(path)?;
        while counter.read_byte_record(&mut record).map_err(|error| damaged(path, error))? {
            total += 1;
        }
        let table = Table::new(header, &places);
        Ok(Self { path: path.into(), reader, layout, places, table, total, next: 0, record })
    }

    /// Adds the numbers of the current record, or names the cell that is none.
    fn numbers(&self, values: &mut Vec<f64>) -> Result<(), String> {
        let cells = self.table.header.len();
        if self.record.len() != cells {
            return Err(format!("{} cells instead of {cells}", self.record.len()));
        }
        for (&place, column) in self.places.iter().zip(0..) {
            let Some(place) = place else {
                values.push(0.0);
                continue;
            };
            let cell = self.record.get(place).unwrap_or_default().trim_ascii();
            let number = std::str::from_utf8(cell).ok().and_then(|text| text.parse().ok());
            values.push(number.ok_or_else(|| {
                let name = self.layout.names().swap_remove(column);
                format!("{name}: {:?} is no number", String::from_utf8_lossy(cell))
            })?);
        }
        Ok(())
    }
}

fn reader(path: &Path) -> Result<Reader<BufReader<File>>, CliError> {
    let file = file::open(path).map_err(unread(path))?;
    // Not trimmed: cells that are no numbers are carried through as they are.
    // Flexible: a row with too few or too many cells is a bad row, not the end.
    let mut builder = ReaderBuilder::new();
    let builder = builder.comment(Some(b'#')).flexible(true);
    Ok(builder.from_reader(BufReader::with_capacity(1 << 18, file)))
}

impl Input for CsvInput {
    fn layout(&self) -> Layout {
        self.layout
    }

    fn table(&self) -> Option<&Table> {
        Some(&self.table)
    }

    fn total(&self) -> u64 {
        self.total
    }

    fn seek(&mut self, row: u64, position: Option<u64>) -> Result<(), CliError> {
        if let Some(byte) = position {
            let mut at = Position::new();
            at.set_byte(byte);
            self.reader.seek(at).map_err(|error| damaged(&self.path, error))?;
            self.next = row;
        }
        while self.next < row {
            self.reader
                .read_byte_record(&mut self.record)
                .map_err(|error| damaged(&self.path, error))?;
            self.next += 1;
        }
        Ok(())
    }

    fn position(&self) -> u64 {
        self.reader.position().byte()
    }

    fn read(&mut self, count: usize, piece: &mut Piece) -> Result<(), CliError> {
        let rows = &mut piece.rows;
        for _ in 0..count {
            let more = self
                .reader
                .read_byte_record(&mut self.record)
                .map_err(|error| damaged(&self.path, error))?;
            if !more {
                return Err(damaged(&self.path, "it has become shorter while it was read"));
            }
            self.next += 1;
            if self.table.others().next().is_some() {
                let others = self.table.own.iter().enumerate().filter(|(_, own)| own.is_none());
                let cells = others.map(|(cell, _)| self.record.get(cell).unwrap_or_default());
                piece.others.push(cells.collect());
            }
            let length = rows.values.len();
            if let Err(reason) = self.numbers(&mut rows.values) {
                rows.values.truncate(length);
                rows.reject(self.next, self.layout.width(), reason);
            }
        }
        Ok(())
    }
}
