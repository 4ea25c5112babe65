//! A picture of the light curve of Toutatis and of its spectrum, as SVG.

use std::fmt::Write as _;

use crate::toutatis::{LightCurve, transform};

/// The width and the height of a panel's frame, and its left edge.
const FRAME: (f64, f64, f64) = (780.0, 260.0, 90.0);
/// Days of light curve shown.
const DAYS: f64 = 60.0;

/// A panel: its top edge, the ranges of its axes, and its texts.
struct Panel {
    top: f64,
    x: (f64, f64),
    y: (f64, f64),
}

impl Panel {
    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let (width, height, left) = FRAME;
        let part = |v: f64, (low, high): (f64, f64)| (v - low) / (high - low);
        (left + width * part(x, self.x), self.top + height * (1.0 - part(y, self.y)))
    }

    fn frame(&self, title: &str, axis: &str, ticks: &[f64], out: &mut String) {
        let (width, height, left) = FRAME;
        let bottom = self.top + height;
        let middle = left + width / 2.0;
        // Writing into a string cannot fail.
        let _ = writeln!(
            out,
            "<rect x=\"{left}\" y=\"{}\" width=\"{width}\" height=\"{height}\" fill=\"none\" \
             stroke=\"#999\"/>\n<text x=\"{middle}\" y=\"{}\" font-size=\"18\">{title}</text>\n\
             <text x=\"{middle}\" y=\"{}\">{axis}</text>",
            self.top,
            self.top - 12.0,
            bottom + 40.0
        );
        for &tick in ticks {
            let (x, _) = self.place(tick, self.y.0);
            let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{}\">{tick}</text>", bottom + 20.0);
        }
    }

    fn line(&self, points: impl Iterator<Item = (f64, f64)>, color: &str, out: &mut String) {
        let _ = write!(out, "<polyline fill=\"none\" stroke=\"{color}\" points=\"");
        for (x, y) in points {
            let (x, y) = self.place(x, y);
            let _ = write!(out, "{x:.1},{y:.1} ");
        }
        out.push_str("\"/>\n");
    }
}

/// The light curve's beginning, and its spectrum with the `measured` frequencies marked.
#[must_use]
pub fn figure(curve: &LightCurve, measured: &[f64]) -> String {
    let mut out = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"740\" \
         font-family=\"sans-serif\" font-size=\"14\" text-anchor=\"middle\">\n\
         <rect width=\"900\" height=\"740\" fill=\"white\"/>\n",
    );
    let shown = ((DAYS / curve.interval) as usize).min(curve.samples.len());
    let samples = &curve.samples[..shown];
    let low = samples.iter().copied().fold(f64::INFINITY, f64::min);
    let high = samples.iter().copied().fold(0.0, f64::max);
    let margin = 0.06 * (high - low);
    let light = Panel { top: 50.0, x: (0.0, DAYS), y: (low - margin, high + margin) };
    let ticks = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0];
    light.frame("4179 Toutatis: visible and lit area, km²", "days", &ticks, &mut out);
    for value in [low, high] {
        let (_, y) = light.place(0.0, value);
        let _ = writeln!(out, "<text x=\"66\" y=\"{:.1}\">{value:.1}</text>", y + 5.0);
    }
    let points = samples.iter().enumerate().map(|(i, &v)| (i as f64 * curve.interval, v));
    light.line(points, "#005aaa", &mut out);

    let size = transform(curve);
    let strongest = size.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let step = 1.0 / (curve.samples.len() as f64 * curve.interval);
    let lines = Panel { top: 420.0, x: (0.0, 1.0), y: (0.0, 1.06) };
    let ticks = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
    let title = "its spectrum over the whole run; marked: the measured frequencies";
    lines.frame(title, "cycles per day", &ticks, &mut out);
    for &frequency in measured {
        let (x, top) = lines.place(frequency, 1.06);
        let (_, bottom) = lines.place(frequency, 0.0);
        let _ = writeln!(
            out,
            "<path d=\"M{x:.1} {top:.1}V{bottom:.1}\" stroke=\"#d26400\" stroke-dasharray=\"5 4\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" fill=\"#d26400\">{frequency}</text>",
            x + 22.0,
            top + 18.0
        );
    }
    // The largest value in each column: lines are narrower than that.
    let columns = 1600;
    let points = (0..columns).map(|column| {
        let from = f64::from(column) / f64::from(columns);
        let to = f64::from(column + 1) / f64::from(columns);
        let first = (from / step) as usize;
        let last = ((to / step) as usize).max(first + 1);
        let largest = size.iter().take(last).skip(first).copied().fold(0.0, f64::max);
        (from, largest / strongest)
    });
    lines.line(points, "#005aaa", &mut out);
    out.push_str("</svg>\n");
    out
}
