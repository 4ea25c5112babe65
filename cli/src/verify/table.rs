//! Rows of numbers from CSV and NPY, read as they are needed, with what their heads say.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::error::CliError;

/// A file of rows.
pub struct Table {
    path: PathBuf,
    reader: BufReader<File>,
    head: BTreeMap<String, String>,
    names: Vec<String>,
    width: usize,
    /// Rows left, where the file says how many there are; CSV does not.
    left: Option<u64>,
    line: u64,
}

fn unread(path: &Path) -> impl Fn(std::io::Error) -> CliError + '_ {
    move |source| CliError::Read { path: path.into(), source }
}

fn damaged(path: &Path, what: &str) -> CliError {
    CliError::Option(format!("{}: {what}", path.display()))
}

impl Table {
    /// Opens a file by the ending of its name, `.npy` or CSV.
    pub fn open(path: &Path) -> Result<Self, CliError> {
        let file = File::open(path).map_err(unread(path))?;
        let mut table = Self {
            path: path.into(),
            reader: BufReader::new(file),
            head: BTreeMap::new(),
            names: Vec::new(),
            width: 0,
            left: None,
            line: 0,
        };
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npy")) {
            table.matrix_head()?;
        } else {
            table.text_head()?;
        }
        Ok(table)
    }

    /// Lines `# name: value`, then the names of the columns.
    fn text_head(&mut self) -> Result<(), CliError> {
        loop {
            let Some(line) = self.next_line()? else {
                return Err(damaged(&self.path, "the file has no line with names of columns"));
            };
            if let Some(comment) = line.strip_prefix('#') {
                if let Some((name, value)) = comment.split_once(':') {
                    self.head.insert(name.trim().to_owned(), value.trim().to_owned());
                }
            } else if !line.trim().is_empty() {
                let names = line.split(',').map(|name| name.trim().trim_matches('"').to_owned());
                self.names = names.collect();
                self.width = self.names.len();
                return Ok(());
            }
        }
    }

    fn next_line(&mut self) -> Result<Option<String>, CliError> {
        let mut line = String::new();
        self.line += 1;
        let read = self.reader.read_line(&mut line).map_err(unread(&self.path))?;
        Ok((read > 0).then(|| line.trim_end_matches(['\n', '\r']).to_owned()))
    }

    /// NumPy's head, and the JSON file beside the matrix, if there is one.
    fn matrix_head(&mut self) -> Result<(), CliError> {
        let mut start = [0; 10];
        self.reader.read_exact(&mut start).map_err(unread(&self.path))?;
        if &start[..6] != b"\x93NUMPY" || start[6] != 1 {
            return Err(damaged(&self.path, "not a matrix of NumPy's format, version 1.0"));
        }
        let mut head = vec![0; usize::from(u16::from_le_bytes([start[8], start[9]]))];
        self.reader.read_exact(&mut head).map_err(unread(&self.path))?;
        let head = String::from_utf8_lossy(&head).into_owned();
        let shape = head.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(')'));
        let sizes: Vec<u64> = shape
            .map(|(sizes, _)| sizes.split(',').filter_map(|n| n.trim().parse().ok()).collect())
            .unwrap_or_default();
        let ([rows, width], true, true) =
            (sizes.as_slice(), head.contains("'<f8'"), head.contains("'fortran_order': False"))
        else {
            return Err(damaged(&self.path, "only matrices of <f8, row by row, are read"));
        };
        (self.left, self.width) = (Some(*rows), usize::try_from(*width).unwrap_or(0));
        let mut beside = self.path.clone().into_os_string();
        beside.push(".json");
        if let Ok(text) = std::fs::read_to_string(beside)
            && let Ok(Value::Object(object)) = serde_json::from_str(&text)
        {
            for (name, value) in object {
                match value {
                    Value::Array(list) if name == "columns" => {
                        self.names =
                            list.iter().filter_map(|v| v.as_str().map(str::to_owned)).collect();
                    }
                    Value::String(text) => drop(self.head.insert(name, text)),
                    other => drop(self.head.insert(name, other.to_string())),
                }
            }
        }
        Ok(())
    }

    /// What the head says under a name.
    pub fn value(&self, name: &str) -> Option<&String> {
        self.head.get(name)
    }

    /// The same as a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.value(name)?.parse().ok()
    }

    /// The names of the columns; none where the file has none.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The next row.
    ///
    /// # Errors
    /// Where the file cannot be read, or a cell is no number.
    pub fn next_row(&mut self) -> Result<Option<Vec<f64>>, CliError> {
        if let Some(left) = &mut self.left {
            if *left == 0 {
                return Ok(None);
            }
            *left -= 1;
            let mut bytes = vec![0; 8 * self.width];
            self.reader.read_exact(&mut bytes).map_err(unread(&self.path))?;
            let number = |b: &[u8]| f64::from_le_bytes(b.try_into().unwrap_or_default());
            return Ok(Some(bytes.chunks(8).map(number).collect()));
        }
        loop {
            let Some(line) = self.next_line()? else { return Ok(None) };
            if line.starts_with('#') || line.trim().is_empty() {
                continue;
            }
            let cells: Vec<&str> = line.split(',').collect();
            if cells.len() != self.width {
                let what =
                    format!("line {}: {} cells in place of {}", self.line, cells.len(), self.width);
                return Err(damaged(&self.path, &what));
            }
            // Columns that are no numbers, such as names of rows, are nobody's concern here.
            return Ok(Some(cells.iter().map(|c| c.trim().parse().unwrap_or(f64::NAN)).collect()));
        }
    }
}
