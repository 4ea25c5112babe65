//! The motion, and the drift of energy, spatial momentum and Casimirs over time, as SVG.

use std::path::Path;

use plotters::coord::ranged1d::{KeyPointHint, Ranged};
use plotters::prelude::*;

use super::trajectory::{Drift, Trajectory};
use crate::error::CliError;

const WIDTH: u32 = 900;
/// The height of a panel.
const PANEL: u32 = 270;
/// The motion is shown over this many records, so that its oscillations can be told apart.
const SHOWN: usize = 400;
/// With more coordinates than this their names are left out.
const NAMED: usize = 8;
/// With more coordinates than this only the first few are drawn.
const MOST_LINES: usize = 32;
/// How many are drawn then.
const FEW_LINES: usize = 6;
/// The height of the strip that names the lines.
const LEGEND: i32 = 40;
/// Drawn for a difference of zero, which has no logarithm.
const SMALLEST: f64 = 1e-17;
/// More points than this cannot be told apart.
const MOST_POINTS: usize = 2000;
const COLORS: [RGBColor; 6] = [
    RGBColor(0, 90, 170),
    RGBColor(210, 100, 0),
    RGBColor(20, 140, 70),
    RGBColor(170, 40, 120),
    RGBColor(110, 90, 180),
    RGBColor(110, 110, 110),
];

