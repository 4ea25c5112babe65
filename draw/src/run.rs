//! The picture of a run: the momentum, and the drift of energy, spatial momentum and Casimirs.

use crate::axis::Axis;
pub use crate::curves::Channel;
use crate::curves::{self, Window, largest, peaks, range, thinned, window};
use crate::panel::{Curve, Panel, Place, RIGHT, Swatch, WIDTH, heading, legend, paragraph};
use crate::style::Style;
use crate::svg::Svg;

/// Differences below this, and zero, which has no logarithm, are drawn here.
const FLOOR: i32 = -17;

/// A run, recorded at some times.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// The method, such as `K = 7, exp`.
    pub label: String,
    /// The times of the records.
    pub times: Vec<f64>,
    /// The coordinates of the momentum.
    pub momentum: Vec<Channel>,
    /// Relative differences of conserved quantities from the start; the names are those of panels.
    pub drifts: Vec<Channel>,
}

/// The label of an axis of time.
fn time_label(unit: Option<&str>) -> String {
    unit.map_or("time".to_owned(), |unit| format!("time ({unit})"))
}

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
    pub runs: Vec<Recording>,
}

/// The picture as the text of an SVG file.
pub fn render(picture: &Picture) -> String {
    let time_unit = picture.time_unit.as_deref();
    let times = picture.runs.iter().flat_map(|run| &run.times);
    let across = curves::range(times).unwrap_or((0.0, 1.0));
    let several = picture.runs.len() > 1;
    let motion =
        picture.runs.first().map(|run| motion_panels(run, several, across, time_unit, COLUMNS));
    let motion = motion.unwrap_or_default();
    let drifts = drift_panels(&picture.runs, across, time_unit);
    let left = motion.iter().chain(&drifts).map(|panel| panel.left()).fold(60.0, f64::max);

    let mut svg = Svg::default();
    let mut y = heading(&mut svg, &picture.name, &picture.settings, left) + 14.0;
    for panel in &motion {
        y = panel.draw(&mut svg, Place::below(y, left));
    }
    if several && !drifts.is_empty() {
        let names = picture.runs.iter().enumerate();
        let names: Vec<(Swatch, String)> =
            names.map(|(i, run)| (Swatch::Stroke(Style::new(i)), run.label.clone())).collect();
        y = legend(&mut svg, &names, (left, WIDTH - RIGHT), y) + 6.0;
    }
    if !drifts.is_empty() {
        y = paragraph(&mut svg, NOTE, (left, WIDTH - RIGHT), y) + 12.0;
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

/// The largest number of panels; with more units than this all coordinates share one, and their names carry the units.
const MOST_PANELS: usize = 3;

/// The coordinates of the momentum over the time of `across`, a panel for each unit among them. Where
/// they turn round too often to be told apart, only the beginning is shown, which a note then says.
pub fn motion_panels(
    run: &Recording,
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
    let groups: Vec<Vec<&Channel>> = match units.len() {
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
    shown.into_iter().map(|(shown, rest)| motion_panel(run, named, &time, &shown, &rest)).collect()
}

/// The time of the panels.
struct Time<'a> {
    /// The first and the last time of the picture.
    across: (f64, f64),
    unit: Option<&'a str>,
    part: Window,
    /// Stretches of time with two points of a curve each.
    columns: usize,
}

fn motion_panel(
    run: &Recording,
    named: bool,
    &Time { across, unit: time_unit, part, columns }: &Time<'_>,
    shown: &[&Channel],
    rest: &[&Channel],
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
    let name = |series: &Channel| match &series.unit {
        Some(unit) if !same => format!("{} ({unit})", series.name),
        _ => series.name.clone(),
    };
    let mut legend: Vec<(Swatch, String)> = Vec::new();
    let mut curves = Vec::new();
    for (i, series) in shown.iter().enumerate() {
        let (name, style) = (name(series), Style::new(i));
        legend.push((Swatch::Stroke(style), name.clone()));
        let points = thinned(times, &series.values, columns);
        curves.push(Curve::line(name, style, points));
    }
    let band = band(times, rest, columns);
    if !rest.is_empty() {
        let text = format!("{} more, from their least to their greatest", rest.len());
        legend.push((Swatch::Band, text));
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
fn band(times: &[f64], series: &[&Channel], columns: usize) -> Vec<(f64, f64)> {
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

/// Stretches of time with one point each: fewer than pixels, so that dashes show.
const STRETCHES: usize = 260;
/// The axis reaches at least this far up.
const LOWEST_TOP: i32 = -14;

/// The note about all panels of drifts.
const NOTE: &str = "Below: largest differences from the start in successive stretches of time, relative to the \
     start, on logarithmic axes. Zero and everything below 1e-17 is drawn at 1e-17.";

/// A panel for each quantity that one of the runs conserves, with a curve for each run that does.
pub fn drift_panels(runs: &[Recording], across: (f64, f64), time_unit: Option<&str>) -> Vec<Panel> {
    let mut names: Vec<&str> = Vec::new();
    for drift in runs.iter().flat_map(|run| &run.drifts) {
        if !names.contains(&drift.name.as_str()) {
            names.push(&drift.name);
        }
    }
    names.into_iter().map(|name| drift_panel(name, runs, across, time_unit)).collect()
}

fn drift_panel(
    name: &str,
    runs: &[Recording],
    across: (f64, f64),
    time_unit: Option<&str>,
) -> Panel {
    let of = |run: &'_ Recording| run.drifts.iter().position(|drift| drift.name == name);
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
