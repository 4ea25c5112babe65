//! Rows of numbers, read as they are needed, with what their heads say.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use coadjoint_codegen::diagnostic::{check_table, read_text};
use coadjoint_codegen::file;
use coadjoint_run::verify::Rows;
use serde_json::Value;

use super::report;
use crate::error::{CliError, unread};

/// A file of rows.
pub struct Table {
    path: PathBuf,
    source: Source,
    head: BTreeMap<String, String>,
    names: Vec<String>,
    width: usize,
}

/// Where rows come from.
enum Source {
    /// Lines of numbers between commas, and the number of the last one read.
    Text(BufReader<File>, u64),
    /// Numbers of 64 bits, and how many rows are left.
    Matrix(BufReader<File>, u64),
    /// Rows in memory.
    Rows(std::vec::IntoIter<Vec<f64>>),
    #[cfg(feature = "parquet")]
    Parquet(Box<super::parquet::Rows>),
}

/// A file that is not what its name says.
pub fn damaged(path: &Path, what: &dyn std::fmt::Display) -> CliError {
    CliError::Option(format!("{}: {what}", path.display()))
}

impl Table {
    /// Opens a file by the ending of its name: `.npy`, `.json` (a table for each run it reports), `.parquet`, or CSV.
    ///
    /// # Errors
    /// Where it cannot be read, or is not what its name says.
    pub fn open(path: &Path) -> Result<Vec<Self>, CliError> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        match ending.to_ascii_lowercase().as_str() {
            "npy" => Self::matrix(path).map(|table| vec![table]),
            "json" | "jsonl" => report::tables(path),
            #[cfg(feature = "parquet")]
            "parquet" => Self::parquet(path).map(|table| vec![table]),
            #[cfg(not(feature = "parquet"))]
            "parquet" => Err(damaged(
                path,
                &"this program was built without the feature `parquet`: write .csv or .npy",
            )),
            _ => Self::text(path).map(|table| vec![table]),
        }
    }

    /// Rows in memory.
    pub fn of_rows(
        path: &Path,
        head: BTreeMap<String, String>,
        names: Vec<String>,
        rows: Vec<Vec<f64>>,
    ) -> Self {
        let (width, source) = (names.len(), Source::Rows(rows.into_iter()));
        Self { path: path.into(), source, head, names, width }
    }

    /// Lines `# name: value`, then the names of the columns.
    fn text(path: &Path) -> Result<Self, CliError> {
        check_table(path).map_err(unread(path))?;
        let file = file::open(path).map_err(unread(path))?;
        let (path, head) = (path.to_owned(), BTreeMap::new());
        let source = Source::Text(BufReader::new(file), 0);
        let mut table = Self { path, source, head, names: Vec::new(), width: 0 };
        loop {
            let Some(line) = table.next_line()? else {
                return Err(damaged(&table.path, &"the file has no line with names of columns"));
            };
            if line.starts_with('#') {
                table.remark(&line);
            } else if !line.trim().is_empty() {
                table.names = cells(&line).iter().map(|name| name.trim().to_owned()).collect();
                table.width = table.names.len();
                return Ok(table);
            }
        }
    }

    /// Takes note of a line `# name: value`.
    fn remark(&mut self, line: &str) {
        if let Some((name, value)) = line.trim_start_matches('#').split_once(':') {
            self.head.insert(name.trim().to_owned(), value.trim().to_owned());
        }
    }

    fn next_line(&mut self) -> Result<Option<String>, CliError> {
        let Source::Text(reader, number) = &mut self.source else { return Ok(None) };
        let mut line = String::new();
        *number += 1;
        let read = reader.read_line(&mut line).map_err(unread(&self.path))?;
        Ok((read > 0).then(|| line.trim_end_matches(['\n', '\r']).to_owned()))
    }

    /// NumPy's head, and the JSON file beside the matrix, if there is one.
    fn matrix(path: &Path) -> Result<Self, CliError> {
        let mut reader = BufReader::new(file::open(path).map_err(unread(path))?);
        let mut start = [0; 10];
        reader.read_exact(&mut start).map_err(unread(path))?;
        if &start[..6] != b"\x93NUMPY" || start[6] != 1 {
            return Err(damaged(path, &"not a matrix of NumPy's format, version 1.0"));
        }
        let mut head = vec![0; usize::from(u16::from_le_bytes([start[8], start[9]]))];
        reader.read_exact(&mut head).map_err(unread(path))?;
        let head = String::from_utf8_lossy(&head).into_owned();
        let shape = head.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(')'));
        let sizes: Vec<u64> = shape
            .map(|(sizes, _)| sizes.split(',').filter_map(|n| n.trim().parse().ok()).collect())
            .unwrap_or_default();
        let ([rows, width], true, true) =
            (sizes.as_slice(), head.contains("'<f8'"), head.contains("'fortran_order': False"))
        else {
            return Err(damaged(path, &"only matrices of <f8, row by row, are read"));
        };
        let length = reader.get_ref().metadata().map_err(unread(path))?.len();
        let bytes = rows.checked_mul(*width).and_then(|numbers| numbers.checked_mul(8));
        if bytes.is_none_or(|bytes| bytes > length) {
            return Err(damaged(path, &"its head claims more numbers than it holds"));
        }
        let mut table = Self {
            path: path.into(),
            source: Source::Matrix(reader, *rows),
            head: BTreeMap::new(),
            names: Vec::new(),
            // Bounded by the length of the file.
            width: usize::try_from(*width).unwrap_or(usize::MAX),
        };
        if let Ok(text) = read_text(&file::beside(path, ".json"))
            && let Ok(Value::Object(object)) = serde_json::from_str(&text)
        {
            for (name, value) in object {
                match value {
                    Value::Array(list) if name == "columns" => {
                        table.names =
                            list.iter().filter_map(|v| v.as_str().map(str::to_owned)).collect();
                    }
                    value => drop(table.head.insert(name, report::text(&value))),
                }
            }
        }
        Ok(table)
    }

    #[cfg(feature = "parquet")]
    fn parquet(path: &Path) -> Result<Self, CliError> {
        let (names, rows) = super::parquet::Rows::open(path)?;
        let (path, width) = (path.to_owned(), names.len());
        Ok(Self {
            path,
            source: Source::Parquet(Box::new(rows)),
            head: BTreeMap::new(),
            names,
            width,
        })
    }

    /// The entry of the head with this name, as a number.
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

    fn next_text_row(&mut self) -> Result<Option<Vec<f64>>, CliError> {
        loop {
            let Some(line) = self.next_line()? else { return Ok(None) };
            if line.starts_with('#') {
                self.remark(&line);
                continue;
            }
            if line.trim().is_empty() {
                continue;
            }
            let cells = cells(&line);
            if cells.len() != self.width {
                let Source::Text(_, number) = self.source else { return Ok(None) };
                let (found, width) = (cells.len(), self.width);
                let what = format!("line {number}: {found} cells in place of {width}");
                return Err(damaged(&self.path, &what));
            }
            return Ok(Some(cells.iter().map(|c| c.trim().parse().unwrap_or(f64::NAN)).collect()));
        }
    }
}

