//! The panels of drifts, with logarithmic axes.

use super::{FLOOR, Run, time_label};
use crate::axis::Axis;
use crate::curves::peaks;
use crate::panel::{Curve, Panel};
use crate::style::Style;

/// Stretches of time with one point each: fewer than pixels, so that dashes show.
const STRETCHES: usize = 260;
/// The axis reaches at least this far up.
const LOWEST_TOP: i32 = -14;

/// The note about all panels of drifts.
pub(crate) const NOTE: &str = "Below: largest differences from the start in successive stretches of time, relative to the \
     start, on logarithmic axes. Zero and everything below 1e-17 is drawn at 1e-17.";

/// A panel for each quantity that one of the runs conserves, with a curve for each run that does.
#[must_use]
pub fn panels(runs: &[Run], across: (f64, f64), time_unit: Option<&str>) -> Vec<Panel> {
    let mut names: Vec<&str> = Vec::new();
    for drift in runs.iter().flat_map(|run| &run.drifts) {
        if !names.contains(&drift.name.as_str()) {
            names.push(&drift.name);
        }
    }
    names.into_iter().map(|name| panel(name, runs, across, time_unit)).collect()
}

fn panel(name: &str, runs: &[Run], across: (f64, f64), time_unit: Option<&str>) -> Panel {
    let of = |run: &'_ Run| run.drifts.iter().position(|drift| drift.name == name);
    let values = runs.iter().filter_map(|run| Some(&run.drifts[of(run)?].values)).flatten();
    let y = Axis::floored(values, (FLOOR, LOWEST_TOP), 7);
    let mut curves = Vec::new();
    for (i, run) in runs.iter().enumerate() {
        let Some(at) = of(run) else { continue };
        // The start, where every difference is zero, is left out.
        let (times, values) = (&run.times, &run.drifts[at].values);
        let from = 1.min(times.len().min(values.len()));
        let points = peaks(&times[from..], &values[from..], STRETCHES);
        curves.push(Curve::line(&run.label, Style::new(i), points));
    }
    Panel {
        heading: format!("relative drift of {name}"),
        across: time_label(time_unit),
        x: Axis::linear(across.0, across.1, 8),
        y,
        curves,
        ..Panel::default()
    }
}
