//! Lines of a text that begin with `#`.

use std::collections::BTreeMap;
use std::io::{Read, Result, Seek, SeekFrom};

/// Passes bytes on, and takes note of the lines `# name: value` among them.
pub(crate) struct Remarks<R> {
    inner: R,
    /// The values by their names.
    pub head: BTreeMap<String, String>,
    /// The part of the current line that has been read, where it begins with `#`.
    line: Option<Vec<u8>>,
    /// Whether the next byte begins a line.
    fresh: bool,
}

impl<R> Remarks<R> {
    /// From the beginning of a line on.
    pub(crate) fn new(inner: R) -> Self {
        Self { inner, head: BTreeMap::new(), line: None, fresh: true }
    }

    fn end_line(&mut self) {
        let Some(line) = self.line.take() else { return };
        let line = String::from_utf8_lossy(&line);
        if let Some((name, value)) = line.trim_start_matches('#').split_once(':') {
            self.head.insert(name.trim().to_owned(), value.trim().to_owned());
        }
    }
}

impl<R: Read> Read for Remarks<R> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let mut count = self.inner.read(buffer)?;
        // A remark at the very end is taken for a row where its line does not end.
        if count == 0 && !self.fresh && !buffer.is_empty() {
            (buffer[0], count) = (b'\n', 1);
        }
        for part in buffer[..count].split_inclusive(|byte| *byte == b'\n') {
            if self.fresh && part[0] == b'#' {
                self.line = Some(Vec::new());
            }
            if let Some(line) = &mut self.line {
                line.extend_from_slice(part);
            }
            self.fresh = part.ends_with(b"\n");
            if self.fresh {
                self.end_line();
            }
        }
        Ok(count)
    }
}

impl<R: Seek> Seek for Remarks<R> {
    /// To the beginning of a line.
    fn seek(&mut self, position: SeekFrom) -> Result<u64> {
        (self.line, self.fresh) = (None, true);
        self.inner.seek(position)
    }
}
