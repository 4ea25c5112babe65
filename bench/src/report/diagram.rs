//! The work-precision diagram: cost against error, one curve per family of methods.

use std::path::{Path, PathBuf};

use coadjoint_draw::{Axis, Curve, Panel, Style, sheet, unbeaten};

use super::Report;

/// Why a diagram was not drawn.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw {}: {reason}", path.display())]
pub struct DiagramError {
    path: PathBuf,
    reason: String,
}

/// Draws the cheapest points of each family; whatever is dearer at the same error is left out.
///
/// # Errors
/// When there is nothing to draw or the file cannot be written.
pub fn diagram(report: &Report, path: &Path) -> Result<(), DiagramError> {
    let fail = |reason: String| DiagramError { path: path.to_owned(), reason };
    let families = curves(report);
    let errors: Vec<f64> = families.iter().flat_map(|(_, p)| p.iter().map(|p| p.0)).collect();
    let costs: Vec<f64> = families.iter().flat_map(|(_, p)| p.iter().map(|p| p.1)).collect();
    if errors.is_empty() {
        return Err(fail("no measurements".to_owned()));
    }
    let lines = families.into_iter().enumerate();
    let panel = Panel {
        heading: "ns of one core per unit of time".to_owned(),
        across: "error of (Π, R) at T".to_owned(),
        x: Axis::logarithmic_around(&errors, f64::MIN_POSITIVE, 10),
        y: Axis::logarithmic_around(&costs, f64::MIN_POSITIVE, 8),
        curves: lines.map(|(i, (name, p))| Curve::marked(name, Style::new(i), p)).collect(),
        ..Panel::default()
    };
    let title = format!("{}, T = {}", report.title, report.end);
    let description =
        "Time against error, both on logarithmic axes, a curve for each family of methods.";
    let machine = [report.machine.to_string()];
    let text = sheet(&title, &machine, &[panel.with_legend()], 430.0, description);
    std::fs::write(path, text).map_err(|error| fail(error.to_string()))
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
        *points = unbeaten(std::mem::take(points));
        points.reverse();
    }
    families
}
