//! The outcome of an experiment: tables, curves, and the numbers that judge it.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Whatever stops the program, with a sentence for the user.
pub type Fallible<T> = Result<T, Box<dyn std::error::Error>>;

/// The cells of a row: numbers, texts, and nothing where no number is known.
macro_rules! row {
    ($($cell:expr),* $(,)?) => { vec![$(serde_json::Value::from($cell)),*] };
}
pub(crate) use row;

/// A cell as text, numbers in few digits.
pub fn shown(cell: &Value) -> String {
    match cell {
        Value::String(text) => text.clone(),
        cell => cell.as_f64().map_or_else(|| "–".into(), brief),
    }
}

pub fn brief(value: f64) -> String {
    let trimmed = |text: &str| text.trim_end_matches('0').trim_end_matches('.').to_owned();
    let text = match value {
        0.0 => "0".into(),
        value if (0.01..1e5).contains(&value.abs()) => {
            match (3 - value.abs().log10().floor() as i32).clamp(0, 4) as usize {
                0 => format!("{value:.0}"),
                places => trimmed(&format!("{value:.places$}")),
            }
        }
        value => {
            let text = format!("{value:.2e}");
            let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let raised =
                |c: char| "-0123456789".find(c).and_then(|at| "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(at));
            let power: String = exponent.chars().filter_map(raised).collect();
            match trimmed(digits).as_str() {
                "1" => format!("10{power}"),
                digits => format!("{digits}·10{power}"),
            }
        }
    };
    text.replace('-', "−")
}

#[derive(Clone, Debug, Default)]
pub struct Config {
    /// Fewer samples and steps, smaller networks.
    pub quick: bool,
    pub seed: u64,
    /// The folder of outcomes and of the state of training.
    pub out: Option<PathBuf>,
}

impl Config {
    pub(crate) fn report(&self, name: &str) -> Report {
        Report { name: name.into(), quick: self.quick, seed: self.seed, ..Report::default() }
    }

    /// A seed of its own for every use.
    pub(crate) fn seed(&self, number: u64) -> u64 {
        self.seed.wrapping_mul(1_000_003).wrapping_add(number)
    }

    /// `full`, or `quick` in the short version.
    pub(crate) fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}

/// The ending of the state of an unfinished training.
pub(crate) const CHECKPOINT: &str = "checkpoint";

/// A table with its title and the heads of its columns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tabulation {
    pub title: String,
    pub columns: Vec<String>,
    pub rows: Vec<Vec<Value>>,
}

impl Tabulation {
    /// An empty table; the heads of its columns are parted by bars.
    pub fn new(title: impl Into<String>, columns: &str) -> Self {
        let columns = columns.split(" | ").map(Into::into).collect();
        Self { title: title.into(), columns, rows: Vec::new() }
    }

    /// The cell in this column of the first row whose label begins with `row`, or of the last row for `last`.
    pub fn cell(&self, row: &str, column: usize) -> Option<&Value> {
        let begins = |cells: &&Vec<Value>| shown(&cells[0]).starts_with(row);
        let found = if row == "last" { self.rows.last() } else { self.rows.iter().find(begins) };
        found?.get(column)
    }

    /// The number of [`Self::cell`]; NaN where there is none.
    pub fn number(&self, row: &str, column: usize) -> f64 {
        self.cell(row, column).and_then(Value::as_f64).unwrap_or(f64::NAN)
    }
}

/// Columns of numbers, the abscissa first: one CSV file, of which JSON has the name.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Curve {
    /// The file's name without ending.
    pub name: String,
    #[serde(skip)]
    pub columns: Vec<String>,
    #[serde(skip)]
    pub rows: Vec<Vec<f64>>,
}

impl Curve {
    /// A curve that has its abscissa so far.
    pub fn over(name: &str, abscissa: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let rows = values.into_iter().map(|value| vec![value]).collect();
        Self { name: name.into(), columns: vec![abscissa.into()], rows }
    }

    /// Adds a column; where it is shorter than the abscissa, NaN stands for the rest.
    pub fn add(&mut self, column: impl Into<String>, values: impl IntoIterator<Item = f64>) {
        self.columns.push(column.into());
        let mut values = values.into_iter();
        self.rows.iter_mut().for_each(|row| row.push(values.next().unwrap_or(f64::NAN)));
    }

