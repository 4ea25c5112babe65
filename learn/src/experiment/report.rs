//! What an experiment has to say: tables, sentences, curves.

use std::fmt::Write as _;
use std::path::Path;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

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

impl Cell {
    /// The figure in few digits, or the text.
    #[must_use]
    pub fn shown(&self) -> String {
        match self {
            Self::Number(value) => brief(*value),
            Self::Text(text) => text.clone(),
        }
    }
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

/// What a number must be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// Not above it.
    AtMost(f64),
    /// Not below it.
    AtLeast(f64),
}

/// A number that a figure or a table is judged by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// The figure or table.
    pub figure: String,
    /// What the number is.
    pub what: String,
    /// The number.
    pub value: Cell,
    /// What it must be.
    pub bound: Bound,
}

impl Judgement {
    /// Whether the number is what it must be; text, in place of a number, is not.
    #[must_use]
    pub fn holds(&self) -> bool {
        match (&self.value, self.bound) {
            (Cell::Number(value), Bound::AtMost(most)) => *value <= most,
            (Cell::Number(value), Bound::AtLeast(least)) => *value >= least,
            (Cell::Text(_), _) => false,
        }
    }

    /// The bound in words.
    #[must_use]
    pub fn asked(&self) -> String {
        match self.bound {
            Bound::AtMost(most) => format!("at most {}", brief(most)),
            Bound::AtLeast(least) => format!("at least {}", brief(least)),
        }
    }
}

/// A figure in few digits.
fn brief(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        value if (0.01..1e5).contains(&value.abs()) => {
            let places = (3 - value.abs().log10().floor() as i32).clamp(0, 4) as usize;
            let text = format!("{value:.places$}");
            if places == 0 {
                return text;
            }
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        value => {
            let text = format!("{value:.2e}");
            let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'))
        }
    }
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
    /// The numbers by which the figures are judged.
    pub judgements: Vec<Judgement>,
    /// Curves; written as CSV, of which the JSON has the names.
    #[serde(serialize_with = "names", deserialize_with = "of_names")]
    pub curves: Vec<Curve>,
}

fn names<S: Serializer>(curves: &[Curve], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(curves.iter().map(|curve| &curve.name))
}

/// Curves without their numbers, which are in files of their own.
fn of_names<'a, D: Deserializer<'a>>(deserializer: D) -> Result<Vec<Curve>, D::Error> {
    let names = Vec::<String>::deserialize(deserializer)?;
    let empty = |name| Curve { name, columns: Vec::new(), rows: Vec::new() };
    Ok(names.into_iter().map(empty).collect())
}

impl Curve {
    /// Reads the numbers of `NAME.csv` in the folder; `None` if there is no such file, or another.
    fn load(&mut self, folder: &Path) -> Option<()> {
        let text = std::fs::read_to_string(folder.join(format!("{}.csv", self.name))).ok()?;
        let mut lines = text.lines();
        self.columns = lines.next()?.split(',').map(str::to_owned).collect();
        let width = self.columns.len();
        let row = |line: &str| -> Option<Vec<f64>> {
            let row: Vec<f64> = line.split(',').map(|v| v.parse().ok()).collect::<Option<_>>()?;
            (row.len() == width).then_some(row)
        };
        self.rows = lines.map(row).collect::<Option<_>>()?;
        Some(())
    }

    /// The numbers of a column; empty if there is none of this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.columns.iter().position(|column| column == name);
        at.map(|at| self.rows.iter().map(|row| row[at]).collect()).unwrap_or_default()
    }
}

impl Report {
    /// Enters a number by which a figure is judged.
    pub(super) fn judge(
        &mut self,
        figure: &str,
        what: impl Into<String>,
        value: impl Into<Cell>,
        bound: Bound,
    ) {
        let (figure, what, value) = (figure.into(), what.into(), value.into());
        self.judgements.push(Judgement { figure, what, value, bound });
    }

    /// The tables as text.
    #[must_use]
    pub fn text(&self) -> String {
        let version = if self.quick { ", quick" } else { "" };
        let mut text = format!("{} (seed {}{version})\n", self.name, self.seed);
        for table in &self.tables {
            let rows: Vec<Vec<String>> = std::iter::once(table.columns.clone())
                .chain(table.rows.iter().map(|row| row.iter().map(Cell::shown).collect()))
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
        for judgement in &self.judgements {
            let value = judgement.value.shown();
            let verdict = if judgement.holds() { "holds" } else { "FAILS" };
            let (what, asked) = (&judgement.what, judgement.asked());
            let _ = writeln!(text, "\n{verdict}: {what}: {value}, {asked}");
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
        self.write_curves(folder)?;
        self.save(&folder.join(format!("{}.json", self.name)))
    }

    /// Writes a CSV file per curve.
    pub(super) fn write_curves(&self, folder: &Path) -> Result<(), LearnError> {
        let fail = |path: &Path, source| LearnError::File { path: path.into(), source };
        for curve in &self.curves {
            let path = folder.join(format!("{}.csv", curve.name));
            let mut text = curve.columns.join(",") + "\n";
            for row in &curve.rows {
                let cells: Vec<String> = row.iter().map(f64::to_string).collect();
                text += &(cells.join(",") + "\n");
            }
            std::fs::write(&path, text).map_err(|e| fail(&path, e))?;
        }
        Ok(())
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
        let mut report: Self = serde_json::from_str(&text).ok()?;
        let folder = path.parent()?;
        report.curves.iter_mut().try_for_each(|curve| curve.load(folder))?;
        let same = report.name == name && report.quick == options.quick;
        (same && report.seed == options.seed).then_some(report)
    }
}
