//! NumPy's formats: arrays in `.npy`, whose headers are read within the bounds of their files, and named arrays in `.npz`.
//!
//! Source: NumPy Enhancement Proposal 1, *A Simple File Format for NumPy Arrays*: the magic
//! `\x93NUMPY`, a version, the length of the header (two bytes in version 1, four later), and a
//! Python dictionary of `descr`, `fortran_order` and `shape`.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;
use zip::ZipArchive;

use crate::error::LearnError;

/// The longest header that is read; that of a plain array has about a hundred bytes.
const LONGEST: u64 = 1 << 16;

/// The header of an array of floats or signed integers of 64 or 32 bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NpyHeader {
    /// The lengths along each axis.
    pub(crate) shape: Vec<usize>,
    /// True if the first index varies fastest.
    pub(crate) fortran: bool,
    /// Bytes before the first number.
    pub(crate) length: u64,
    /// Bytes of a number: 8 or 4.
    pub(crate) width: usize,
    /// True if the first byte of a number is the most significant.
    big_endian: bool,
    /// True if numbers are integers.
    integers: bool,
    /// The number of numbers; all of them are in the file.
    pub(crate) count: usize,
}

/// Errors of reading an array.
#[derive(Debug, thiserror::Error)]
pub(crate) enum NpyError {
    #[error(transparent)]
    File(#[from] std::io::Error),
    #[error("it does not begin with the signature of an array (\\x93NUMPY)")]
    Signature,
    #[error("it is of version {0} of the format; versions 1 to 3 are known")]
    Version(u8),
    #[error(
        "its header claims {claimed} bytes; the file has {rest} left, and no header has more than {LONGEST}"
    )]
    HeaderLength { claimed: u64, rest: u64 },
    #[error("its header cannot be read: {0}")]
    Header(String),
    #[error(
        "its numbers are of type {0}; 64- or 32-bit floats or integers are needed (<f8, <f4, <i8, <i4)"
    )]
    Type(Value),
    #[error("its shape {shape:?} needs more than the {rest} bytes that the file has left")]
    Shape { shape: Vec<usize>, rest: u64 },
}

impl NpyHeader {
    /// Reads the header of an array that has `total` bytes in all, and leaves `reader` at the first
    /// number. Nothing is allocated that the file does not hold.
    pub(crate) fn read(reader: &mut impl Read, total: u64) -> Result<Self, NpyError> {
        let mut start = [0; 8];
        reader.read_exact(&mut start).map_err(|_| NpyError::Signature)?;
        if start[..6] != *b"\x93NUMPY" {
            return Err(NpyError::Signature);
        }
        let mut size = [0; 4];
        let digits = match start[6] {
            1 => 2,
            2 | 3 => 4,
            version => return Err(NpyError::Version(version)),
        };
        reader.read_exact(&mut size[..digits])?;
        let claimed = u64::from(u32::from_le_bytes(size));
        let before = 8 + digits as u64;
        let rest = total.saturating_sub(before);
        if claimed > rest.min(LONGEST) {
            return Err(NpyError::HeaderLength { claimed, rest });
        }
        let mut text = vec![0; claimed as usize];
        reader.read_exact(&mut text)?;
        let dictionary = Dictionary::parse(&String::from_utf8_lossy(&text));
        let Dictionary { descr, fortran_order: fortran, shape } =
            dictionary.map_err(|error| NpyError::Header(error.to_string()))?;
        let known = ["<f8", "<f4", ">f8", ">f4", "<i8", "<i4", ">i8", ">i4"];
        let Some(kind) = descr.as_str().filter(|kind| known.contains(kind)) else {
            return Err(NpyError::Type(descr));
        };
        let (big_endian, integers) = (kind.starts_with('>'), kind.contains('i'));
        let width = if kind.ends_with('8') { 8 } else { 4 };
        let (length, rest) = (before + claimed, rest - claimed);
        let outside = || NpyError::Shape { shape: shape.clone(), rest };
        // If one length is zero, nothing in the file bounds the others.
        if shape.contains(&0) && shape.iter().any(|&n| n as u64 > LONGEST) {
            return Err(outside());
        }
        let count = shape.iter().try_fold(1_usize, |count, &n| count.checked_mul(n));
        let bytes = count.and_then(|count| count.checked_mul(width));
        let (Some(count), Some(bytes)) = (count, bytes) else { return Err(outside()) };
        if bytes as u64 > rest {
            return Err(outside());
        }
        Ok(Self { shape, fortran, length, width, big_endian, integers, count })
    }

