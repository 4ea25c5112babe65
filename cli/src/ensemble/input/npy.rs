//! NumPy: one matrix of floats, a row per state.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use npyz::{DType, NpyHeader, Order};

use super::{Input, damaged, unread};
use crate::ensemble::layout::{Layout, Shape};
use crate::ensemble::rows::Rows;
use crate::error::CliError;

/// A `.npy` file: n columns of momentum, then the attitude if there is one.
pub struct NpyInput {
    path: PathBuf,
    reader: BufReader<File>,
    layout: Layout,
    total: u64,
    /// Bytes before the first number.
    header: u64,
    /// Bytes of one number: 8 or 4.
    bytes: usize,
    next: u64,
}

impl NpyInput {
    /// Reads the header.
    pub fn open(path: &Path, shape: Shape) -> Result<Self, CliError> {
        let file = File::open(path).map_err(unread(path))?;
        let length = file.metadata().map_err(unread(path))?.len();
        let mut reader = BufReader::with_capacity(1 << 18, file);
        let parsed = NpyHeader::from_reader(&mut reader).map_err(|error| damaged(path, error))?;
        let header = reader.stream_position().map_err(unread(path))?;
        let kind = match parsed.dtype() {
            DType::Plain(kind) => kind.to_string(),
            _ => String::new(),
        };
        let bytes = match kind.as_str() {
            "<f8" => 8,
            "<f4" => 4,
            _ => {
                let reason = "the array must be of little-endian 64- or 32-bit floats (<f8, <f4)";
                return Err(damaged(path, reason));
            }
        };
        let &[total, width] = parsed.shape() else {
            return Err(damaged(path, "the array must have two dimensions: states, columns"));
        };
        if parsed.order() == Order::Fortran && total > 1 && width > 1 {
            return Err(damaged(path, "the array must be in C order (numpy.ascontiguousarray)"));
        }
        let layout = Layout::of_width(shape, usize::try_from(width).unwrap_or(usize::MAX))?;
        let needed = total
            .checked_mul(width)
            .and_then(|numbers| numbers.checked_mul(bytes as u64)?.checked_add(header));
        if needed.is_none_or(|needed| needed > length) {
            return Err(damaged(path, format!("it ends before its {total} rows do")));
        }
        Ok(Self { path: path.into(), reader, layout, total, header, bytes, next: 0 })
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
        let at = self.header + row * (self.layout.width() * self.bytes) as u64;
        self.reader.seek(SeekFrom::Start(at)).map_err(unread(&self.path))?;
        self.next = row;
        Ok(())
    }

    fn position(&self) -> u64 {
        self.next
    }

    fn read(&mut self, count: usize, rows: &mut Rows) -> Result<(), CliError> {
        let mut raw = vec![0; count * self.layout.width() * self.bytes];
        self.reader.read_exact(&mut raw).map_err(unread(&self.path))?;
        let narrow = |b: &[u8; 4]| f64::from(f32::from_le_bytes(*b));
        match self.bytes {
            8 => rows.values.extend(raw.as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b))),
            _ => rows.values.extend(raw.as_chunks::<4>().0.iter().map(narrow)),
        }
        self.next += count as u64;
        Ok(())
    }
}