/// A panel's title, what it shows, and whether a run conserves it.
type Quantity = (&'static str, fn(&Drift) -> f64, fn(&Trajectory) -> bool);

const PANELS: [Quantity; 3] = [
    ("energy", |drift| drift.energy, |_| true),
    ("spatial momentum", |drift| drift.spatial_momentum, |run| run.momenta > 0),
    ("Casimirs", |drift| drift.casimirs, |run| run.casimirs > 0),
];

/// Draws the motion of the first run, and a panel for each conserved quantity with a line for every
/// run.
pub fn draw(path: &Path, runs: &[Trajectory]) -> Result<(), CliError> {
    panels(path, runs)
        .map_err(|error| CliError::Write { path: path.to_owned(), message: error.to_string() })
}

fn panels(path: &Path, runs: &[Trajectory]) -> Result<(), Box<dyn std::error::Error>> {
    let conserved = PANELS.iter().filter(|(_, _, kept)| runs.iter().any(kept));
    let conserved: Vec<&Quantity> = conserved.collect();
    let count = conserved.len() as u32 + 1;
    let size = (WIDTH, LEGEND as u32 + PANEL * count);
    let root = SVGBackend::new(path, size).into_drawing_area();
    root.fill(&WHITE)?;
    let (top, body) = root.split_vertically(PANEL);
    if let Some(run) = runs.first() {
        motion(&top, run)?;
    }
    let (head, body) = body.split_vertically(LEGEND);
    legend(&head, runs)?;
    let areas = body.split_evenly((conserved.len(), 1));
    for (area, (title, quantity, _)) in areas.iter().zip(conserved) {
        panel(area, title, *quantity, runs)?;
    }
    root.present()?;
    Ok(())
}

/// The coordinates of the momentum over the first records.
fn motion(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    run: &Trajectory,
) -> Result<(), Box<dyn std::error::Error>> {
    let records = &run.records[..run.records.len().min(SHOWN)];
    let all = run.coordinates.len();
    let lines = if all > MOST_LINES { FEW_LINES } else { all };
    let values = || records.iter().flat_map(|record| record.momentum.iter().copied().take(lines));
    let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let margin = 0.06 * (high - low).max(f64::MIN_POSITIVE);
    let times = || records.iter().map(|record| record.time);
    let (first, last) = (times().fold(0.0, f64::min), times().fold(0.0, f64::max));
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .margin_top(LEGEND)
        .margin_right(34)
        .x_label_area_size(38)
        .y_label_area_size(64)
        .build_cartesian_2d(first..last, low - margin..high + margin)?;
    chart
        .configure_mesh()
        .x_desc("time")
        .label_style(("sans-serif", 14))
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .draw()?;
    let title = match lines {
        lines if lines < all => format!("momentum, {lines} of {all}"),
        _ => "momentum in the body".to_owned(),
    };
    area.draw(&Text::new(title, (76, 12), ("sans-serif", 18)))?;
    for (i, name) in run.coordinates.iter().take(lines).enumerate() {
        let color = COLORS[i % COLORS.len()];
        let points = records.iter().filter_map(|r| Some((r.time, *r.momentum.get(i)?)));
        chart.draw_series(LineSeries::new(points, color))?;
        if lines <= NAMED {
            let place = (260 + 70 * i as i32, 14);
            area.draw(&Text::new(
                name.clone(),
                place,
                ("sans-serif", 14).into_font().color(&color),
            ))?;
        }
    }
    Ok(())
}

/// One stroke and its name for every run, in a row above the panels, where no line can be hidden.
fn legend(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    runs: &[Trajectory],
) -> Result<(), Box<dyn std::error::Error>> {
    let width = (WIDTH as i32 - 90) / runs.len().max(1) as i32;
    for (i, (run, color)) in runs.iter().zip(COLORS.iter().cycle()).enumerate() {
        let (x, y) = (76 + i as i32 * width, LEGEND / 2 + 6);
        area.draw(&PathElement::new([(x, y), (x + 24, y)], color.stroke_width(2)))?;
        area.draw(&Text::new(run.label.clone(), (x + 32, y - 7), ("sans-serif", 14)))?;
    }
    Ok(())
}

fn panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    title: &str,
    quantity: fn(&Drift) -> f64,
    runs: &[Trajectory],
) -> Result<(), Box<dyn std::error::Error>> {
    let values = || runs.iter().flat_map(|run| &run.records).map(|r| quantity(&r.drift));
    let highest = values().fold(SMALLEST, f64::max);
    let lowest = values().filter(|v| *v > 0.0).fold(1e-15, f64::min).max(SMALLEST);
    let times = || runs.iter().flat_map(|run| &run.records).map(|record| record.time);
    let (first, last) = (times().fold(0.0, f64::min), times().fold(0.0, f64::max));
    let decades = Decades { low: lowest.log10().floor(), high: highest.log10().ceil() + 0.5 };
    let mut chart = ChartBuilder::on(area)
        .caption(format!("relative drift of {title}"), ("sans-serif", 18))
        .margin(8)
        .margin_right(34)
        .x_label_area_size(38)
        .y_label_area_size(64)
        .build_cartesian_2d(first..last, decades)?;
    chart
        .configure_mesh()
        .x_desc("time")
        .label_style(("sans-serif", 14))
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .y_label_formatter(&|decade| format!("1e{decade:.0}"))
        .draw()?;
    for (run, color) in runs.iter().zip(COLORS.iter().cycle()) {
        let stride = run.records.len().div_ceil(MOST_POINTS).max(1);
        // The largest value of each stretch: thinning must not hide a peak. Not the start, where
        // all drift is zero.
        let points = run.records[1.min(run.records.len())..].chunks(stride).map(|records| {
            let worst = records.iter().map(|r| quantity(&r.drift)).fold(SMALLEST, f64::max);
            (records[0].time, worst.log10())
        });
        chart.draw_series(LineSeries::new(points, color))?;
    }
    Ok(())
}

/// An axis of powers of ten, labelled at whole ones.
#[derive(Clone)]
struct Decades {
    low: f64,
    high: f64,
}

impl Ranged for Decades {
    type FormatOption = plotters::coord::ranged1d::NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.low) / (self.high - self.low);
        limit.0 + (share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let (low, high) = (self.low.ceil() as i32, self.high.floor() as i32);
        let count = (high - low + 1).max(1) as usize;
        let step = count.div_ceil(hint.max_num_points().clamp(1, 7)).max(1);
        (low..=high).step_by(step).map(f64::from).collect()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

impl plotters::coord::ranged1d::ValueFormatter<f64> for Decades {
    fn format(value: &f64) -> String {
        format!("1e{value:.0}")
    }
}
