//! The header of NumPy's `.npy` format, read within the bounds of its file.
//!
//! Source: NumPy Enhancement Proposal 1, *A Simple File Format for NumPy Arrays*: the magic
//! `\x93NUMPY`, a version, the length of the header (two bytes in version 1, four later), and a
//! Python dictionary of `descr`, `fortran_order` and `shape`.

use std::io::Read;

/// The longest header that is read; that of a plain array has about a hundred bytes.
const LONGEST: u64 = 1 << 16;

/// The header of an array of 64- or 32-bit floats.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NpyHeader {
    /// The lengths along each axis.
    pub(crate) shape: Vec<usize>,
    /// Whether the first index runs quickest.
    pub(crate) fortran: bool,
    /// Bytes before the first number.
    pub(crate) length: u64,
    /// Bytes of a number: 8 or 4.
    pub(crate) width: usize,
    /// Whether the first byte of a number is its highest.
    big_endian: bool,
    count: usize,
}

/// Why an array cannot be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum NpyError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] std::io::Error),
    /// The file does not begin as an array does.
    #[error("it does not begin with the signature of an array (\\x93NUMPY)")]
    Signature,
    /// An unknown version of the format.
    #[error("it is of version {0} of the format; versions 1 to 3 are known")]
    Version(u8),
    /// A header longer than its file, or than any header is.
    #[error(
        "its header claims {claimed} bytes; the file has {rest} left, and no header has more than {LONGEST}"
    )]
    HeaderLength { claimed: u64, rest: u64 },
    /// A header that is not the dictionary it must be.
    #[error("its header cannot be read: {0}")]
    Header(&'static str),
    /// Numbers of another type.
    #[error("its numbers are of type {0}; 64- or 32-bit floats are needed (<f8, <f4)")]
    Type(String),
    /// A shape with more numbers than the file has.
    #[error("its shape {shape:?} needs more than the {rest} bytes that the file has left")]
    Shape { shape: Vec<u64>, rest: u64 },
}

impl NpyHeader {
    /// Reads the header of an array that has `total` bytes in all, and leaves `reader` at the first
    /// number. Nothing is allocated that the file does not hold.
    ///
    /// # Errors
    /// [`NpyError`] naming what is wrong.
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
        let text = String::from_utf8(text).map_err(|_| NpyError::Header("it is not text"))?;
        let dictionary = Dictionary::parse(&text)?;
        let (big_endian, width) = match dictionary.descr.as_str() {
            "<f8" => (false, 8),
            "<f4" => (false, 4),
            ">f8" => (true, 8),
            ">f4" => (true, 4),
            _ => return Err(NpyError::Type(dictionary.descr)),
        };
        let (length, rest) = (before + claimed, rest - claimed);
        let outside = || NpyError::Shape { shape: dictionary.shape.clone(), rest };
        let lengths = dictionary.shape.iter().map(|&n| usize::try_from(n));
        let shape: Vec<usize> = lengths.collect::<Result<_, _>>().map_err(|_| outside())?;
        // Where one length is zero, nothing in the file bounds the others.
        if shape.contains(&0) && shape.iter().any(|&n| n as u64 > LONGEST) {
            return Err(outside());
        }
        let count = shape.iter().try_fold(1_usize, |count, &n| count.checked_mul(n));
        let bytes = count.and_then(|count| count.checked_mul(width));
        let (Some(count), Some(bytes)) = (count, bytes) else { return Err(outside()) };
        if bytes as u64 > rest {
            return Err(outside());
        }
        Ok(Self { shape, fortran: dictionary.fortran, length, width, big_endian, count })
    }

    /// How many numbers the array has; all of them are in the file.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Adds the numbers of `bytes`; an incomplete one at the end is left.
    pub(crate) fn decode(&self, bytes: &[u8], values: &mut Vec<f64>) {
        let wide = |b: &[u8; 8]| {
            if self.big_endian { f64::from_be_bytes(*b) } else { f64::from_le_bytes(*b) }
        };
        let narrow = |b: &[u8; 4]| {
            f64::from(if self.big_endian { f32::from_be_bytes(*b) } else { f32::from_le_bytes(*b) })
        };
        match self.width {
            8 => values.extend(bytes.as_chunks::<8>().0.iter().map(wide)),
            _ => values.extend(bytes.as_chunks::<4>().0.iter().map(narrow)),
        }
    }
}

