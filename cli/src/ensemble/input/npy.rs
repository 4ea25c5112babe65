//! NumPy: one matrix of floats, a row per state.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use coadjoint_learn::NpyHeader;

use super::{Input, damaged};
use crate::ensemble::table::Piece;
use crate::error::{CliError, unread};
use coadjoint_codegen::file;
use coadjoint_run::ensemble::{Layout, Shape};

/// A `.npy` file: n columns of momentum, then the attitude if there is one.
pub struct NpyInput {
    path: PathBuf,
    reader: BufReader<File>,
    layout: Layout,
    total: u64,
    header: NpyHeader,
    next: u64,
}

impl NpyInput {
    /// Reads the header.
    pub fn open(path: &Path, shape: Shape) -> Result<Self, CliError> {
        let file = file::open(path).map_err(unread(path))?;
        let length = file.metadata().map_err(unread(path))?.len();
        let mut reader = BufReader::with_capacity(1 << 18, file);
        let header = NpyHeader::read(&mut reader, length).map_err(|error| damaged(path, error))?;
        let &[total, width] = header.shape.as_slice() else {
            return Err(damaged(path, "the array must have two dimensions: states, columns"));
        };
        if header.fortran && total > 1 && width > 1 {
            return Err(damaged(path, "the array must be in C order (numpy.ascontiguousarray)"));
        }
        let layout = Layout::of_width(shape, width)?;
        Ok(Self { path: path.into(), reader, layout, total: total as u64, header, next: 0 })
    }
}

impl Input for NpyInput {
    fn layout(&self) -> Layout {
        self.layout
    }

    fn total(&self) -> u64 {
        self.total
    }

    fn seek(&mut self, row: u64, _position: Option<u64>) -> Result<(), CliError> {
        let at = self.header.length + row * (self.layout.width() * self.header.width) as u64;
        self.reader.seek(SeekFrom::Start(at)).map_err(unread(&self.path))?;
        self.next = row;
        Ok(())
    }

    fn position(&self) -> u64 {
        self.next
    }

    fn read(&mut self, count: usize, piece: &mut Piece) -> Result<(), CliError> {
        let rows = &mut piece.rows;
        let mut raw = vec![0; count * self.layout.width() * self.header.width];
        self.reader.read_exact(&mut raw).map_err(unread(&self.path))?;
        self.header.decode(&raw, &mut rows.values);
        self.next += count as u64;
        Ok(())
    }
}
