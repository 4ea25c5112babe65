//! The panels of the momentum.

use super::{Run, Series, time_label};
use crate::axis::Axis;
use crate::curves::{Window, largest, range, thinned, window};
use crate::panel::{Curve, Panel, Sample};
use crate::style::Style;

/// With more units than this all coordinates share a panel, their units beside their names.
const MOST_PANELS: usize = 3;

/// The coordinates of the momentum over the time of `across`, a panel for each unit among them. Where
/// they turn round too often to be told apart, only the beginning is shown, which a note then says.
#[must_use]
pub fn panels(
    run: &Run,
    named: bool,
    across: (f64, f64),
    time_unit: Option<&str>,
    columns: usize,
) -> Vec<Panel> {
    let mut units: Vec<Option<&str>> = Vec::new();
    for unit in run.momentum.iter().map(|series| series.unit.as_deref()) {
        if !units.contains(&unit) {
            units.push(unit);
        }
    }
    let groups: Vec<Vec<&Series>> = match units.len() {
        2..=MOST_PANELS => {
            let of = |unit| run.momentum.iter().filter(|s| s.unit.as_deref() == unit).collect();
            units.iter().map(|&unit| of(unit)).collect()
        }
        _ => vec![run.momentum.iter().collect()],
    };
    let shown: Vec<_> = groups.iter().map(|group| largest(group)).collect();
    // All panels show the same time.
    let parts = shown.iter().map(|(shown, _)| window(shown, &run.times));
    let parts: Vec<Window> = parts.collect();
    let records = parts.iter().map(|part| part.records).min().unwrap_or(0);
    let resolved = parts.iter().all(|part| part.resolved);
    let part = Window { records, resolved };
    let time = Time { across, unit: time_unit, part, columns };
    shown.into_iter().map(|(shown, rest)| panel(run, named, &time, &shown, &rest)).collect()
}

/// The time of the panels.
struct Time<'a> {
    /// That of the whole picture.
    across: (f64, f64),
    unit: Option<&'a str>,
    part: Window,
    /// Stretches of time with two points of a curve each.
    columns: usize,
}

fn panel(
    run: &Run,
    named: bool,
    &Time { across, unit: time_unit, part, columns }: &Time<'_>,
    shown: &[&Series],
    rest: &[&Series],
) -> Panel {
    let times = &run.times[..part.records];
    let mut notes = Vec::new();
    let mut x = across;
    if part.records < run.times.len() {
        x = range(times).unwrap_or(across);
        let (end, all) = (brief(x.0, x.1), brief(across.0, across.1));
        let unit = time_unit.map(|unit| format!(" {unit}")).unwrap_or_default();
        notes.push(format!(
            "The first {end}{unit} of {all}{unit}: over all of it the oscillations would run together."
        ));
    }
    if !part.resolved {
        notes.push(
            "The records are too far apart to follow every oscillation: lines only join them. \
             Record more often to see the motion."
                .to_owned(),
        );
    }
    let all = || shown.iter().chain(rest).copied();
    let common = all().next().and_then(|first| first.unit.as_deref());
    let same = all().all(|series| series.unit.as_deref() == common);
    let mut heading = "Body momentum".to_owned();
    match (same, common) {
        (true, Some(unit)) => heading.push_str(&format!(" ({unit})")),
        (true, None) => {}
        (false, _) => heading.push_str(" (units beside the names)"),
    }
    if named {
        heading.push_str(&format!(", {}", run.label));
    }
    let name = |series: &Series| match &series.unit {
        Some(unit) if !same => format!("{} ({unit})", series.name),
        _ => series.name.clone(),
    };
    let mut legend: Vec<(Sample, String)> = Vec::new();
    let mut curves = Vec::new();
    for (i, series) in shown.iter().enumerate() {
        let (name, style) = (name(series), Style::new(i));
        legend.push((Sample::Stroke(style), name.clone()));
        let points = thinned(times, &series.values, columns);
        curves.push(Curve::line(name, style, points));
    }
    let band = band(times, rest, columns);
    if !rest.is_empty() {
        let text = format!("{} more, from their least to their greatest", rest.len());
        legend.push((Sample::Band, text));
        let (count, all) = (shown.len(), shown.len() + rest.len());
        notes.insert(0, format!("Drawn by name: the {count} of {all} coordinates that vary most."));
    }
    let values = all().flat_map(|s| &s.values[..part.records.min(s.values.len())]);
    let (low, high) = range(values).map_or((0.0, 0.0), |(low, high)| (low.min(0.0), high.max(0.0)));
    let margin = 0.12 * (high / 2.0 - low / 2.0);
    Panel {
        heading,
        notes,
        legend,
        across: time_label(time_unit),
        x: Axis::linear(x.0, x.1, 8),
        y: Axis::linear(low - margin, high + margin, 5),
        band,
        curves,
    }
}

/// The length of a range of time, in few digits.
fn brief(low: f64, high: f64) -> String {
    let text = format!("{:.3e}", high - low);
    text.parse::<f64>().map_or(text, |short| short.to_string())
}

/// The outline of everything between the least and the greatest of the curves: the upper edge
/// forwards, the lower edge backwards.
fn band(times: &[f64], series: &[&Series], columns: usize) -> Vec<(f64, f64)> {
    if series.is_empty() {
        return Vec::new();
    }
    let (mut upper, mut lower) = (Vec::new(), Vec::new());
    let count = times.len();
    let stretch = count.div_ceil(columns).max(1);
    for first in (0..count).step_by(stretch) {
        let inside = first..(first + stretch).min(count);
        let values = series.iter().flat_map(|s| s.values.get(inside.clone()).unwrap_or_default());
        let Some((low, high)) = range(values) else { continue };
        // An edge from the first to the last moment of the stretch, so that the ends are covered.
        for time in [times[inside.start], times[inside.end - 1]] {
            if time.is_finite() {
                upper.push((time, high));
                lower.push((time, low));
            }
        }
    }
    upper.extend(lower.into_iter().rev());
    upper
}