/// The bytes before the numbers of a row-major array of 64-bit floats of this shape: version 1.0,
/// padded to a multiple of 64 bytes.
#[must_use]
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

struct Dictionary {
    descr: String,
    fortran: bool,
    shape: Vec<u64>,
}

impl Dictionary {
    fn parse(text: &str) -> Result<Self, NpyError> {
        let mut rest = text.trim().strip_prefix('{').ok_or(NpyError::Header("no dictionary"))?;
        let (mut descr, mut fortran, mut shape) = (None, None, None);
        loop {
            rest = rest.trim_start_matches([' ', ',', '\t', '\n']);
            if rest.starts_with('}') {
                break;
            }
            let (key, after) = quoted(rest).ok_or(NpyError::Header("a key is not a string"))?;
            let value = after.trim_start().strip_prefix(':');
            let value = value.ok_or(NpyError::Header("a key has no value"))?.trim_start();
            let end = end_of(value).ok_or(NpyError::Header("a value does not end"))?;
            let (value, after) = value.split_at(end);
            let value = value.trim_end();
            match key {
                "descr" => descr = Some(quoted(value).map_or(value, |(inner, _)| inner).to_owned()),
                "fortran_order" => {
                    fortran = Some(match value {
                        "True" => true,
                        "False" => false,
                        _ => {
                            return Err(NpyError::Header(
                                "`fortran_order` is neither True nor False",
                            ));
                        }
                    });
                }
                "shape" => {
                    shape = Some(
                        tuple(value)
                            .ok_or(NpyError::Header("`shape` is not a tuple of whole numbers"))?,
                    )
                }
                _ => {}
            }
            rest = after;
        }
        match (descr, fortran, shape) {
            (Some(descr), Some(fortran), Some(shape)) => Ok(Self { descr, fortran, shape }),
            _ => Err(NpyError::Header("it needs `descr`, `fortran_order` and `shape`")),
        }
    }
}

/// The text in quotes that begins here, and what follows.
fn quoted(text: &str) -> Option<(&str, &str)> {
    let quote = text.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    text[1..].split_once(quote)
}

/// Where a value ends: before the comma or brace after it, outside quotes and brackets.
fn end_of(text: &str) -> Option<usize> {
    let (mut depth, mut quote) = (0_usize, None);
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), _) => quote = quote.filter(|_| c != open),
            (None, '\'' | '"') => quote = Some(c),
            (None, '(' | '[' | '{') => depth += 1,
            (None, ',' | '}') if depth == 0 => return Some(at),
            (None, ')' | ']' | '}') => depth = depth.checked_sub(1)?,
            _ => {}
        }
    }
    None
}

/// The whole numbers in parentheses; Python 2 wrote them as `3L`.
fn tuple(text: &str) -> Option<Vec<u64>> {
    let inside = text.strip_prefix('(')?.strip_suffix(')')?;
    let parts = inside.split(',').map(str::trim).filter(|part| !part.is_empty());
    parts.map(|part| part.trim_end_matches('L').parse().ok()).collect()
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
        let odd =
            "{\"shape\":(6L,),'extra': [('a', {1: 2})], 'fortran_order':True,\"descr\":'>f4'}";
        for version in 1..=3 {
            let mut bytes = array(version, plain);
            bytes.resize(bytes.len() + 48, 0);
            let header = read(&bytes).unwrap();
            assert_eq!((header.shape.as_slice(), header.count()), (&[2, 3][..], 6));
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
        assert_eq!(read(&one).unwrap().count(), 1);
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
            assert_eq!(header.count(), count);
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
        let integers = "{'descr': '<i8', 'fortran_order': False, 'shape': (0,), }";
        assert!(matches!(read(&array(1, integers)), Err(NpyError::Type(_))));
    }
}
