//! What an experiment has to say: tables, sentences, curves.

use std::fmt::Write as _;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::LearnError;

/// A cell of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// A figure.
    Number(f64),
    /// A label, or why there is no figure.
    Text(String),
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::Text(value.to_string()) }
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or_else(|| Self::Text("-".into()), Self::from)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// A titled table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// Column heads.
    pub columns: Vec<String>,
    /// The cells, row by row; as many in a row as there are heads.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(title: impl Into<String>, columns: &[&str]) -> Self {
        let columns = columns.iter().map(|&c| c.into()).collect();
        Self { title: title.into(), columns, rows: Vec::new() }
    }

    /// Adds a row.
    pub fn push(&mut self, row: Vec<Cell>) {
        self.rows.push(row);
    }
}

/// Curves over a common abscissa, for one CSV file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The file's name without ending.
    pub name: String,
    /// Column heads, the abscissa first.
    pub columns: Vec<String>,
    /// The numbers, row by row; as many in a row as there are heads.
    pub rows: Vec<Vec<f64>>,
}

/// The outcome of an experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The experiment's name.
    pub name: String,
    /// Whether it was the short version.
    pub quick: bool,
    /// The seed everything follows from.
    pub seed: u64,
    /// The tables, in the order of the paper.
    pub tables: Vec<Table>,
    /// What the figures mean and do not mean.
    pub notes: Vec<String>,
    /// Curves; written as CSV, not part of the JSON.
    #[serde(skip)]
    pub curves: Vec<Curve>,
}

impl Report {
    /// The tables as text.
    #[must_use]
    pub fn text(&self) -> String {
        let version = if self.quick { ", quick" } else { "" };
        let mut text = format!("{} (seed {}{version})\n", self.name, self.seed);
        for table in &self.tables {
            let shown = |cell: &Cell| match cell {
                Cell::Number(v) if *v == 0.0 => "0".into(),
                Cell::Number(v) if (0.01..1e5).contains(&v.abs()) => format!("{v:.4}"),
                Cell::Number(v) => format!("{v:.2e}"),
                Cell::Text(t) => t.clone(),
            };
            let rows: Vec<Vec<String>> = std::iter::once(table.columns.clone())
                .chain(table.rows.iter().map(|row| row.iter().map(shown).collect()))
                .collect();
            let width = |c: usize| {
                rows.iter().filter_map(|r| r.get(c)).map(|s| s.chars().count()).max().unwrap_or(0)
            };
            let widths: Vec<usize> = (0..table.columns.len()).map(width).collect();
            // Writing to a String cannot fail.
            let _ = writeln!(text, "\n{}", table.title);
            for row in &rows {
                let cells: Vec<String> =
                    row.iter().zip(&widths).map(|(cell, w)| format!("{cell:<w$}")).collect();
                let _ = writeln!(text, "  {}", cells.join("  ").trim_end());
            }
        }
        for note in &self.notes {
            let _ = writeln!(text, "\nnote: {note}");
        }
        text
    }

    /// Writes `NAME.json` and a CSV file per curve to the folder.
    ///
    /// # Errors
    /// [`LearnError::File`] when a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), LearnError> {
        let fail = |path: &Path, source| LearnError::File { path: path.into(), source };
        std::fs::create_dir_all(folder).map_err(|e| fail(folder, e))?;
        for curve in &self.curves {
            let path = folder.join(format!("{}.csv", curve.name));
            let mut text = curve.columns.join(",") + "\n";
            for row in &curve.rows {
                let cells: Vec<String> = row.iter().map(f64::to_string).collect();
                text += &(cells.join(",") + "\n");
            }
            std::fs::write(&path, text).map_err(|e| fail(&path, e))?;
        }
        self.save(&folder.join(format!("{}.json", self.name)))
    }

    /// Writes the tables and notes as JSON.
    pub(super) fn save(&self, path: &Path) -> Result<(), LearnError> {
        let fail = |source| LearnError::File { path: path.into(), source };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(fail)?;
        }
        let text = serde_json::to_string_pretty(self).map_err(|e| fail(e.into()))?;
        std::fs::write(path, text + "\n").map_err(fail)
    }

    /// Whether it holds the table of this title.
    pub(super) fn has(&self, title: &str) -> bool {
        self.tables.iter().any(|table| table.title == title)
    }

    /// Reads a report back; `None` if there is none that fits.
    pub(super) fn read(path: &Path, name: &str, options: &super::RunOptions) -> Option<Self> {
        let text = std::fs::read_to_string(path).ok()?;
        let report: Self = serde_json::from_str(&text).ok()?;
        let same = report.name == name && report.quick == options.quick;
        (same && report.seed == options.seed).then_some(report)
    }
}