    /// The numbers of a column; none if there is no such column.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.columns.iter().position(|column| column == name);
        at.map(|at| self.rows.iter().map(|row| row[at]).collect()).unwrap_or_default()
    }

    /// Reads the numbers of `NAME.csv` in the folder; `None` if there is no such file, or another.
    fn load(name: String, folder: &Path) -> Option<Self> {
        let text = std::fs::read_to_string(folder.join(format!("{name}.csv"))).ok()?;
        let mut lines = text.lines();
        let columns: Vec<String> = lines.next()?.split(',').map(str::to_owned).collect();
        let row = |line: &str| -> Option<Vec<f64>> {
            let row: Vec<f64> = line.split(',').map(|v| v.parse().ok()).collect::<Option<_>>()?;
            (row.len() == columns.len()).then_some(row)
        };
        let rows = lines.map(row).collect::<Option<_>>()?;
        Some(Self { name, columns, rows })
    }
}

/// A number by which a figure or a table is judged, with its bounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    pub figure: String,
    pub what: String,
    /// The number; nothing where it is not finite.
    pub value: Option<f64>,
    pub at_most: Option<f64>,
    pub at_least: Option<f64>,
}

impl Judgement {
    /// True if there is a number within its bounds.
    pub fn holds(&self) -> bool {
        let within = |value: f64| {
            self.at_most.is_none_or(|most| value <= most)
                && self.at_least.is_none_or(|least| value >= least)
        };
        self.value.is_some_and(within)
    }

    /// The number and its bounds in words.
    pub fn words(&self) -> [String; 2] {
        let most = self.at_most.map(|most| format!("at most {}", brief(most)));
        let least = self.at_least.map(|least| format!("at least {}", brief(least)));
        let value = self.value.map_or_else(|| "no figure".into(), brief);
        [value, most.into_iter().chain(least).collect()]
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    pub name: String,
    pub quick: bool,
    pub seed: u64,
    pub tables: Vec<Tabulation>,
    pub judgements: Vec<Judgement>,
    pub curves: Vec<Curve>,
}

impl Report {
    /// The report with this table and this curve.
    pub fn with(mut self, table: Tabulation, curve: Curve) -> Self {
        self.tables.push(table);
        self.curves.push(curve);
        self
    }

    /// The curve of this name; an empty one if there is none.
    pub fn curve(&self, name: &str) -> Curve {
        self.curves.iter().find(|curve| curve.name == name).cloned().unwrap_or_default()
    }

    /// Writes a CSV file for each curve and then `NAME.json` to the folder.
    pub fn write(&self, folder: &Path) -> Fallible<()> {
        for curve in &self.curves {
            let row = |row: &Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
            let lines = std::iter::once(curve.columns.join(",")).chain(curve.rows.iter().map(row));
            let text: String = lines.map(|line| line + "\n").collect();
            write(&folder.join(format!("{}.csv", curve.name)), &text)?;
        }
        let text = serde_json::to_string_pretty(self)? + "\n";
        write(&folder.join(format!("{}.json", self.name)), &text)
    }

    /// Reads back what [`Self::write`] wrote; `None` if it is incomplete or of other settings.
    pub fn read(folder: &Path, name: &str, quick: bool, seed: u64) -> Option<Self> {
        let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).ok()?;
        let mut report: Self = serde_json::from_str(&text).ok()?;
        let curves = std::mem::take(&mut report.curves).into_iter();
        report.curves =
            curves.map(|curve| Curve::load(curve.name, folder)).collect::<Option<_>>()?;
        (report.name == name && (report.quick, report.seed) == (quick, seed)).then_some(report)
    }
}

/// Writes a file; the error names it.
pub fn write(path: &Path, text: &str) -> Fallible<()> {
    Ok(std::fs::write(path, text).map_err(|e| format!("cannot write {}: {e}", path.display()))?)
}

/// The files in a folder whose names have this ending, by name.
pub fn files(folder: &Path, ending: &str) -> Fallible<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder);
    let entries = entries.map_err(|e| format!("cannot read {}: {e}", folder.display()))?;
    let mut files = entries.map(|entry| Ok(entry?.path())).collect::<Fallible<Vec<_>>>()?;
    files.retain(|path| path.extension().is_some_and(|own| own == ending));
    files.sort();
    Ok(files)
}
