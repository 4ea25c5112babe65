//! Asteroid 4179 Toutatis for a thousand years, and the frequencies of its light curve.
//!
//! `cargo run --release -p coadjoint-tests --example toutatis [-- PICTURE.svg]`
#![allow(clippy::print_stdout)]

use coadjoint_draw::{Axis, Curve, Panel, Style, sheet};
use coadjoint_tests::toutatis::{
    Geometry, LightCurve, LongAxisMode, MEASURED, PRECESSION, ROTATION, light_curve, spectrum,
    transform,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mode = LongAxisMode::with_periods(ROTATION, PRECESSION).ok_or("no such mode")?;
    println!("periods {ROTATION} d and {PRECESSION} d, I = 1 : 3.09 : 3.22");
    println!("state: L² = {:.9}, 2E = {:.9}", mode.momentum_squared, mode.twice_energy);
    let (step, stride) = (0.125, 4);
    let years = 1000.0;
    let samples = (years * 365.25 / (step * stride as f64)) as usize;
    let curve = light_curve(&mode, &Geometry::fixed(), (step, stride), samples)?;
    let time = samples as f64 * curve.interval;
    let closed = mode.closed_form().momentum(time);
    let error = (curve.end.momentum - closed).norm() / closed.norm();
    println!("{:.0} years in steps of {step} d:", time / 365.25);
    println!("  drift of the spatial angular momentum {:.1e}", curve.drift);
    println!("  drift of its square, the Casimir {:.1e}", curve.casimir_drift);
    println!("  body momentum against Jacobi's elliptic functions {error:.1e}");
    println!("lines of the light curve, per day (measured: 0.135, 0.271, 0.643 ± 0.008):");
    let (rotation, precession) = (1.0 / ROTATION, 1.0 / PRECESSION);
    for line in spectrum(&curve, 8) {
        let mut best = (f64::INFINITY, 0, 0);
        for j in -4_i32..=4 {
            for k in -2_i32..=2 {
                let f = f64::from(j) * precession + 2.0 * f64::from(k) * rotation;
                let distance = (f - line.frequency).abs();
                if distance < best.0 {
                    best = (distance, j, 2 * k);
                }
            }
        }
        println!(
            "  {:.6}  amplitude {:.3}  = {} f_precession + {} f_rotation (off by {:.0e})",
            line.frequency, line.amplitude, best.1, best.2, best.0
        );
    }
    if let Some(path) = std::env::args().nth(1) {
        std::fs::write(path, figure(&curve, &MEASURED))?;
    }
    Ok(())
}

/// Days of light curve shown.
const DAYS: f64 = 60.0;
/// Columns of the spectrum: lines are narrower than that.
const COLUMNS: u32 = 1600;

/// The light curve's beginning, and its spectrum with the `measured` frequencies marked.
fn figure(curve: &LightCurve, measured: &[f64]) -> String {
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
