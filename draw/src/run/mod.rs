//! The picture of a run: the momentum, its orbit, and the drift of energy, spatial momentum and Casimirs.

mod data;
pub mod drift;
pub mod motion;
pub mod orbit;

use crate::curves;
use crate::panel::{Place, RIGHT, Sample, WIDTH, legend, paragraph};
use crate::sheet::heading;
use crate::style::Style;
use crate::svg::Svg;

pub(crate) use data::time_label;
pub use data::{FLOOR, Run, Series};

/// Stretches of time with two points of a curve each.
const COLUMNS: usize = 400;

/// The contents of a picture: runs of one system.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// The name of the system.
    pub name: String,
    /// Group, chart, truncation, step, duration: each a short text.
    pub settings: Vec<String>,
    /// The unit of time.
    pub time_unit: Option<String>,
    /// The runs; the momentum is that of the first.
    pub runs: Vec<Run>,
}

/// The picture as the text of an SVG file.
#[must_use]
pub fn render(picture: &Picture) -> String {
    let time_unit = picture.time_unit.as_deref();
    let times = picture.runs.iter().flat_map(|run| &run.times);
    let across = curves::range(times).unwrap_or((0.0, 1.0));
    let several = picture.runs.len() > 1;
    let motion =
        picture.runs.first().map(|run| motion::panels(run, several, across, time_unit, COLUMNS));
    let motion = motion.unwrap_or_default();
    let drifts = drift::panels(&picture.runs, across, time_unit);
    let left = motion.iter().chain(&drifts).map(|panel| panel.left()).fold(60.0, f64::max);

    let mut svg = Svg::default();
    let mut y = heading(&mut svg, &picture.name, &picture.settings, left) + 14.0;
    for panel in &motion {
        y = panel.draw(&mut svg, Place::below(y, left));
    }
    if several && !drifts.is_empty() {
        let names = picture.runs.iter().enumerate();
        let names: Vec<(Sample, String)> =
            names.map(|(i, run)| (Sample::Stroke(Style::new(i)), run.label.clone())).collect();
        y = legend(&mut svg, &names, (left, WIDTH - RIGHT), y) + 6.0;
    }
    if !drifts.is_empty() {
        y = paragraph(&mut svg, drift::NOTE, (left, WIDTH - RIGHT), y) + 12.0;
    }
    for panel in &drifts {
        y = panel.draw(&mut svg, Place::below(y, left));
    }
    let name = format!("{}: momentum and drift of what is conserved", picture.name);
    svg.finish((WIDTH, y + 8.0), &name, &description(picture))
}

/// The picture in words, for readers who cannot see it.
fn description(picture: &Picture) -> String {
    let mut text = format!(
        "{} ({}). First panel: the body momentum over time. Further panels, on logarithmic axes: the \
         relative drift of what each run conserves.",
        picture.name,
        picture.settings.join(", ")
    );
    for run in &picture.runs {
        let largest = run.drifts.iter().map(|drift| {
            let largest = curves::range(&drift.values).map_or(0.0, |(_, high)| high);
            format!("{} {largest:.1e}", drift.name)
        });
        let largest: Vec<String> = largest.collect();
        text.push_str(&format!(" {}: largest drift of {}.", run.label, largest.join(", ")));
    }
    text
}
