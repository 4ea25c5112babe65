//! Files of states: read piece by piece, and turned into bytes.

use std::path::Path;

use coadjoint_learn::table::{Cells, Table, csv_lines};
use coadjoint_run::ensemble::{Found, Known, Rejected, Rows, Shape};
use coadjoint_run::number::shortest;
use rayon::prelude::*;

use crate::error::CliError;
use crate::form::Form;

/// Rows turned into text at a time.
const PIECE: usize = 256;

/// Numbers turned into bytes at a time, which stay near the processor.
const NEAR: usize = 1 << 14;

/// A piece of an ensemble.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    /// The states.
    pub rows: Rows,
    /// The rows as they were read, where cells are carried through.
    cells: Vec<Cells>,
}

/// A file of states, read forwards.
pub(crate) struct States {
    table: Table,
    /// The columns of states.
    pub found: Found,
    /// The cells written: for each its name and the state's number in it, or none where it is carried through.
    written: Vec<(String, Option<usize>)>,
    form: Form,
    /// The times of trajectories, where these are written.
    pub times: Option<Vec<f64>>,
}

impl States {
    /// Opens a file; the states at the end, or trajectories, are going to be written in this form.
    pub(crate) fn open(
        path: &Path,
        form: Form,
        trajectories: bool,
        shape: Shape,
        known: &Known,
    ) -> Result<Self, CliError> {
        Form::of(path, "--initial")?;
        if form == Form::Csv && trajectories {
            let what = "--at: trajectories have rows, times and columns, which --out takes as .npy or .parquet";
            return Err(CliError::Option(what.to_owned()));
        }
        let table = Table::open(path)?;
        let found = Found::of(shape, known, table.names(), table.width())?;
        let carried = form == Form::Csv && table.is_text();
        let written = if carried {
            let own = |cell| found.places.iter().position(|&place| place == Some(cell));
            let names = table.names().iter().cloned().enumerate();
            names.map(|(cell, name)| (name, own(cell))).collect()
        } else {
            found.layout.names().into_iter().zip((0..).map(Some)).collect()
        };
        let left: Vec<&str> =
            found.unused.iter().chain(table.others()).map(String::as_str).collect();
        if !carried && !left.is_empty() {
            errln!(
                "not carried through, which is done from .csv to .csv alone: {}",
                left.join(", ")
            );
        }
        Ok(Self { table, found, written, form, times: None })
    }

    /// The number of rows.
    pub(crate) fn count(&self) -> Result<u64, CliError> {
        Ok(self.table.count()?)
    }

    /// Goes to a row, counted from 0; `position` is what [`States::position`] said there, if it is known.
    pub(crate) fn seek(&mut self, row: u64, position: Option<u64>) -> Result<(), CliError> {
        Ok(self.table.seek(row, position)?)
    }

    /// The position of the next row.
    pub(crate) fn position(&self) -> u64 {
        self.table.position()
    }

    /// Reads the next `count` rows in place of those of a piece.
    pub(crate) fn read(&mut self, count: u64, piece: &mut Piece) -> Result<(), CliError> {
        let (width, layout) = (self.table.width(), &self.found.layout);
        let Piece { rows, cells } = piece;
        rows.clear(self.table.number() + 1);
        cells.clear();
        let places = &self.found.places;
        let read = if self.table.is_text() {
            let carries = self.written.iter().any(|(_, own)| own.is_none());
            let (mut row, mut read) = (Cells::default(), 0);
            while read < count && self.table.read(&mut row)? {
                read += 1;
                let mut bad =
                    (row.len() != width).then(|| format!("{} cells instead of {width}", row.len()));
                for (column, place) in places.iter().enumerate() {
                    let number = place.map_or(Ok(0.0), |place| row.number(place));
                    rows.values.push(number.unwrap_or_else(|text| {
                        let name = || layout.names().swap_remove(column);
                        bad.get_or_insert_with(|| format!("{}: {text:?} is no number", name()));
                        f64::NAN
                    }));
                }
                if let Some(reason) = bad {
                    rows.rejected.push(Rejected { row: self.table.number(), step: 0, reason });
                }
                if carries {
                    cells.push(row.clone());
                }
            }
            read
        } else if places.iter().copied().eq((0..width).map(Some)) {
            self.table.take(count, &mut rows.values)?
        } else {
            let mut numbers = Vec::new();
            let read = self.table.take(count, &mut numbers)?;
            for row in numbers.chunks(width) {
                rows.values.extend(places.iter().map(|place| place.map_or(0.0, |at| row[at])));
            }
            read
        };
        if read < count {
            let path = self.table.path().display();
            let what = format!("{path}: it has become shorter while it was read");
            return Err(CliError::Option(what));
        }
        Ok(())
    }

    /// The bytes before the first of `count` rows that are written.
    pub(crate) fn header(&self, count: u64) -> Vec<u8> {
        let names: Vec<String> = self.written.iter().map(|(name, _)| name.clone()).collect();
        let times = self.times.iter().map(|times| times.len() as u64);
        let width = self.found.layout.width() as u64;
        let shape: Vec<u64> = [count].into_iter().chain(times).chain([width]).collect();
        self.form.head(&names, &shape)
    }

    /// The names of the columns of numbers, in files that name them.
    pub(crate) fn names(&self) -> Vec<String> {
        let places = self.times.iter().flat_map(|_| ["row".to_owned(), "time".to_owned()]);
        places.chain(self.found.layout.names()).collect()
    }

    /// Gives the bytes of rows to `write`, some at a time.
    ///
    /// # Errors
    /// Passes on those of `write`.
    pub(crate) fn encode(
        &self,
        piece: &Piece,
        mut write: impl FnMut(&[u8]) -> Result<(), CliError>,
    ) -> Result<(), CliError> {
        let (form, width, values) = (self.form, self.found.layout.width(), &piece.rows.values);
        // Tables are not shared between threads.
        let written = &self.written;
        let mut bytes = Vec::new();
        match &self.times {
            Some(times) if form != Form::Npy => {
                let states = values.chunks(width).enumerate();
                let numbers = states.flat_map(|(place, state)| {
                    let row = (piece.rows.first + (place / times.len()) as u64) as f64;
                    [row, times[place % times.len()]].into_iter().chain(state.iter().copied())
                });
                form.append(&numbers.collect::<Vec<_>>(), width + 2, &mut bytes);
                write(&bytes)
            }
            _ if form != Form::Csv => values.chunks(NEAR).try_for_each(|values| {
                bytes.clear();
                form.append(values, width, &mut bytes);
                write(&bytes)
            }),
            // Pieces of fixed size, joined in order: the same bytes whatever the threads.
            _ => {
                let pieces = values.par_chunks(PIECE * width).enumerate();
                let pieces = pieces.map(|(number, values)| {
                    let cells = piece.cells.get(number * PIECE..).unwrap_or(&[]);
                    lines(written, values.chunks(width), cells)
                });
                write(&pieces.collect::<Vec<_>>().concat())
            }
        }
    }
}

/// Lines of rows, with the cells that are carried through between their numbers.
fn lines<'a>(
    written: &[(String, Option<usize>)],
    rows: impl Iterator<Item = &'a [f64]>,
    cells: &[Cells],
) -> Vec<u8> {
    csv_lines(rows.enumerate().map(|(place, row)| {
        written.iter().enumerate().map(move |(cell, (_, own))| match own {
            Some(column) => shortest(row[*column]).into_bytes(),
            None => cells.get(place).map_or_else(Vec::new, |cells| cells.cell(cell).to_vec()),
        })
    }))
}
