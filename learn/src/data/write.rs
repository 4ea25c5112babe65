//! Writing pairs of phase points, in the columns the reader looks for.

use std::io::{Cursor, Write};
use std::path::Path;

use coadjoint_codegen::file;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::columns::Columns;
use super::npy::{matrix, numbered};
use super::reduce::PhasePair;
use crate::error::LearnError;
use crate::function::entries;
use crate::group::matrix_of;
use crate::npy::npy_header;
use crate::table::csv_lines;
use coadjoint::LieGroup;

/// Writes pairs as columns `mu_…`, `mu_next_…`, `g_…`, `g_next_…`, in the format of the ending:
/// `.csv`, `.npz`, or `.parquet` (feature `parquet`). The numbers read back are the same.
///
/// # Errors
/// [`LearnError::UnknownFormat`] for another ending, [`LearnError::File`] or
/// [`LearnError::Format`] when the file cannot be written.
pub fn write_pairs<G: LieGroup<Scalar = f64>>(
    path: &Path,
    group: &G,
    pairs: &[PhasePair<G>],
) -> Result<(), LearnError> {
    let (dim, size) = (group.dim(), group.matrix_size());
    let names =
        [numbered("mu", dim), numbered("mu_next", dim), matrix("g", size), matrix("g_next", size)]
            .concat();
    let mut values = vec![Vec::with_capacity(pairs.len()); names.len()];
    for pair in pairs {
        let mut row = entries(&pair.before.momentum);
        row.extend(entries(&pair.after.momentum));
        for phase in [&pair.before, &pair.after] {
            let g = matrix_of(group, &phase.group_element);
            row.extend(g.transpose().iter());
        }
        values.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }
    let columns = Columns::new(names.into_iter().zip(values))?;
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let bytes = match ending.as_deref() {
        Some("csv") => csv(&columns),
        Some("npz") => npz(&columns).map_err(|error| LearnError::format(path, "NumPy", error))?,
        #[cfg(feature = "parquet")]
        Some("parquet") => {
            parquet(&columns).map_err(|error| LearnError::format(path, "Parquet", error))?
        }
        _ => return Err(LearnError::UnknownFormat(path.into())),
    };
    file::write(path, &[], &bytes).map_err(LearnError::file(path))
}

/// In the shortest decimal form that reads back to the same number.
fn csv(columns: &Columns) -> Vec<u8> {
    let cells = |row: usize| columns.values().iter().map(move |column| column[row].to_string());
    [csv_lines([columns.names()]), csv_lines((0..columns.rows()).map(cells))].concat()
}

#[cfg(feature = "parquet")]
fn parquet(columns: &Columns) -> Result<Vec<u8>, parquet::errors::ParquetError> {
    let rows = (0..columns.rows()).flat_map(|row| columns.values().iter().map(move |c| c[row]));
    let (mut bytes, mut rows) = (Vec::new(), Some(rows.collect()));
    let next = || Ok(rows.take().unwrap_or_default());
    crate::table::write_parquet(&mut bytes, columns.names(), next)?;
    Ok(bytes)
}

/// An array of shape (N,) per column, not compressed, as `numpy.savez` writes them.
fn npz(columns: &Columns) -> zip::result::ZipResult<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let rows = columns.rows() as u64;
    for (name, column) in columns.names().iter().zip(columns.values()) {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(rows > u64::from(u32::MAX) / 16);
        archive.start_file(format!("{name}.npy"), options)?;
        archive.write_all(&npy_header(&[rows]))?;
        for value in column {
            archive.write_all(&value.to_le_bytes())?;
        }
    }
    Ok(archive.finish()?.into_inner())
}
