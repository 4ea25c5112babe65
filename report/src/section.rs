//! A figure or a table of the page.

use coadjoint_draw::{Axis, Curve as Line, Panel, Style};
use coadjoint_learn::experiment::{Cell, Curve, Judgement, Report, Table};

/// A figure or a table: what the paper shows, what came out, and what judges it.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// Its identifier, one of [`FIGURES`](crate::FIGURES).
    pub id: &'static str,
    /// Its title.
    pub title: String,
    /// System and settings, each a short text.
    pub settings: Vec<String>,
    /// Whether it is of the paper; else it is ours.
    pub of_paper: bool,
    /// What the paper shows, or why we show it.
    pub shows: String,
    /// What the paper leaves open, and what stands in its place.
    pub silent: String,
    /// What came out, in words.
    pub out: String,
    /// The panels.
    pub panels: Vec<Panel>,
    /// The tables.
    pub tables: Vec<Table>,
    /// The numbers by which it is judged.
    pub judgements: Vec<Judgement>,
}

impl Section {
    /// A section of this report, with the judgements of this identifier.
    pub(crate) fn of(report: &Report, id: &'static str, title: &str) -> Self {
        let own = |judgement: &&Judgement| judgement.figure == id;
        Self {
            id,
            title: title.to_owned(),
            of_paper: true,
            judgements: report.judgements.iter().filter(own).cloned().collect(),
            ..Self::default()
        }
    }

    /// Whether every number is what it must be.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.judgements.iter().all(Judgement::holds)
    }
}

/// The rigid body of the paper.
pub(crate) const BODY: &str = "rigid body, I = (1.5, 2, 2.5)";

/// The curve of this name; an empty one if there is none.
pub(crate) fn curve(report: &Report, name: &str) -> Curve {
    let found = report.curves.iter().find(|curve| curve.name == name).cloned();
    found.unwrap_or_else(|| Curve { name: name.to_owned(), columns: Vec::new(), rows: Vec::new() })
}

/// Two columns as points.
pub(crate) fn points(curve: &Curve, x: &str, y: &str) -> Vec<(f64, f64)> {
    curve.column(x).into_iter().zip(curve.column(y)).collect()
}

/// Curves over time on a logarithmic axis with this floor, as powers of ten.
pub(crate) fn over_time(heading: &str, end: f64, curves: Vec<Line>, floor: (i32, i32)) -> Panel {
    let panel = Panel {
        heading: heading.to_owned(),
        across: "time (s)".to_owned(),
        x: Axis::linear(0.0, end, 6),
        y: Axis::floored(&values(&curves), floor, 6),
        curves,
        ..Panel::default()
    };
    panel.with_legend()
}

/// Stretches of time with one point each.
const STRETCHES: usize = 170;

/// The greatest size in each stretch of time, as a line; the start, where all is 0, is left out.
pub(crate) fn peaks(curve: &Curve, x: &str, y: &str, name: &str, style: usize) -> Line {
    let times = curve.column(x);
    let sizes: Vec<f64> = curve.column(y).into_iter().map(f64::abs).collect();
    let from = 1.min(times.len());
    let points = coadjoint_draw::curves::peaks(&times[from..], &sizes[from..], STRETCHES);
    Line::line(name, Style::new(style), points)
}

/// The values of lines.
pub(crate) fn values(lines: &[Line]) -> Vec<f64> {
    lines.iter().flat_map(|line| line.points.iter().map(|point| point.1)).collect()
}

/// The places of lines.
pub(crate) fn places(lines: &[Line]) -> Vec<f64> {
    lines.iter().flat_map(|line| line.points.iter().map(|point| point.0)).collect()
}

/// A figure of a table: that of the first row whose first cell begins with `row`.
pub(crate) fn figure(table: Option<&Table>, row: &str, column: usize) -> String {
    let found = table.and_then(|table| {
        table
            .rows
            .iter()
            .find(|cells| matches!(&cells[0], Cell::Text(name) if name.starts_with(row)))
    });
    found.and_then(|cells| cells.get(column)).map_or_else(|| "–".to_owned(), Cell::shown)
}
