//! NumPy files: `.npz` with named arrays, and the names of the columns of a plain matrix.

use std::io::{BufReader, Read};
use std::path::Path;

use coadjoint_codegen::file;
use zip::ZipArchive;

use super::columns::Columns;
use crate::error::LearnError;
use crate::npy::{NpyHeader, row_major};

/// An array of any shape, row-major.
struct Array {
    shape: Vec<usize>,
    values: Vec<f64>,
}

impl Array {
    /// Its columns, one for each name.
    fn columns(&self, names: Vec<String>) -> impl Iterator<Item = (String, Vec<f64>)> {
        let width = names.len();
        let column = move |c: usize| self.values.iter().skip(c).step_by(width).copied().collect();
        names.into_iter().enumerate().map(move |(c, name)| (name, column(c)))
    }
}

/// Reads a `.npz` file. An array of shape (N,) is the column of its name; an array `mu` of shape
/// (N, n) is the columns `mu_1` … `mu_n`; an array `g` of shape (N, d, d) is `g_11` … `g_dd`; an
/// array `q` of shape (N, 4) is `q_w`, `q_x`, `q_y`, `q_z`. The same with `_next`.
pub(super) fn read_npz(path: &Path) -> Result<Columns, LearnError> {
    let file = file::open_whole(path).map_err(LearnError::file(path))?;
    let mut archive =
        ZipArchive::new(BufReader::new(file)).map_err(|e| LearnError::format(path, "NumPy", e))?;
    let mut names = Vec::new();
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|e| LearnError::format(path, "NumPy", e))?;
        let name = String::from_utf8_lossy(entry.name_raw()).into_owned();
        names.extend(name.strip_suffix(".npy").map(String::from));
    }
    names.sort();
    let mut columns = Vec::new();
    for name in names {
        let entry = archive
            .by_name(&format!("{name}.npy"))
            .map_err(|e| LearnError::format(path, "NumPy", e))?;
        // The size in the archive bounds what is read; the array must agree with it.
        let total = entry.size();
        let array = read_array(path, entry, total)?;
        spread(&name, &array, &mut columns);
    }
    Columns::new(columns)
}

/// The names of the columns of a matrix with a sample per row: μ, then μ after the step, then nothing, or the attitude
/// before and after as matrices row by row (2d² columns), or as quaternions w, x, y, z (8 columns). `dim` and `size` are n
/// and d.
pub(super) fn names(
    path: &Path,
    width: usize,
    dim: usize,
    size: usize,
) -> Result<Vec<String>, LearnError> {
    let mut names = numbered("mu", dim);
    names.extend(numbered("mu_next", dim));
    match width.checked_sub(2 * dim) {
        Some(0) => {}
        Some(8) => {
            names.extend(quaternion("q"));
            names.extend(quaternion("q_next"));
        }
        Some(w) if w == 2 * size * size => {
            names.extend(matrix("g", size));
            names.extend(matrix("g_next", size));
        }
        _ => {
            let what = format!("a row of {}", path.display());
            return Err(LearnError::Shape { what, expected: 2 * dim, found: width });
        }
    }
    Ok(names)
}

/// Bytes read at a time.
const PIECE: usize = 1 << 16;

/// Reads an array of 64- or 32-bit floats that has `total` bytes with its header. Memory grows with
/// the bytes that are present, not with those that are claimed.
fn read_array(path: &Path, mut reader: impl Read, total: u64) -> Result<Array, LearnError> {
    let header =
        NpyHeader::read(&mut reader, total).map_err(|e| LearnError::format(path, "NumPy", e))?;
    let mut missing = header.count * header.width;
    let mut values = Vec::new();
    let mut piece = vec![0; PIECE.min(missing)];
    while missing > 0 {
        let take = piece.len().min(missing);
        reader.read_exact(&mut piece[..take]).map_err(|e| LearnError::format(path, "NumPy", e))?;
        header.decode(&piece[..take], &mut values);
        missing -= take;
    }
    let shape = header.shape;
    let values = if header.fortran { row_major(&shape, &values) } else { values };
    Ok(Array { shape, values })
}

/// Adds an array of a `.npz` file as columns; arrays of other shapes are not ours to read.
fn spread(name: &str, array: &Array, columns: &mut Vec<(String, Vec<f64>)>) {
    let names = match (array.shape.as_slice(), name) {
        ([_], _) => vec![name.to_owned()],
        ([_, 4], "q" | "q_next") => quaternion(name).to_vec(),
        ([_, width], _) => numbered(name, *width),
        ([_, rows, width], _) if rows == width => matrix(name, *rows),
        _ => return,
    };
    columns.extend(array.columns(names));
}

/// `mu_1` … `mu_n`.
pub(super) fn numbered(name: &str, count: usize) -> Vec<String> {
    (1..=count).map(|i| format!("{name}_{i}")).collect()
}

/// `g_11`, `g_12` … `g_dd`, row by row.
pub(super) fn matrix(name: &str, size: usize) -> Vec<String> {
    let entries = (1..=size).flat_map(|i| (1..=size).map(move |j| (i, j)));
    entries.map(|(i, j)| format!("{name}_{i}{j}")).collect()
}

/// `q_w`, `q_x`, `q_y`, `q_z`.
pub(super) fn quaternion(name: &str) -> [String; 4] {
    ["w", "x", "y", "z"].map(|part| format!("{name}_{part}"))
}
