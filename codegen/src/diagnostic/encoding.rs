//! Files that are not the text they should be.

use std::io::{BufRead, BufReader, Error, ErrorKind, Read, Result};
use std::path::Path;

use crate::file;

/// The text of a file.
///
/// # Errors
/// Fails if the file cannot be read or is not UTF-8; the message gives the place of the first byte that is not.
pub fn read_text(path: &Path) -> Result<String> {
    let bytes = file::read(path)?;
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        no_text(error.as_bytes(), valid)
    })
}

/// Checks the first line of a table of text, after lines that begin with `#`.
///
/// # Errors
/// Fails if the file cannot be read, is not UTF-8, or has semicolons or tabs in place of commas.
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

/// The byte at which a text opens that is never closed; nothing where every text is.
///
/// A text in single quotes ends on its line, one in triple quotes anywhere. Where a closing quote
/// is missing in a list, the next text's opening quote closes it, and what follows is no separator:
/// that text is taken to be the one left open.
pub(crate) fn unclosed_quote(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut at = 0;
    // The first text on this line that something other than a separator follows.
    let mut doubtful = None;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\n' => doubtful = None,
            b'#' => {
                let line = bytes[at..].iter().position(|b| *b == b'\n');
                at += line.unwrap_or(bytes.len() - at);
                continue;
            }
            b'"' | b'\'' => {
                let long = bytes[at..].starts_with(&[byte; 3]);
                let Some(end) = end(bytes, at, byte, long) else {
                    return Some(doubtful.unwrap_or(at));
                };
                let next = bytes[end..].iter().find(|b| !matches!(b, b' ' | b'\t'));
                let separated = next.is_none_or(|b| {
                    matches!(b, b',' | b']' | b'}' | b'=' | b'.' | b'#' | b'\r' | b'\n')
                });
                if !separated && doubtful.is_none() {
                    doubtful = Some(at);
                }
                at = end;
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    None
}

/// The end of the text that opens at `start`, after its closing quotes.
fn end(bytes: &[u8], start: usize, quote: u8, long: bool) -> Option<usize> {
    let width = if long { 3 } else { 1 };
    let mut at = start + width;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\\' if quote == b'"' => at += 1,
            b'\n' if !long => return None,
            _ if byte == quote && (!long || bytes[at..].starts_with(&[quote; 3])) => {
                return Some(at + width);
            }
            _ => {}
        }
        at += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::unclosed_quote;

    #[test]
    fn the_quote_without_a_partner_is_found() {
        assert_eq!(unclosed_quote("a = \"b\nc = \"d\""), Some(4));
        assert_eq!(unclosed_quote("a = [\"x, \"y\", \"z\"]"), Some(5));
        assert_eq!(unclosed_quote("a = \"b # \\\" c\" # \"\n"), None);
    }
}
