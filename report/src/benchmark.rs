//! What the benchmark `work` measured: its JSON files, read and drawn.

use std::path::{Path, PathBuf};

use coadjoint_draw::{Axis, Curve as Line, Panel, Style, unbeaten};
use coadjoint_learn::experiment::{Cell, Table};
use serde::Deserialize;

use crate::section::{Section, places, values};

/// Why the benchmark's files cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum BenchmarkError {
    /// A folder or a file that cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file that is not the benchmark's.
    #[error("{}: {source}; the files are written by `coadjoint-bench work --out DIR`", path.display())]
    Format {
        /// Which.
        path: PathBuf,
        /// Why.
        source: serde_json::Error,
    },
    /// A folder without such files.
    #[error("{}: no file NAME.json in it; they are written by `coadjoint-bench work --out DIR`", path.display())]
    Empty {
        /// The folder.
        path: PathBuf,
    },
}

/// The measurements on one problem.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Benchmark {
    /// The problem’s title.
    pub title: String,
    /// The end of its interval.
    pub end: f64,
    /// The measurements.
    pub measurements: Vec<Measurement>,
    machine: Machine,
}

/// A setting of a method with the error it reaches and its cost.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Measurement {
    /// The name under which the method and its kin are drawn.
    pub family: String,
    /// The error at the end.
    pub error: f64,
    /// Nanoseconds of one core per unit of time.
    pub nanoseconds: f64,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
struct Machine {
    processor: String,
}

/// Reads every `NAME.json` in a folder, in the order of their names.
///
/// # Errors
/// Where there is none, or one is no file of the benchmark.
pub fn read_benchmarks(folder: &Path) -> Result<Vec<Benchmark>, BenchmarkError> {
    let read = |path: &Path| {
        let path = path.to_owned();
        move |source| BenchmarkError::Read { path, source }
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(read(folder))? {
        let path = entry.map_err(read(folder))?.path();
        if path.extension().is_some_and(|ending| ending == "json") {
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() {
        return Err(BenchmarkError::Empty { path: folder.to_owned() });
    }
    let mut found = Vec::new();
    for path in files {
        let text = std::fs::read_to_string(&path).map_err(read(&path))?;
        found.push(
            serde_json::from_str(&text)
                .map_err(|source| BenchmarkError::Format { path, source })?,
        );
    }
    Ok(found)
}

/// So many families are drawn, those that are cheapest somewhere first.
const SHOWN: usize = 8;
/// Errors that are compared.
const TARGETS: [f64; 4] = [1e-5, 1e-7, 1e-9, 1e-11];

/// The section of the benchmark; none where nothing was measured.
pub fn section(benchmarks: &[Benchmark]) -> Option<Section> {
    let first = benchmarks.first()?;
    Some(Section {
        id: "benchmark",
        title: "Work against precision, timed".to_owned(),
        settings: vec![first.machine.processor.clone(), "one core".to_owned()],
        shows: "Nanoseconds of one core per unit of time for an error at the end, ours beside other methods, as \
            the benchmark measured it. Of each family only points that no other of its points beats are drawn; of \
            the families those eight that are cheapest."
            .to_owned(),
        out: "Lower and further left is better; the table has all families.".to_owned(),
        panels: benchmarks.iter().map(panel).collect(),
        tables: benchmarks.iter().map(table).collect(),
        ..Section::default()
    })
}

/// Points that no other of the same family beats, by growing error.
fn families(benchmark: &Benchmark) -> Vec<(String, Vec<(f64, f64)>)> {
    let mut families: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for row in &benchmark.measurements {
        if !(1e-14..=1e-2).contains(&row.error) {
            continue;
        }
        let point = (row.error, row.nanoseconds);
        match families.iter_mut().find(|(name, _)| *name == row.family) {
            Some((_, points)) => points.push(point),
            None => families.push((row.family.clone(), vec![point])),
        }
    }
    for (_, points) in &mut families {
        *points = unbeaten(std::mem::take(points));
    }
    families
}

fn cheapest(points: &[(f64, f64)], target: f64) -> Option<f64> {
    points.iter().filter(|point| point.0 <= target).map(|point| point.1).min_by(f64::total_cmp)
}

fn panel(benchmark: &Benchmark) -> Panel {
    let mut all = families(benchmark);
    let rank = |points: &[(f64, f64)]| {
        let costs = TARGETS.iter().filter_map(|&target| cheapest(points, target));
        costs.fold(f64::INFINITY, f64::min)
    };
    all.sort_by(|a, b| rank(&a.1).total_cmp(&rank(&b.1)));
    all.truncate(SHOWN);
    let lines = all.into_iter().enumerate();
    let curves: Vec<Line> =
        lines.map(|(i, (name, points))| Line::marked(name, Style::new(i), points)).collect();
    let panel = Panel {
        heading: format!("{}, T = {}: ns per unit of time", benchmark.title, benchmark.end),
        across: "error at T".to_owned(),
        x: Axis::logarithmic_around(&places(&curves), 1e-300, 6),
        y: Axis::logarithmic_around(&values(&curves), 1e-300, 6),
        curves,
        ..Panel::default()
    };
    panel.with_legend()
}

fn table(benchmark: &Benchmark) -> Table {
    let title = format!("{}, T = {}: ns per unit of time", benchmark.title, benchmark.end);
    let mut table = Table::new(title, &["family", "1e-5", "1e-7", "1e-9", "1e-11"]);
    for (name, points) in families(benchmark) {
        let cells = TARGETS.iter().map(|&target| Cell::from(cheapest(&points, target)));
        table.push(std::iter::once(name.into()).chain(cells).collect());
    }
    table
}