    /// Adds the next `count` numbers. Memory grows with the bytes that are present, not with those that are claimed.
    pub(crate) fn take(
        &self,
        reader: &mut impl Read,
        count: usize,
        values: &mut Vec<f64>,
    ) -> std::io::Result<()> {
        let mut missing = count * self.width;
        let mut piece = vec![0; PIECE.min(missing)];
        while missing > 0 {
            let take = piece.len().min(missing);
            reader.read_exact(&mut piece[..take])?;
            self.decode(&piece[..take], values);
            missing -= take;
        }
        Ok(())
    }

    /// Adds the numbers of `bytes`; an incomplete one at the end is left.
    pub(crate) fn decode(&self, bytes: &[u8], values: &mut Vec<f64>) {
        let wide = |b: &[u8; 8]| {
            let bits =
                if self.big_endian { u64::from_be_bytes(*b) } else { u64::from_le_bytes(*b) };
            if self.integers { bits as i64 as f64 } else { f64::from_bits(bits) }
        };
        let narrow = |b: &[u8; 4]| {
            let bits =
                if self.big_endian { u32::from_be_bytes(*b) } else { u32::from_le_bytes(*b) };
            if self.integers { f64::from(bits as i32) } else { f64::from(f32::from_bits(bits)) }
        };
        match self.width {
            8 => values.extend(bytes.as_chunks::<8>().0.iter().map(wide)),
            _ => values.extend(bytes.as_chunks::<4>().0.iter().map(narrow)),
        }
    }
}

/// The bytes before the numbers of a row-major array of 64-bit floats of this shape: version 1.0,
/// padded to a multiple of 64 bytes.
pub fn npy_header(shape: &[u64]) -> Vec<u8> {
    let mut lengths = shape.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
    if shape.len() == 1 {
        lengths.push(',');
    }
    let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({lengths}), }}");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let length = (bytes.len() + 2 + dictionary.len() + 1).next_multiple_of(64) - bytes.len() - 2;
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(dictionary.bytes());
    bytes.resize(bytes.len() + length - dictionary.len() - 1, b' ');
    bytes.push(b'\n');
    bytes
}

/// The entries of an array with the first index quickest (as `np.column_stack` leaves it), with the
/// last index quickest.
pub(crate) fn row_major(shape: &[usize], values: &[f64]) -> Vec<f64> {
    let place = |mut index: usize| {
        let mut stride = values.len();
        let mut place = 0;
        for &size in shape.iter().rev() {
            stride /= size.max(1);
            place += index % size * stride;
            index /= size;
        }
        place
    };
    (0..values.len()).map(|index| values[place(index)]).collect()
}

