//! The report of a run, for people and for programs.

use std::fmt::Write;

use coadjoint_codegen::system::Units;
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{
    Block, Crossing, Outcome, Representation, Unknown, Warning, matrix, split,
};
use nalgebra::{DMatrix, Matrix3, Rotation3, UnitQuaternion};
use serde_json::{Value, json};

use super::keep::Trajectory;
use super::plot::brief;
use crate::named::Format;

/// Larger group elements are given by their blocks only, and larger blocks are not printed.
const WIDEST: usize = 12;
/// More moments of an event are counted.
const MOST_TIMES: usize = 8;

/// The text to print: one block per run, or one JSON object (an array of them for several runs).
pub(crate) fn report(runs: &[Trajectory], units: &Units, format: Format) -> String {
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

/// The energy at both ends, conserved or not.
fn energies(end: &Outcome) -> Option<[f64; 2]> {
    end.energy.or_else(|| end.work.map(|[start, end, _]| [start, end]))
}

/// A quantity without a number has no key; the error at the end, which every run is asked for, is null with the reason beside it.
fn object(run: &Trajectory, units: &Units) -> Value {
    let end = &run.outcome;
    let names = ["spatial_momentum", "casimirs", "energy"];
    let [spatial, casimirs, energy] = end.unknown.map(|why| why.is_none());
    let drifts = [end.drift.spatial_momentum, end.drift.casimirs, end.drift.energy];
    let drifts = names.iter().zip(drifts).filter_map(|(name, drift)| Some((*name, json!(drift?))));
    let scales = [
        (spatial, json!(end.scales.spatial_momentum)),
        (casimirs, json!(end.scales.casimirs)),
        (energy, json!(end.scales.energy)),
    ];
    let scales = names.iter().zip(scales);
    let scales = scales.filter_map(|(name, (known, scale))| known.then_some((*name, scale)));
    let mut object = json!({
        "method": run.label,
        "run": run.header.object(),
        "steps": end.steps,
        "time": end.time,
        "coordinates": run.coordinates,
        "momentum": end.momentum,
        "group_element_blocks": blocks(end),
        "drift": object_of(drifts),
        "drift_scale": object_of(scales),
        "conserved_momenta": end.momenta,
        "conserved_casimirs": end.casimirs,
        "warnings": end.warnings.iter().map(Warning::object).collect::<Vec<_>>(),
    });
    if end.unmeasured.iter().any(Option::is_some) {
        let times = names.iter().zip(end.unmeasured);
        let times = times.filter_map(|(name, time)| Some((*name, json!(time?))));
        object["drift_not_measurable_after"] = object_of(times);
    }
    if let Some(off) = end.off_group {
        object["off_group"] = json!(off);
    }
    if let Some([start, end]) = energies(end) {
        object["energy"] = json!({ "start": start, "end": end });
    }
    if let Some([.., work]) = end.work {
        object["work"] = json!(work);
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
    let size = end.blocks.last().map_or(0, |block| block.range.end);
    if (1..=WIDEST).contains(&size) {
        object["group_element"] = json!(dense(end, size));
    }
    object["estimated_error"] = json!(end.estimated_error.as_ref().ok());
    if let Err(why) = &end.estimated_error {
        object["estimated_error_unknown"] = json!(why.to_string());
        if let Unknown::Unresolved { until } = why {
            object["trusted_until"] = json!(until);
        }
    }
    let events = run.header.get("events");
    if let Some(names) = events.and_then(Value::as_array) {
        let crossing = |crossing: &Crossing| {
            let Crossing { event, time, momentum, .. } = crossing;
            json!({ "event": names.get(*event), "time": time, "momentum": momentum })
        };
        object["events"] = end.events.iter().map(crossing).collect();
    }
    if let Some(solver) = end.solver {
        object["solver"] = json!({
            "most_iterations": solver.most_iterations,
            "max_residual": solver.max_residual,
            "rescued_steps": solver.rescued,
        });
    }
    if let Some(used) = &end.backend {
        object["backend"] = json!(used.name);
    }
    if let Some((path, rows)) = &run.out {
        object["out"] = json!({ "file": path.display().to_string(), "records": rows });
    }
    object
}

fn object_of<'a>(list: impl Iterator<Item = (&'a str, Value)>) -> Value {
    Value::Object(list.map(|(name, value)| (name.to_owned(), value)).collect())
}

