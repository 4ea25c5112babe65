//! Panels from curves, as `figures.toml` describes them.

use coadjoint_draw::curves::{peaks, thinned};
use coadjoint_draw::{Axis, Curve as Line, Panel, Style, unbeaten};
use serde::Deserialize;

use crate::outcome::{Curve, Report};

/// Panels with the same axes, of columns of one curve over its first column.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Panels {
    curve: String,
    draw: Draw,
    /// The number of first records that are drawn.
    first: Option<usize>,
    /// Larger values are left out.
    most: Option<f64>,
    across: String,
    x: Lay,
    y: Lay,
    panels: Vec<Lines>,
}

/// A heading, and for each line its column and its name; a third word makes it markers in the style of the line before.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Lines {
    heading: String,
    lines: Vec<Vec<String>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Draw {
    Line,
    /// The greatest size in each stretch of time; the start, where all is 0, is left out.
    Peaks,
    /// The greatest and the least value in each stretch of time, longer than an oscillation.
    Range,
    /// The differences from the first value.
    Change,
    Marked,
    /// Operations over errors: the unbeaten ones of the method whose number stands in place of a column.
    Cost,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Lay {
    /// Linear from 0 on.
    Zero,
    /// Linear around all values, and 0 if so.
    Around(bool),
    /// Logarithmic around all values.
    Log,
    /// Logarithmic from a decade on, below which values cannot be told, to at least another one.
    Floor(i32, i32),
}

impl Lay {
    fn axis(self, values: &[f64]) -> Axis {
        match self {
            Self::Zero => Axis::linear(0.0, values.iter().copied().fold(0.0, f64::max), 6),
            Self::Around(zero) => Axis::around(values, zero, 5),
            Self::Log => Axis::logarithmic_around(values, 1e-300, 7),
            Self::Floor(low, top) => Axis::floored(values, (low, top), 6),
        }
    }
}

/// Errors below this are rounding.
const ROUNDING: f64 = 1e-16;

impl Panels {
    /// Its panels; lines of columns that are not there are left out.
    pub fn draw(&self, report: &Report) -> Vec<Panel> {
        let curve = report.curve(&self.curve);
        let panels = self.panels.iter().map(|panel| (&panel.heading, self.lines(panel, &curve)));
        let panels: Vec<(&String, Vec<Line>)> = panels.collect();
        let points = || panels.iter().flat_map(|(_, lines)| lines).flat_map(|line| &line.points);
        let mut places: Vec<f64> = points().map(|point| point.0).collect();
        if matches!(self.x, Lay::Zero) {
            // Up to the end of the run, which need be no peak.
            let end = self.first.unwrap_or(usize::MAX).min(curve.rows.len());
            places.extend(curve.rows[..end].last().map(|row| row[0]));
        }
        let x = self.x.axis(&places);
        let y = self.y.axis(&points().map(|point| point.1).collect::<Vec<_>>());
        let panel = |(heading, curves): (&String, Vec<Line>)| {
            let (heading, across) = (heading.clone(), self.across.clone());
            let (x, y) = (x.clone(), y.clone());
            Panel { heading, across, x, y, curves, ..Panel::default() }.with_legend()
        };
        panels.into_iter().map(panel).collect()
    }

    fn lines(&self, panel: &Lines, curve: &Curve) -> Vec<Line> {
        let mut lines: Vec<Line> = Vec::new();
        let mut style = 0;
        for words in &panel.lines {
            let markers = words.len() > 2;
            let marked = markers || matches!(self.draw, Draw::Marked | Draw::Cost);
            for (i, mut points) in self.points(curve, &words[0]).into_iter().enumerate() {
                points.retain(|point| self.most.is_none_or(|most| point.1 <= most));
                if points.is_empty() {
                    continue;
                }
                style += usize::from(!markers);
                let name =
                    if self.draw == Draw::Range { ["greatest", "least"][i] } else { &words[1] };
                let (name, style) = (name.to_owned(), Style::new(style - 1));
                lines.push(Line { name, style, joined: !markers, marked, points });
            }
        }
        lines
    }

    /// The points of a column; for a range those of both ends.
    fn points(&self, curve: &Curve, column: &str) -> Vec<Vec<(f64, f64)>> {
        let x = curve.columns.first().map(|name| curve.column(name)).unwrap_or_default();
        let y = curve.column(column);
        let count = self.first.unwrap_or(usize::MAX);
        let pairs = || x.iter().copied().zip(y.iter().copied()).take(count);
        vec![match self.draw {
            Draw::Line => pairs().collect(),
            Draw::Marked => {
                let finite = pairs().filter(|point| point.1.is_finite());
                finite.map(|(x, y)| (x, y.max(ROUNDING))).collect()
            }
            Draw::Change => {
                let moved: Vec<f64> = y.iter().map(|value| value - y[0]).collect();
                thinned(&x, &moved, 220)
            }
            Draw::Peaks => {
                let sizes: Vec<f64> = y.iter().skip(1).map(|v| v.abs()).collect();
                peaks(&x[1.min(x.len())..], &sizes, 170)
            }
            Draw::Range => {
                let low: Vec<f64> = y.iter().map(|value| -value).collect();
                let least = peaks(&x, &low, 60).into_iter().map(|(t, v)| (t, -v));
                return vec![peaks(&x, &y, 60), least.collect()];
            }
            Draw::Cost => {
                let own = curve.rows.iter().filter(|row| row[0].to_string() == column);
                let own = own.filter(|row| row[2] < 1.0);
                // Steps so small that rounding accumulates are of no use.
                unbeaten(own.map(|row| (row[2].max(ROUNDING), row[3])).collect())
            }
        }]
    }
}