impl Rows for Table {
    type Error = CliError;

    fn next_row(&mut self) -> Result<Option<Vec<f64>>, CliError> {
        match &mut self.source {
            Source::Matrix(_, 0) => Ok(None),
            Source::Matrix(reader, left) => {
                *left -= 1;
                let mut bytes = vec![0; 8 * self.width];
                reader.read_exact(&mut bytes).map_err(unread(&self.path))?;
                Ok(Some(bytes.as_chunks::<8>().0.iter().map(|&b| f64::from_le_bytes(b)).collect()))
            }
            Source::Rows(rows) => Ok(rows.next()),
            #[cfg(feature = "parquet")]
            Source::Parquet(rows) => rows.next_row(),
            Source::Text(..) => self.next_text_row(),
        }
    }

    fn value(&self, name: &str) -> Option<&str> {
        self.head.get(name).map(String::as_str)
    }

    fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        self.value(name)?.split(',').map(|number| number.trim().parse().ok()).collect()
    }
}

/// The cells of a line, quotes taken off.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(std::mem::take(&mut cell)),
            letter => cell.push(letter),
        }
    }
    cells.push(cell);
    cells
}

#[cfg(test)]
mod tests {
    use super::cells;

    #[test]
    fn quotes_keep_commas() {
        assert_eq!(cells("1,\"a,\"\"b\"\"\",2"), ["1", "a,\"b\"", "2"]);
        assert_eq!(cells(""), [""]);
    }
}
