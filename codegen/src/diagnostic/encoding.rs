//! Files that are not the text they should be.

use std::io::{BufRead, BufReader, Error, ErrorKind, Read, Result};
use std::path::Path;

use crate::file;

/// The text of a file.
///
/// # Errors
/// Where it cannot be read or is not UTF-8: then the place of the first byte that is not.
pub fn read_text(path: &Path) -> Result<String> {
    let bytes = file::read(path)?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        no_text(error.as_bytes(), valid)
    })
}

/// Looks at the first line of a table as text, after lines that begin with `#`.
///
/// # Errors
/// Where it cannot be read, is not UTF-8, or has semicolons or tabs in place of commas.
pub fn check_table(path: &Path) -> Result<()> {
    let file = file::open(path)?;
    // Of the standard input the line would be lost.
    if !file.metadata()?.is_file() {
        return Ok(());
    }
    let mut reader = BufReader::new(file);
    let mut before = Vec::new();
    loop {
        let start = before.len();
        // A first line of more is no list of columns.
        reader.by_ref().take(1 << 24).read_until(b'\n', &mut before)?;
        let line = match std::str::from_utf8(&before[start..]) {
            Ok(line) => line,
            Err(error) => return Err(no_text(&before, start + error.valid_up_to())),
        };
        if !line.is_empty() && (line.starts_with('#') || line.trim().is_empty()) {
            continue;
        }
        let between = [(';', "semicolons"), ('\t', "tabs")];
        return match between.into_iter().find(|(mark, _)| line.contains(*mark)) {
            Some((_, marks)) if !line.contains(',') => Err(Error::new(
                ErrorKind::InvalidData,
                format!(
                    "{marks} stand between the names of columns; write commas there, and points in numbers"
                ),
            )),
            _ => Ok(()),
        };
    }
}

/// The mistake that the byte number `at` is not UTF-8.
fn no_text(bytes: &[u8], at: usize) -> Error {
    let said = match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "it is UTF-16, by its first two bytes".to_owned(),
        _ => {
            let before = &bytes[..at];
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            let start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
            let column = String::from_utf8_lossy(&before[start..]).chars().count() + 1;
            let byte = bytes.get(at).copied().unwrap_or_default();
            format!("byte {byte:#04x} at line {line}, column {column} is not UTF-8")
        }
    };
    Error::new(ErrorKind::InvalidData, format!("{said}; save the file as UTF-8"))
}
