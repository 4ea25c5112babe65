//! The work-precision diagram: cost against error, one curve per family of methods.

use std::path::{Path, PathBuf};

use plotters::prelude::*;

use super::Report;

/// Why a diagram was not drawn.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw {}: {reason}", path.display())]
pub struct DiagramError {
    path: PathBuf,
    reason: String,
}

/// Colours that differ in lightness as well as in hue (Okabe and Ito, 2008, and darker turns of them).
const COLOURS: [RGBColor; 12] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(128, 64, 0),
    RGBColor(120, 120, 120),
    RGBColor(90, 60, 150),
    RGBColor(180, 180, 40),
    RGBColor(0, 80, 60),
];

/// Draws the cheapest points of each family; whatever is dearer at the same error is left out.
///
/// # Errors
/// When there is nothing to draw or the file cannot be written.
pub fn diagram(report: &Report, path: &Path) -> Result<(), DiagramError> {
    let fail = |reason: String| DiagramError { path: path.to_owned(), reason };
    let curves = curves(report);
    let points = || curves.iter().flat_map(|(_, points)| points.iter());
    if points().count() == 0 {
        return Err(fail("no measurements".to_owned()));
    }
    let low = points().map(|p| p.1).fold(f64::INFINITY, f64::min) / 1.3;
    let high = points().map(|p| p.1).fold(0.0, f64::max) * 1.3;
    let draw = || -> Result<(), Box<dyn std::error::Error>> {
        let root = SVGBackend::new(path, (960, 640)).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .caption(format!("{}, T = {}", report.title, report.end), ("sans-serif", 20))
            .margin(12)
            .margin_right(230)
            .x_label_area_size(48)
            .y_label_area_size(72)
            // Error falls to the right: further right is better, lower is cheaper.
            .build_cartesian_2d(2.8f64..13.2, (low..high).log_scale())?;
        chart
            .configure_mesh()
            .x_desc("error of (Π, R) at T")
            .y_desc("ns of one core per unit of time")
            .x_label_formatter(&|digits| format!("1e-{digits:.0}"))
            .y_label_formatter(&|cost| {
                if *cost < 10.0 { format!("{cost:.1}") } else { format!("{cost:.0}") }
            })
            .light_line_style(RGBColor(240, 240, 240))
            .draw()?;
        for (index, (family, points)) in curves.iter().enumerate() {
            let colour = COLOURS[index % COLOURS.len()];
            let line = points.iter().map(|p| (-p.0.log10(), p.1));
            chart.draw_series(LineSeries::new(line.clone(), colour.stroke_width(2)))?;
            chart.draw_series(line.map(|p| Circle::new(p, 3, colour.filled())))?;
            let (x, y) = (742, 52 + 22 * index as i32);
            root.draw(&PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(3)))?;
            root.draw(&Text::new(family.clone(), (x + 28, y - 7), ("sans-serif", 14)))?;
        }
        root.present()?;
        Ok(())
    };
    draw().map_err(|error| fail(error.to_string()))
}

/// For each family its points (error, cost) that no other of its points beats in both, by falling error.
fn curves(report: &Report) -> Vec<(String, Vec<(f64, f64)>)> {
    let mut families: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for row in &report.measurements {
        if !(1e-13..=1e-3).contains(&row.error) {
            continue;
        }
        let point = (row.error, row.nanoseconds);
        match families.iter_mut().find(|(name, _)| *name == row.family) {
            Some((_, points)) => points.push(point),
            None => families.push((row.family.clone(), vec![point])),
        }
    }
    for (_, points) in &mut families {
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut cheapest = f64::INFINITY;
        points.retain(|&(_, cost)| {
            let beaten = cost >= cheapest;
            cheapest = cheapest.min(cost);
            !beaten
        });
        points.reverse();
    }
    families
}