/// The columns of a `.npz` file, in the order of their arrays' names. An array of shape (N,) is the column of its name; an
/// array `mu` of shape (N, n) is the columns `mu_1` … `mu_n`; an array `g` of shape (N, d, d) is `g_11` … `g_dd`; an array
/// `q` of shape (N, 4) is `q_w`, `q_x`, `q_y`, `q_z`. The same with `_next`.
pub(super) fn npz_columns(path: &Path, file: File) -> Result<Vec<(String, Vec<f64>)>, LearnError> {
    let damaged = |what: &dyn std::fmt::Display| LearnError::format(path, "NumPy", what);
    let mut archive = ZipArchive::new(BufReader::new(file)).map_err(|e| damaged(&e))?;
    let mut names = Vec::new();
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|e| damaged(&e))?;
        let name = String::from_utf8_lossy(entry.name_raw()).into_owned();
        names.extend(name.strip_suffix(".npy").map(String::from));
    }
    names.sort();
    let mut columns = Vec::new();
    for name in names {
        let entry = archive.by_name(&format!("{name}.npy")).map_err(|e| damaged(&e))?;
        // The size in the archive bounds what is read; the array must agree with it.
        let total = entry.size();
        let (shape, values) = read_array(entry, total).map_err(|e| damaged(&e))?;
        let names = match (shape.as_slice(), name.as_str()) {
            ([_], _) => vec![name],
            ([_, 4], "q" | "q_next") => quaternion(&name),
            ([_, width], _) => numbered(&name, *width),
            ([_, rows, width], _) if rows == width => matrix(&name, *rows),
            // Arrays of other shapes are not ours to read.
            _ => continue,
        };
        let width = names.len();
        let column = |place: usize| values.iter().skip(place).step_by(width).copied().collect();
        columns.extend(names.into_iter().enumerate().map(|(place, name)| (name, column(place))));
    }
    Ok(columns)
}

/// Bytes read at a time.
const PIECE: usize = 1 << 16;

/// The shape and the numbers, row-major, of an array that has `total` bytes with its header.
fn read_array(mut reader: impl Read, total: u64) -> Result<(Vec<usize>, Vec<f64>), NpyError> {
    let header = NpyHeader::read(&mut reader, total)?;
    let mut values = Vec::new();
    header.take(&mut reader, header.count, &mut values)?;
    let values = if header.fortran { row_major(&header.shape, &values) } else { values };
    Ok((header.shape, values))
}

/// `mu_1` … `mu_n`.
pub(crate) fn numbered(name: &str, count: usize) -> Vec<String> {
    (1..=count).map(|i| format!("{name}_{i}")).collect()
}

/// `g_11`, `g_12` … `g_dd`, row by row.
pub(crate) fn matrix(name: &str, size: usize) -> Vec<String> {
    let entries = (1..=size).flat_map(|i| (1..=size).map(move |j| (i, j)));
    entries.map(|(i, j)| format!("{name}_{i}{j}")).collect()
}

/// `q_w`, `q_x`, `q_y`, `q_z`.
pub(crate) fn quaternion(name: &str) -> Vec<String> {
    ["w", "x", "y", "z"].map(|part| format!("{name}_{part}")).to_vec()
}

#[derive(Deserialize)]
struct Dictionary {
    descr: Value,
    fortran_order: bool,
    shape: Vec<usize>,
}

