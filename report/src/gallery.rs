//! The gallery: every system with its orbit, its momentum and what it conserves.

use std::fmt::Write as _;

use coadjoint_draw::run::{Picture, Run, drift, motion, orbit};
use coadjoint_draw::{curves::range, escaped};

/// The size of a panel.
const SIZE: (f64, f64) = (400.0, 250.0);
/// The width of a frame over its height, about.
const ASPECT: f64 = 1.3;
/// Stretches of time in which two points of a curve are drawn.
const COLUMNS: usize = 130;
/// A drift of spatial momentum or Casimirs beyond this is no rounding.
pub const BOUND: f64 = 1e-11;

/// The largest drift of what every step conserves whatever S is.
pub fn worst(picture: &Picture) -> f64 {
    let exact =
        picture.runs.iter().flat_map(|run| &run.drifts).filter(|drift| drift.name != "energy");
    exact.map(largest).fold(0.0, f64::max)
}

fn largest(series: &coadjoint_draw::run::Series) -> f64 {
    range(&series.values).map_or(f64::NAN, |(_, high)| high)
}

/// The HTML of a system.
pub fn exhibit(picture: &Picture) -> String {
    let mut text = String::new();
    let name = escaped(&picture.name);
    let holds = worst(picture) <= BOUND;
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "<article class=\"exhibit\" id=\"gallery-{name}\">\n<h3>{name} {}</h3>\n{}",
        crate::html::verdict(holds),
        crate::html::settings(&picture.settings)
    );
    let mut panels: Vec<_> = orbit::panel(picture, ASPECT).into_iter().collect();
    if let Some(run) = picture.runs.first() {
        let across = range(&run.times).unwrap_or((0.0, 1.0));
        let unit = picture.time_unit.as_deref();
        panels.extend(motion::panels(run, false, across, unit, COLUMNS).into_iter().take(1));
        panels.extend(together(run, across, unit));
    }
    text.push_str("<div class=\"panels three\">\n");
    panels.iter().for_each(|panel| text.push_str(&panel.alone(SIZE.0, SIZE.1)));
    text.push_str("</div>\n</article>\n");
    text
}

/// All drifts of a run in one panel.
fn together(run: &Run, across: (f64, f64), unit: Option<&str>) -> Option<coadjoint_draw::Panel> {
    let panels = drift::panels(std::slice::from_ref(run), across, unit);
    let mut whole = panels.first()?.clone();
    whole.heading = "Relative drifts".to_owned();
    whole.legend.clear();
    whole.curves = panels
        .iter()
        .enumerate()
        .flat_map(|(i, panel)| {
            let name = run.drifts[i].name.split(',').next().unwrap_or_default().to_owned();
            let style = coadjoint_draw::Style::new(i);
            let curves = panel.curves.iter().cloned();
            curves.map(move |curve| coadjoint_draw::Curve { name: name.clone(), style, ..curve })
        })
        .collect();
    let values: Vec<f64> =
        whole.curves.iter().flat_map(|curve| curve.points.iter().map(|point| point.1)).collect();
    whole.y = coadjoint_draw::Axis::floored(&values, (coadjoint_draw::run::FLOOR, -12), 6);
    Some(whole.with_legend())
}
