//! The text of end states, in the format of the file.

use std::io::Write;
use std::path::Path;

use rayon::prelude::*;

use coadjoint_learn::npy_header;

use super::table::{Piece, Table};
use crate::error::CliError;
use coadjoint_run::ensemble::Layout;

/// Rows turned into text at a time.
const PIECE: usize = 256;

/// The format of the file, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Names, then a line per row, in the shortest decimals that read back as the same numbers.
    Csv,
    /// One matrix of 64-bit floats.
    Npy,
    /// Columns of 64-bit floats; kept as bare numbers until all are there.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Form {
    /// By the ending of the name.
    pub fn of(path: &Path) -> Result<Self, CliError> {
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            _ => Err(CliError::Option(format!(
                "--out {}: the name must end in .csv or .npy, or in .parquet where the program \
                 was built with the feature `parquet`",
                path.display()
            ))),
        }
    }

    /// The bytes before the first of `count` rows.
    pub fn header(self, layout: &Layout, table: Option<&Table>, count: u64) -> Vec<u8> {
        match self {
            Self::Csv => {
                let names = table.map_or_else(|| layout.names(), |table| table.header.clone());
                let mut line = Vec::new();
                for (column, name) in names.iter().enumerate() {
                    if column > 0 {
                        line.push(b',');
                    }
                    push_cell(&mut line, name.as_bytes());
                }
                line.push(b'\n');
                line
            }
            Self::Npy => npy_header(&[count, layout.width() as u64]),
            #[cfg(feature = "parquet")]
            Self::Parquet => Vec::new(),
        }
    }

    /// The bytes of the rows; in CSV, in the order of the `table`'s columns.
    pub fn encode(self, layout: &Layout, table: Option<&Table>, read: &Piece) -> Vec<u8> {
        if self != Self::Csv {
            return read.rows.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        }
        let width = layout.width();
        // Pieces of fixed size, joined in order: the same bytes whatever the threads.
        let own: Vec<Option<usize>> =
            table.map_or_else(|| (0..width).map(Some).collect(), |table| table.own.clone());
        let pieces =
            read.rows.values.par_chunks(PIECE * width).enumerate().map(|(number, piece)| {
                let mut text = Vec::with_capacity(piece.len() * 20);
                for (place, row) in piece.chunks(width).enumerate() {
                    let mut others = read.others.get(number * PIECE + place).into_iter().flatten();
                    for (cell, own) in own.iter().enumerate() {
                        if cell > 0 {
                            text.push(b',');
                        }
                        match own {
                            // Writing into memory cannot fail.
                            Some(column) => drop(write!(text, "{}", row[*column])),
                            None => push_cell(&mut text, others.next().unwrap_or_default()),
                        }
                    }
                    text.push(b'\n');
                }
                text
            });
        pieces.collect::<Vec<_>>().concat()
    }
}

/// Adds a cell, in quotes where it would be read as something else without.
fn push_cell(text: &mut Vec<u8>, cell: &[u8]) {
    if !cell.iter().any(|byte| matches!(byte, b',' | b'"' | b'\r' | b'\n' | b'#')) {
        return text.extend(cell);
    }
    text.push(b'"');
    for &byte in cell {
        if byte == b'"' {
            text.push(b'"');
        }
        text.push(byte);
    }
    text.push(b'"');
}
