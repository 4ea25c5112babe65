//! Files of states: read piece by piece, and turned into bytes.

use std::path::Path;

use coadjoint_learn::npy_header;
use coadjoint_learn::table::{Row, Table, csv_lines};
use coadjoint_run::ensemble::{Found, Known, Rejected, Rows, Shape};
use rayon::prelude::*;

use crate::error::CliError;

/// Rows turned into text at a time.
const PIECE: usize = 256;

/// The format of a file, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Names, then a line per row, in the shortest decimals that read back as the same numbers.
    Csv,
    /// One matrix of 64-bit floats.
    Npy,
    /// Columns of 64-bit floats; kept as bare numbers until all are there.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Form {
    /// By the ending of the name that `option` gives.
    pub(crate) fn of(path: &Path, option: &str) -> Result<Self, CliError> {
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            _ => Err(CliError::Option(format!(
                "{option} {}: the name must end in .csv or .npy, or in .parquet where the program \
                 was built with the feature `parquet`",
                path.display()
            ))),
        }
    }
}

/// A piece of an ensemble.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    /// The states.
    pub rows: Rows,
    /// The rows as they were read, where cells are carried through.
    cells: Vec<Row>,
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
    times: Option<Vec<f64>>,
}

impl States {
    /// Opens a file; the states at the end, or at these times, are going to be written in this form.
    pub(crate) fn open(
        path: &Path,
        form: Form,
        times: Option<Vec<f64>>,
        shape: Shape,
        known: &Known,
    ) -> Result<Self, CliError> {
        Form::of(path, "--initial")?;
        if form == Form::Csv && times.is_some() {
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
            eprintln!(
                "not carried through, which is done from .csv to .csv alone: {}",
                left.join(", ")
            );
        }
        Ok(Self { table, found, written, form, times })
    }

    /// The number of rows.
    pub(crate) fn count(&self) -> Result<u64, CliError> {
        Ok(self.table.count()?)
    }

    /// Goes to a row, counted from 0; `position` is what [`States::position`] said there, if it is known.
    pub(crate) fn seek(&mut self, row: u64, position: Option<u64>) -> Result<(), CliError> {
        Ok(self.table.seek(row, position)?)
    }

    /// Where the next row begins.
    pub(crate) fn position(&self) -> u64 {
        self.table.position()
    }

    /// Reads the next `count` rows in place of those of a piece.
    pub(crate) fn read(&mut self, count: u64, piece: &mut Piece) -> Result<(), CliError> {
        let (width, layout) = (self.table.width(), &self.found.layout);
        piece.rows.clear(self.table.number() + 1);
        piece.cells.clear();
        let carries = self.written.iter().any(|(_, own)| own.is_none());
        let mut row = Row::default();
        for _ in 0..count {
            if !self.table.read(&mut row)? {
                let path = self.table.path().display();
                let what = format!("{path}: it has become shorter while it was read");
                return Err(CliError::Option(what));
            }
            let mut bad =
                (row.len() != width).then(|| format!("{} cells instead of {width}", row.len()));
            for (column, place) in self.found.places.iter().enumerate() {
                let number = place.map_or(Ok(0.0), |place| row.number(place));
                piece.rows.values.push(number.unwrap_or_else(|text| {
                    let name = || layout.names().swap_remove(column);
                    bad.get_or_insert_with(|| format!("{}: {text:?} is no number", name()));
                    f64::NAN
                }));
            }
            if let Some(reason) = bad {
                piece.rows.rejected.push(Rejected { row: self.table.number(), step: 0, reason });
            }
            if carries {
                piece.cells.push(row.clone());
            }
        }
        Ok(())
    }

    /// The bytes before the first of `count` rows that are written.
    pub(crate) fn header(&self, count: u64) -> Vec<u8> {
        match self.form {
            Form::Csv => csv_lines([self.written.iter().map(|(name, _)| name)]),
            Form::Npy => {
                let times = self.times.iter().map(|times| times.len() as u64);
                let width = self.found.layout.width() as u64;
                npy_header(&[count].into_iter().chain(times).chain([width]).collect::<Vec<_>>())
            }
            #[cfg(feature = "parquet")]
            Form::Parquet => Vec::new(),
        }
    }

    /// The bytes of rows.
    pub(crate) fn encode(&self, piece: &Piece) -> Vec<u8> {
        // Tables are not shared between threads.
        let (written, width) = (&self.written, self.found.layout.width());
        if let (false, Some(times)) = (matches!(self.form, Form::Csv | Form::Npy), &self.times) {
            let states = piece.rows.values.chunks(width).enumerate();
            let numbers = states.flat_map(|(place, state)| {
                let row = (piece.rows.first + (place / times.len()) as u64) as f64;
                [row, times[place % times.len()]].into_iter().chain(state.iter().copied())
            });
            return numbers.flat_map(f64::to_le_bytes).collect();
        }
        if self.form != Form::Csv {
            return piece.rows.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        }
        // Pieces of fixed size, joined in order: the same bytes whatever the threads.
        let pieces = piece.rows.values.par_chunks(PIECE * width).enumerate();
        let pieces = pieces.map(|(number, values)| {
            csv_lines(values.chunks(width).enumerate().map(|(place, row)| {
                let cells = piece.cells.get(number * PIECE + place);
                written.iter().enumerate().map(move |(cell, (_, own))| match own {
                    Some(column) => row[*column].to_string().into_bytes(),
                    None => cells.map_or_else(Vec::new, |cells| cells.cell(cell).to_vec()),
                })
            }))
        });
        pieces.collect::<Vec<_>>().concat()
    }

    /// Makes the file that is to be there of the one that has the rows' bytes, where these are two.
    #[cfg(feature = "parquet")]
    pub fn convert(
        &self,
        from: &Path,
        to: &mut coadjoint_codegen::file::Output,
    ) -> std::io::Result<()> {
        use std::io::Read;
        /// Rows of a row group.
        const GROUP: usize = 1 << 17;
        let places = self.times.iter().flat_map(|_| ["row".to_owned(), "time".to_owned()]);
        let names: Vec<String> = places.chain(self.found.layout.names()).collect();
        let mut source = std::io::BufReader::new(std::fs::File::open(from)?);
        to.begin(&[])?;
        let next = || {
            let mut raw = Vec::new();
            source.by_ref().take((GROUP * names.len() * 8) as u64).read_to_end(&mut raw)?;
            Ok(raw.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
        };
        coadjoint_learn::table::write_parquet(&mut *to, &names, next)
            .map_err(std::io::Error::other)?;
        to.sync()
    }
}
