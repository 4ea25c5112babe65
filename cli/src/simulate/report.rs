//! What a run did, for people and for programs.

use std::fmt::Write;

use coadjoint_codegen::system::Units;
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{Block, Warning, matrix, split};
use serde_json::{Value, json};

use super::element::lines;
use super::trajectory::Trajectory;
use crate::arguments::Format;

/// Larger group elements are given by their blocks only.
const WIDEST: usize = 12;

/// The text to print: one block per run, or one JSON object (an array of them for several runs).
pub fn report(runs: &[Trajectory], units: &Units, format: Format) -> String {
    match format {
        Format::Text => runs.iter().map(|run| text(run, units)).collect::<Vec<_>>().join("\n"),
        Format::Json => {
            let value = match runs {
                [single] => object(single, units),
                several => several.iter().map(|run| object(run, units)).collect(),
            };
            format!("{value:#}\n")
        }
    }
}

/// What there is no number for has no key: no value is null.
fn object(run: &Trajectory, units: &Units) -> Value {
    let mut drift = json!({});
    if run.energy.is_some() {
        drift["energy"] = json!(run.drift.energy);
    }
    // What is not conserved has no drift.
    if run.momenta > 0 {
        drift["spatial_momentum"] = json!(run.drift.spatial_momentum);
    }
    if run.casimirs > 0 || !run.potential {
        drift["casimirs"] = json!(run.drift.casimirs);
    }
    let mut object = json!({
        "method": run.label,
        "run": run.header.object(),
        "steps": run.steps,
        "time": run.time,
        "coordinates": run.coordinates,
        "momentum": run.momentum,
        "group_element_blocks": blocks(run),
        "drift": drift,
        "conserved_momenta": run.momenta,
        "conserved_casimirs": run.casimirs,
        "warnings": run.warnings.iter().map(Warning::object).collect::<Vec<_>>(),
    });
    if let Some([start, end]) = run.energy {
        object["energy"] = json!({ "start": start, "end": end });
    }
    let mut given = serde_json::Map::new();
    given.extend(units.time.as_ref().map(|unit| ("time".to_owned(), json!(unit))));
    for (i, name) in run.coordinates.iter().enumerate() {
        given.extend(units.coordinate(i).map(|unit| (name.clone(), json!(unit))));
    }
    if !given.is_empty() {
        object["units"] = Value::Object(given);
    }
    for name in ["truncation", "chart", "step", "step_asked"] {
        if let Some(value) = run.header.get(name) {
            object[name] = value.clone();
        }
    }
    let size = run.blocks.last().map_or(0, |block| block.range.end);
    if (1..=WIDEST).contains(&size) {
        object["group_element"] = json!(dense(run, size));
    }
    if let Some(solver) = run.solver {
        object["solver"] = json!({
            "most_iterations": solver.most_iterations,
            "max_residual": solver.max_residual,
        });
    }
    if let Some(used) = &run.backend {
        object["backend"] = json!(used.name);
    }
    if let Some((path, rows)) = &run.out {
        object["out"] = json!({ "file": path.display().to_string(), "records": rows });
    }
    object
}

/// The blocks of the group element with the number, from 0, of the first row and column of each.
fn blocks(run: &Trajectory) -> Value {
    let block = |(block, entries): (&Block, &[f64])| {
        let rows: Vec<&[f64]> = entries.chunks(block.range.len().max(1)).collect();
        json!({ "first_row": block.range.start, "matrix": rows })
    };
    split(&run.blocks, &run.element).map(block).collect()
}

/// The whole matrix of the group element.
fn dense(run: &Trajectory, size: usize) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; size]; size];
    for (block, entries) in split(&run.blocks, &run.element) {
        let g = matrix(block, entries);
        for (i, row) in block.range.clone().enumerate() {
            for (j, column) in block.range.clone().enumerate() {
                rows[row][column] = g[(i, j)];
            }
        }
    }
    rows
}

/// A number and its unit, if there is one.
fn with_unit(number: &str, unit: Option<&str>) -> String {
    unit.map_or_else(|| number.to_owned(), |unit| format!("{number} {unit}"))
}

fn text(run: &Trajectory, units: &Units) -> String {
    let mut out = String::new();
    // Writing into a string cannot fail.
    let time = with_unit(&shortest(run.time), units.time.as_deref());
    let _ = writeln!(out, "{}: {} steps to time {time}", run.label, run.steps);
    if let Some(line) = &run.announcement {
        let _ = writeln!(out, "  {line}");
    }
    for warning in &run.warnings {
        let _ = writeln!(out, "  warning: {}", warning.text());
    }
    for (i, (name, value)) in run.coordinates.iter().zip(&run.momentum).enumerate() {
        let value = with_unit(&format!("{:>24}", shortest(*value)), units.coordinate(i));
        let _ = writeln!(out, "  {name:<10} {value}");
    }
    for line in lines(&run.blocks, &run.element) {
        let _ = writeln!(out, "  {line}");
    }
    if let Some([_, energy]) = run.energy {
        let _ = writeln!(out, "  energy     {:>24}", shortest(energy));
    }
    let drift = run.drift;
    let _ = writeln!(out, "  largest relative drift");
    let _ = match (run.potential, run.momenta) {
        (false, _) => writeln!(out, "    spatial momentum {:>10.1e}", drift.spatial_momentum),
        (true, 0) => {
            writeln!(out, "    spatial momentum not conserved: the potential breaks the symmetry")
        }
        (true, count) => writeln!(
            out,
            "    spatial momentum {:>10.1e} ({count} of its components; the potential breaks the \
             other symmetries)",
            drift.spatial_momentum
        ),
    };
    let _ = match (run.potential, run.casimirs) {
        (false, 0) => writeln!(out, "    Casimirs         none known"),
        (true, 0) => writeln!(out, "    Casimirs         none that the kicks keep"),
        (_, count) => writeln!(out, "    Casimirs ({count})     {:>10.1e}", drift.casimirs),
    };
    if run.energy.is_some() {
        let _ = writeln!(out, "    energy           {:>10.1e}", drift.energy);
    }
    if let Some(solver) = run.solver {
        let _ = writeln!(
            out,
            "  solver: at most {} iterations a step, largest residual {:.1e}",
            solver.most_iterations, solver.max_residual
        );
    }
    if let Some(used) = &run.backend
        && let Some(ready) = used.ready
    {
        let milliseconds = ready.as_secs_f64() * 1e3;
        let _ = writeln!(out, "  steps: {}, ready after {milliseconds:.0} ms", used.name);
    }
    if let Some((path, rows)) = &run.out {
        let _ = writeln!(out, "  {rows} records in {}", path.display());
    }
    out
}
