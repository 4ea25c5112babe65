//! The picture of a run: the momentum, its orbit, and the drift of energy, spatial momentum and Casimirs.

use crate::axis::Axis;
pub use crate::curves::Series;
use crate::curves::{self, Window, largest, peaks, range, thinned, window};
use crate::panel::{Curve, Panel, Place, RIGHT, Sample, WIDTH, heading, legend, paragraph};
use crate::style::Style;
use crate::svg::Svg;

/// Differences below this, and zero, which has no logarithm, are drawn here.
const FLOOR: i32 = -17;

/// A run, recorded at some times.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// The method, such as `K = 7, exp`.
    pub label: String,
    /// The times of the records.
    pub times: Vec<f64>,
    /// The coordinates of the momentum.
    pub momentum: Vec<Series>,
    /// Relative differences of conserved quantities from the start; the names are those of panels.
    pub drifts: Vec<Series>,
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
    pub runs: Vec<Run>,
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
        let names: Vec<(Sample, String)> =
            names.map(|(i, run)| (Sample::Stroke(Style::new(i)), run.label.clone())).collect();
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

/// With more units than this all coordinates share a panel, their units beside their names.
const MOST_PANELS: usize = 3;

/// The coordinates of the momentum over the time of `across`, a panel for each unit among them. Where
/// they turn round too often to be told apart, only the beginning is shown, which a note then says.
pub fn motion_panels(
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
    shown.into_iter().map(|(shown, rest)| motion_panel(run, named, &time, &shown, &rest)).collect()
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

fn motion_panel(
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

/// Points of a curve.
const POINTS: usize = 500;
/// The direction from which a sphere is looked at.
const EYE: [f64; 3] = [0.62, 0.55, 0.56];
/// A motion is on a sphere if its distance from the centre varies relatively by no more than this.
const ROUND: f64 = 1e-9;

/// The panel of the first run, for a frame as wide as it is high times `aspect`; `None` of fewer than two coordinates.
pub fn orbit_panel(picture: &Picture, aspect: f64) -> Option<Panel> {
    let run = picture.runs.first()?;
    match run.momentum.as_slice() {
        [x, y, z] if round([x, y, z]) => Some(sphere([x, y, z], aspect)),
        [_, _, ..] => plane(&run.momentum, aspect),
        _ => None,
    }
}

fn round(coordinates: [&Series; 3]) -> bool {
    let [x, y, z] = coordinates.map(|series| &series.values);
    let radii: Vec<f64> = x.iter().zip(y).zip(z).map(|((x, y), z)| x.hypot(*y).hypot(*z)).collect();
    range(&radii).is_some_and(|(low, high)| high > 0.0 && high - low <= ROUND * high)
}

/// Axes of the same scale around these ranges.
fn axes(x: (f64, f64), y: (f64, f64), aspect: f64) -> (Axis, Axis) {
    let wide = 1.12 * (x.1 - x.0).max((y.1 - y.0) * aspect).max(1e-12 * x.1.abs().max(y.1.abs()));
    let around = |(low, high): (f64, f64), wide: f64| {
        let middle = low / 2.0 + high / 2.0;
        Axis::linear(middle - wide / 2.0, middle + wide / 2.0, 5)
    };
    (around(x, wide), around(y, wide / aspect))
}

/// The marker of the start.
fn start_of(points: Vec<(f64, f64)>) -> Curve {
    Curve { joined: false, marked: true, ..Curve::line("start", Style::new(4), points) }
}

/// The stride between records drawn, so that not too many are drawn.
fn some<T: Copy>(points: &[T]) -> Vec<T> {
    let stride = points.len().div_ceil(POINTS).max(1);
    let mut some: Vec<T> = points.iter().step_by(stride).copied().collect();
    some.extend(points.last());
    some
}

fn plane(momentum: &[Series], aspect: f64) -> Option<Panel> {
    let unit = |series: &Series| series.unit.clone();
    // Two coordinates of the same unit, if there are such among those that vary most.
    let (shown, _) = largest(&momentum.iter().collect::<Vec<_>>());
    let variation = |series: &Series| range(&series.values).map_or(0.0, |(a, b)| b / 2.0 - a / 2.0);
    let mut order = shown;
    order.sort_by(|a, b| variation(b).total_cmp(&variation(a)));
    let first = *order.first()?;
    let second = order[1..].iter().find(|other| unit(other) == unit(first)).or(order.get(1))?;
    let points: Vec<(f64, f64)> =
        first.values.iter().copied().zip(second.values.iter().copied()).collect();
    let points = some(&points);
    let ranges = (range(points.iter().map(|p| &p.0))?, range(points.iter().map(|p| &p.1))?);
    let (x, y) = axes(ranges.0, ranges.1, aspect);
    let named = |series: &Series| match &series.unit {
        Some(unit) => format!("{} ({unit})", series.name),
        None => series.name.clone(),
    };
    let start = points.first().copied().into_iter().collect();
    Some(Panel {
        heading: format!("Orbit: {} against {}", named(second), first.name),
        across: named(first),
        x,
        y,
        curves: vec![Curve::line("orbit", Style::new(0), points), start_of(start)],
        legend: vec![(Sample::Marker(Style::new(4)), "start".to_owned())],
        ..Panel::default()
    })
}

fn sphere(coordinates: [&Series; 3], aspect: f64) -> Panel {
    let [x, y, z] = coordinates;
    let norm = EYE.iter().map(|e| e * e).sum::<f64>().sqrt();
    let eye = EYE.map(|e| e / norm);
    // To the right: horizontal, square to the eye; up: square to both.
    let flat = eye[0].hypot(eye[1]);
    let right = [-eye[1] / flat, eye[0] / flat, 0.0];
    let up = [
        eye[1] * right[2] - eye[2] * right[1],
        eye[2] * right[0] - eye[0] * right[2],
        eye[0] * right[1] - eye[1] * right[0],
    ];
    let along = |direction: [f64; 3], point: [f64; 3]| -> f64 {
        direction.iter().zip(point).map(|(d, p)| d * p).sum()
    };
    let points: Vec<[f64; 3]> =
        x.values.iter().zip(&y.values).zip(&z.values).map(|((x, y), z)| [*x, *y, *z]).collect();
    let radius = points.first().map_or(1.0, |p| along(*p, *p).sqrt());
    let seen = |p: [f64; 3]| (along(right, p), along(up, p));
    let circle = |of: &dyn Fn(f64, f64) -> [f64; 3]| -> Vec<(f64, f64)> {
        let angle = |k: u32| f64::from(k) / 48.0 * std::f64::consts::PI;
        (0..=96).map(|k| seen(of(radius * angle(k).cos(), radius * angle(k).sin()))).collect()
    };
    let outline = circle(&|c, s| [0, 1, 2].map(|i| c * right[i] + s * up[i]));
    let grey = Style::new(7).faint();
    let mut curves = vec![Curve::line("the coadjoint orbit", Style::new(7), outline)];
    curves.push(Curve::line("equator", grey, circle(&|c, s| [c, s, 0.0])));
    curves.push(Curve::line("meridian", grey, circle(&|c, s| [c, 0.0, s])));
    curves.push(Curve::line("meridian", grey, circle(&|c, s| [0.0, c, s])));
    // Pieces in front and behind.
    let drawn = some(&points);
    for piece in drawn.chunk_by(|a, b| (along(eye, *a) >= 0.0) == (along(eye, *b) >= 0.0)) {
        let front = piece.first().is_some_and(|p| along(eye, *p) >= 0.0);
        let style = if front { Style::new(0) } else { Style::new(0).faint() };
        curves.push(Curve::line("orbit", style, piece.iter().map(|p| seen(*p)).collect()));
    }
    let start = points.first().map(|p| seen(*p)).into_iter().collect();
    curves.push(start_of(start));
    let unit = x.unit.as_ref().map(|unit| format!(" ({unit})")).unwrap_or_default();
    let ends = (-radius, radius);
    let (across, upwards) = axes(ends, ends, aspect);
    Panel {
        heading: format!("Orbit on the sphere |μ| = {}{unit}", short(radius)),
        notes: vec![format!("Seen from ({}, {}, {}); paler: behind.", EYE[0], EYE[1], EYE[2])],
        across: format!("across the line of sight{unit}"),
        legend: vec![
            (Sample::Stroke(Style::new(0)), "momentum".to_owned()),
            (Sample::Marker(Style::new(4)), "start".to_owned()),
        ],
        x: across,
        y: upwards,
        curves,
        ..Panel::default()
    }
}

/// A number in four digits.
fn short(value: f64) -> String {
    format!("{value:.3e}").parse::<f64>().map_or_else(|_| value.to_string(), |v| v.to_string())
}

/// Stretches of time with one point each: fewer than pixels, so that dashes show.
const STRETCHES: usize = 260;
/// The axis reaches at least this far up.
const LOWEST_TOP: i32 = -14;

/// The note about all panels of drifts.
const NOTE: &str = "Below: largest differences from the start in successive stretches of time, relative to the \
     start, on logarithmic axes. Zero and everything below 1e-17 is drawn at 1e-17.";

/// A panel for each quantity that one of the runs conserves, with a curve for each run that does.
pub fn drift_panels(runs: &[Run], across: (f64, f64), time_unit: Option<&str>) -> Vec<Panel> {
    let mut names: Vec<&str> = Vec::new();
    for drift in runs.iter().flat_map(|run| &run.drifts) {
        if !names.contains(&drift.name.as_str()) {
            names.push(&drift.name);
        }
    }
    names.into_iter().map(|name| drift_panel(name, runs, across, time_unit)).collect()
}

fn drift_panel(name: &str, runs: &[Run], across: (f64, f64), time_unit: Option<&str>) -> Panel {
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