impl Dictionary {
    /// Reads it as JSON, with other quotes and brackets, no comma before a closing one, and no `L` as in the `3L` of
    /// Python 2.
    fn parse(text: &str) -> serde_json::Result<Self> {
        let mut json = String::new();
        for c in text.chars().filter(|c| *c != 'L') {
            if let ')' | '}' = c {
                json.truncate(json.trim_end_matches([' ', ',']).len());
            }
            json.push(match c {
                '\'' => '"',
                '(' => '[',
                ')' => ']',
                c => c,
            });
        }
        serde_json::from_str(&json.replace("True", "true").replace("False", "false"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_index_quickest_is_reordered() {
        // By hand: the matrix [[0, 1, 2], [3, 4, 5]] column by column.
        assert_eq!(row_major(&[2, 3], &[0.0, 3.0, 1.0, 4.0, 2.0, 5.0]), [0., 1., 2., 3., 4., 5.]);
        // The entry (i, j, k) of a 2×2×2 array is 4i + 2j + k.
        let values = [0.0, 4.0, 2.0, 6.0, 1.0, 5.0, 3.0, 7.0];
        assert_eq!(row_major(&[2, 2, 2], &values), [0., 1., 2., 3., 4., 5., 6., 7.]);
        assert_eq!(row_major(&[3], &[1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
        assert!(row_major(&[0, 3], &[]).is_empty());
    }

    fn array(version: u8, dictionary: &str) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY".to_vec();
        bytes.extend([version, 0]);
        let length = dictionary.len() as u32;
        match version {
            1 => bytes.extend((length as u16).to_le_bytes()),
            _ => bytes.extend(length.to_le_bytes()),
        }
        bytes.extend(dictionary.bytes());
        bytes
    }

    fn read(bytes: &[u8]) -> Result<NpyHeader, NpyError> {
        NpyHeader::read(&mut &bytes[..], bytes.len() as u64)
    }

    #[test]
    fn headers_as_they_are_written_are_read() {
        let plain = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }   \n";
        let odd = "{\"shape\":(6L,),'fortran_order':True,\"descr\":'>f4'}";
        for version in 1..=3 {
            let mut bytes = array(version, plain);
            bytes.resize(bytes.len() + 48, 0);
            let header = read(&bytes).unwrap();
            assert_eq!((header.shape.as_slice(), header.count), (&[2, 3][..], 6));
            assert_eq!((header.fortran, header.length), (false, bytes.len() as u64 - 48));
            let mut bytes = array(version, odd);
            bytes.extend([1.5_f32, -2.0, 0.0, 0.0, 0.0, 4.0].iter().flat_map(|x| x.to_be_bytes()));
            let header = read(&bytes).unwrap();
            assert!(header.fortran && header.shape == [6]);
            let mut values = Vec::new();
            header.decode(&bytes[header.length as usize..], &mut values);
            assert_eq!(values, [1.5, -2.0, 0.0, 0.0, 0.0, 4.0]);
        }
        // No axis: one number.
        let mut one = array(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (), }\n");
        one.extend(7.0_f64.to_le_bytes());
        assert_eq!(read(&one).unwrap().count, 1);
    }

    #[test]
    fn written_headers_are_read() {
        for shape in [vec![], vec![0], vec![3], vec![2, 5], vec![1, 2, 3]] {
            let mut bytes = npy_header(&shape);
            assert_eq!(bytes.len() % 64, 0);
            let count = shape.iter().product::<u64>() as usize;
            bytes.resize(bytes.len() + 8 * count, 0);
            let header = read(&bytes).unwrap();
            assert!(header.shape.iter().map(|&n| n as u64).eq(shape));
            assert_eq!(header.count, count);
        }
    }

    #[test]
    fn claims_beyond_the_file_are_refused_before_anything_is_allocated() {
        let mut claims = b"\x93NUMPY\x02\x00".to_vec();
        claims.extend(u32::MAX.to_le_bytes());
        claims.extend([b' '; 100]);
        let said = read(&claims).unwrap_err().to_string();
        assert!(said.contains("claims 4294967295 bytes") && said.contains("100 left"), "{said}");
        for shape in [
            "(1000000000000, 3)",
            "(4294967296, 4294967296)",
            "(18446744073709551615,)",
            "(0, 18446744073709551615, 18446744073709551615)",
            "(3, 1)",
        ] {
            let dictionary =
                format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
            let mut bytes = array(1, &dictionary);
            bytes.resize(bytes.len() + 16, 0);
            let found = read(&bytes);
            assert!(matches!(found, Err(NpyError::Shape { .. })), "{shape}: {found:?}");
        }
    }

    #[test]
    fn headers_that_are_none_are_refused() {
        assert!(matches!(read(b"PK\x03\x04"), Err(NpyError::Signature)));
        assert!(matches!(read(&array(9, "{}")), Err(NpyError::Version(9))));
        for dictionary in [
            "",
            "{",
            "{}",
            "{'descr'}",
            "{'descr': '<f8'",
            "{'descr': '<f8', 'fortran_order': Maybe, 'shape': (1,)}",
            "{'descr': '<f8', 'fortran_order': True, 'shape': (-1,)}",
            "{'descr': '<f8', 'fortran_order': True, 'shape': 1}",
            "{descr: '<f8'}",
            "{'descr': )}",
        ] {
            let found = read(&array(1, dictionary));
            assert!(matches!(found, Err(NpyError::Header(_))), "{dictionary}: {found:?}");
        }
        let integers = "{'descr': '<u8', 'fortran_order': False, 'shape': (0,), }";
        assert!(matches!(read(&array(1, integers)), Err(NpyError::Type(_))));
    }
}