/// The blocks of the group element with the number, from 0, of the first row and column of each.
fn blocks(end: &Outcome) -> Value {
    let block = |(block, entries): (&Block, &[f64])| {
        let rows: Vec<&[f64]> = entries.chunks(block.range.len().max(1)).collect();
        json!({ "first_row": block.range.start, "matrix": rows })
    };
    split(&end.blocks, &end.element).map(block).collect()
}

/// The whole matrix of the group element.
fn dense(end: &Outcome, size: usize) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; size]; size];
    let places = end.blocks.iter().flat_map(Block::places);
    places.zip(&end.element).for_each(|((i, j), entry)| rows[i][j] = *entry);
    rows
}

/// A number and its unit, if there is one.
fn with_unit(number: &str, unit: Option<&str>) -> String {
    unit.map_or_else(|| number.to_owned(), |unit| format!("{number} {unit}"))
}

/// A remark for readers of the drift with this number.
fn remark(end: &Outcome, number: usize) -> String {
    let mut remark = match number {
        0 if end.potential => {
            let count = end.momenta;
            format!(" ({count} of its components; the potential breaks the other symmetries)")
        }
        0 if end.momenta < end.momentum.len() => {
            format!(" ({} of its components; a torque acts along the others)", end.momenta)
        }
        _ => String::new(),
    };
    if let Some(time) = end.unmeasured[number] {
        let time = brief(time);
        remark.push_str(&format!(
            ", not measurable after t = {time}: rounding of large numbers hides it"
        ));
    }
    remark
}

