//! The orbit of a motion: the momentum on its sphere, or in the plane of the two coordinates that vary most.

use super::{Picture, Series};
use crate::axis::Axis;
use crate::curves::{largest, range};
use crate::panel::{Curve, Panel, Sample};
use crate::style::Style;

/// Points of a curve.
const POINTS: usize = 500;
/// The direction from which a sphere is looked at.
const EYE: [f64; 3] = [0.62, 0.55, 0.56];
/// A motion is on a sphere if its distance from the centre varies relatively by no more than this.
const ROUND: f64 = 1e-9;

/// The panel of the first run, for a frame as wide as it is high times `aspect`; `None` of fewer than two coordinates.
#[must_use]
pub fn panel(picture: &Picture, aspect: f64) -> Option<Panel> {
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
        curves: vec![
            Curve::line("orbit", Style::new(0), points),
            Curve::points("start", Style::new(4), start),
        ],
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
    curves.push(Curve::points("start", Style::new(4), start));
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
