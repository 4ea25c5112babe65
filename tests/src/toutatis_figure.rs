//! A picture of the light curve of Toutatis and of its spectrum, as SVG.

use coadjoint_draw::{Axis, Curve, Panel, Style, sheet};

use crate::toutatis::{LightCurve, transform};

/// Days of light curve shown.
const DAYS: f64 = 60.0;
/// Columns of the spectrum: lines are narrower than that.
const COLUMNS: u32 = 1600;

/// The light curve's beginning, and its spectrum with the `measured` frequencies marked.
#[must_use]
pub fn figure(curve: &LightCurve, measured: &[f64]) -> String {
    let shown = ((DAYS / curve.interval) as usize).min(curve.samples.len());
    let samples = &curve.samples[..shown];
    let points = samples.iter().enumerate().map(|(i, &v)| (i as f64 * curve.interval, v));
    let light = Panel {
        heading: "visible and lit area (km²)".to_owned(),
        across: "time (days)".to_owned(),
        x: Axis::linear(0.0, DAYS, 7),
        y: Axis::around(samples, false, 5),
        curves: vec![Curve::line("area", Style::new(0), points.collect())],
        ..Panel::default()
    };
    let size = transform(curve);
    let strongest = size.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let step = 1.0 / (curve.samples.len() as f64 * curve.interval);
    // The largest value in each column.
    let points = (0..COLUMNS).map(|column| {
        let from = f64::from(column) / f64::from(COLUMNS);
        let to = f64::from(column + 1) / f64::from(COLUMNS);
        let first = (from / step) as usize;
        let last = ((to / step) as usize).max(first + 1);
        let largest = size.iter().take(last).skip(first).copied().fold(0.0, f64::max);
        (from, largest / strongest)
    });
    let mut curves: Vec<Curve> = measured
        .iter()
        .enumerate()
        .map(|(i, &frequency)| {
            let name = format!("measured: {frequency}");
            Curve::line(name, Style::new(i + 1), vec![(frequency, 0.0), (frequency, 1.06)])
        })
        .collect();
    curves.push(Curve::line("computed", Style::new(0), points.collect()));
    let spectrum = Panel {
        heading: "its spectrum over the whole run (share of the strongest line)".to_owned(),
        across: "cycles per day".to_owned(),
        x: Axis::linear(0.0, 1.0, 6),
        y: Axis::linear(0.0, 1.06, 5),
        curves,
        ..Panel::default()
    };
    let settings = [format!("{} samples, {} days apart", curve.samples.len(), curve.interval)];
    let description = "The first days of the light curve of the asteroid, and its spectrum.";
    let panels = [light, spectrum.with_legend()];
    sheet("4179 Toutatis", &settings, &panels, 240.0, description)
}