fn text(run: &Trajectory, units: &Units) -> String {
    let end = &run.outcome;
    let mut out = String::new();
    // Writing into a string cannot fail.
    let time = with_unit(&shortest(end.time), units.time.as_deref());
    let from = run.header.get("initial_time").and_then(Value::as_f64);
    let from = from.map(|start| format!("from time {} ", shortest(start))).unwrap_or_default();
    let _ = writeln!(out, "{}: {} steps {from}to time {time}", run.label, end.steps);
    if let Some(line) = &run.announcement {
        let _ = writeln!(out, "  {line}");
    }
    for warning in &end.warnings {
        let _ = writeln!(out, "  warning: {}", warning.text());
    }
    for (i, (name, value)) in run.coordinates.iter().zip(&end.momentum).enumerate() {
        let value = with_unit(&format!("{:>24}", shortest(*value)), units.coordinate(i));
        let _ = writeln!(out, "  {name:<10} {value}");
    }
    for line in lines(&end.blocks, &end.element) {
        let _ = writeln!(out, "  {line}");
    }
    // Rounding is not worth a line.
    if let Some(off) = end.off_group.filter(|off| *off > 1e-12) {
        let _ = writeln!(out, "  gᵀg − 1    {off:>24.1e}");
    }
    if let Some([_, energy]) = energies(end) {
        let _ = writeln!(out, "  energy     {:>24}", shortest(energy));
    }
    if let Some([start, end, work]) = end.work {
        let change = shortest(end - start);
        let work = shortest(work);
        let _ =
            writeln!(out, "  work       {work:>24} of the torque; the energy changed by {change}");
    }
    let _ = match &end.estimated_error {
        Ok(error) => writeln!(out, "  estimated relative error at the end {error:.1e}"),
        Err(why) => writeln!(out, "  estimated relative error at the end {why}"),
    };
    let names = run.header.get("events").and_then(Value::as_array);
    let names = names.into_iter().flatten().filter_map(Value::as_str);
    for (number, name) in names.enumerate() {
        let times = end.events.iter().filter(|crossing| crossing.event == number);
        let times: Vec<String> = times.map(|crossing| shortest(crossing.time)).collect();
        let listed = times.iter().take(MOST_TIMES).cloned().collect::<Vec<_>>().join(", ");
        let _ = match times.len() {
            0 => writeln!(out, "  event {name}: did not occur"),
            1..=MOST_TIMES => writeln!(out, "  event {name}: at {listed}"),
            count => writeln!(out, "  event {name}: at {listed}, … ({count} times)"),
        };
    }
    let _ = writeln!(out, "  largest relative drift");
    let casimirs = match end.casimirs {
        0 => "Casimirs".to_owned(),
        count => format!("Casimirs ({count})"),
    };
    let drifts = [end.drift.spatial_momentum, end.drift.casimirs, end.drift.energy];
    let names = ["spatial momentum", &casimirs, "energy"];
    for (i, (name, drift)) in names.iter().zip(drifts).enumerate() {
        let _ = match (end.unknown[i], drift) {
            (Some(why), _) => writeln!(out, "    {name:<16} {why}"),
            (None, None) => writeln!(out, "    {name:<16} not measurable"),
            (None, Some(drift)) => {
                writeln!(out, "    {name:<16} {drift:>10.1e}{}", remark(end, i))
            }
        };
    }
    if let Some(solver) = end.solver {
        let _ = writeln!(
            out,
            "  solver: at most {} iterations a step, largest residual {:.1e}",
            solver.most_iterations, solver.max_residual
        );
    }
    if let Some(used) = &end.backend
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

/// The largest number of blocks that are printed.
const MOST_BLOCKS: usize = 12;

/// Lines that say what the element is; zero blocks are left out.
fn lines(blocks: &[Block], entries: &[f64]) -> Vec<String> {
    let several = blocks.len() > 1;
    let mut lines = Vec::new();
    for (number, (block, entries)) in split(blocks, entries).take(MOST_BLOCKS).enumerate() {
        let which = if several { format!("{} ", number + 1) } else { String::new() };
        let g = matrix(block, entries);
        lines.push(format!("group element {which}({})", said(block)));
        lines.extend(rows(block, &g).into_iter().map(|row| format!("  {row}")));
    }
    if blocks.len() > MOST_BLOCKS {
        let rest = blocks.len() - MOST_BLOCKS;
        lines.push(format!("group elements of {rest} more factors: see --format json or --out"));
    }
    lines
}

fn said(block: &Block) -> String {
    let n = block.range.len();
    match block.kind {
        Representation::Plane => "rotation of the plane: angle in radians".into(),
        Representation::Rotation => "rotation, body to space: unit quaternion w, x, y, z".into(),
        Representation::PlaneMotion => {
            "motion of the plane: angle in radians; translation x, y".into()
        }
        Representation::Motion => {
            "rigid motion, body to space: unit quaternion w, x, y, z; translation x, y, z".into()
        }
        Representation::Quaternion => "unit quaternion w, x, y, z".into(),
        Representation::Complex => format!("complex {0} × {0} matrix", n / 2),
        Representation::Real => format!("{n} × {n} matrix"),
        Representation::Adjoint => format!("{n} × {n} matrix of Ad_g"),
    }
}

fn rows(block: &Block, g: &DMatrix<f64>) -> Vec<String> {
    let list = |values: &[f64]| {
        values.iter().map(|&x| format!("{:>24}", shortest(x))).collect::<Vec<_>>().join(" ")
    };
    let angle = || g[(1, 0)].atan2(g[(0, 0)]);
    match block.kind {
        Representation::Plane => vec![list(&[angle()])],
        Representation::Rotation => vec![list(&quaternion(g))],
        Representation::PlaneMotion => vec![list(&[angle()]), list(&[g[(0, 2)], g[(1, 2)]])],
        Representation::Motion => {
            vec![list(&quaternion(g)), list(&[g[(0, 3)], g[(1, 3)], g[(2, 3)]])]
        }
        // U = w − i(xσ₁ + yσ₂ + zσ₃) as ((A, −B), (B, A)).
        Representation::Quaternion => vec![list(&[g[(0, 0)], -g[(2, 1)], -g[(0, 1)], -g[(2, 0)]])],
        _ if g.nrows() > WIDEST => vec!["too large to print: see --format json or --out".into()],
        Representation::Complex => {
            let n = g.nrows() / 2;
            let entry = |i: usize, j: usize| {
                let (re, im) = (g[(i, j)], g[(n + i, j)]);
                let sign = if im.is_sign_negative() { '-' } else { '+' };
                format!("{:>49}", format!("{} {sign} {}i", shortest(re), shortest(im.abs())))
            };
            let row = |i| (0..n).map(|j| entry(i, j)).collect::<Vec<_>>().join(" ");
            (0..n).map(row).collect()
        }
        Representation::Real | Representation::Adjoint => {
            (0..g.nrows()).map(|i| list(&g.row(i).iter().copied().collect::<Vec<_>>())).collect()
        }
    }
}

/// The unit quaternion w, x, y, z with w ≥ 0 of the rotation in the first three rows and columns.
fn quaternion(g: &DMatrix<f64>) -> [f64; 4] {
    let matrix = Matrix3::from_fn(|i, j| g[(i, j)]);
    let rotation = Rotation3::from_matrix_unchecked(matrix);
    let q = UnitQuaternion::from_rotation_matrix(&rotation);
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    // No negative zeros.
    [q.w, q.i, q.j, q.k].map(|x| sign * x + 0.0)
}
