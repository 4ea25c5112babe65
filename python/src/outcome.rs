//! The result of a run, in Python's types.

use coadjoint_run::simulate::{Block, Crossing, Outcome, Representation, Schedule, Unknown, split};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::record::Trace;

/// The result of a run, as Python has it.
pub fn result_of<'py>(
    py: Python<'py>,
    table: Trace,
    outcome: &Outcome,
    schedule: &Schedule,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    let rows = table.time.len();
    let wide = |values: Vec<f64>| {
        let width = values.len().checked_div(rows).unwrap_or(0);
        values.into_pyarray(py).reshape([rows, width])
    };
    found.set_item("time", table.time.into_pyarray(py))?;
    found.set_item("momentum", wide(table.momentum)?)?;
    found.set_item("entries", wide(table.element)?)?;
    found.set_item("spatial_momentum", wide(table.spatial)?)?;
    found.set_item("energy", table.energy.into_pyarray(py))?;
    found.set_item("drifts", wide(table.drift)?)?;
    found.set_item("blocks", table.blocks)?;
    found.set_item("columns", table.columns)?;
    found.set_item("warnings", table.warnings)?;
    found.set_item("announcement", schedule.announcement())?;
    found.set_item("step", schedule.step)?;
    found.set_item("t0", schedule.start)?;
    found.set_item("steps", outcome.steps)?;
    let end = PyDict::new(py);
    end.set_item("time", outcome.time)?;
    end.set_item("momentum", PyArray1::from_slice(py, &outcome.momentum))?;
    let blocks: Vec<(usize, usize)> =
        outcome.blocks.iter().map(|b| (b.range.start, b.range.len())).collect();
    end.set_item("blocks", blocks)?;
    let own = split(&outcome.blocks, &outcome.element);
    end.set_item(
        "entries",
        PyArray1::from_vec(py, own.flat_map(|(_, own)| own.to_vec()).collect()),
    )?;
    found.set_item("end", end)?;
    let crossing = |crossing: &Crossing| {
        let Crossing { event, time, momentum, element } = crossing.clone();
        (event, time, PyArray1::from_vec(py, momentum), PyArray1::from_vec(py, element))
    };
    let events: Vec<_> = outcome.events.iter().map(crossing).collect();
    found.set_item("events", events)?;
    // First rows of rotations of space in the matrix: those of a rigid motion begin with one.
    let turns =
        |block: &&Block| matches!(block.kind, Representation::Rotation | Representation::Motion);
    let rotations = outcome.blocks.iter().filter(turns).map(|block| block.range.start);
    found.set_item("rotations", rotations.collect::<Vec<usize>>())?;
    let drift = outcome.drift;
    found.set_item("largest_drift", (drift.spatial_momentum, drift.casimirs, drift.energy))?;
    let estimate = &outcome.estimated_error;
    found.set_item("estimated_error", estimate.as_ref().ok())?;
    found.set_item("no_estimate", estimate.as_ref().err().map(ToString::to_string))?;
    let until = match estimate {
        Err(Unknown::Unresolved { until }) => Some(*until),
        _ => None,
    };
    found.set_item("trusted_until", until)?;
    let scales = &outcome.scales;
    let scales = (scales.spatial_momentum, scales.casimirs.clone(), scales.energy);
    found.set_item("drift_scale", scales)?;
    found.set_item("off_group", outcome.off_group)?;
    found.set_item("unknown", outcome.unknown)?;
    found.set_item("unmeasured", outcome.unmeasured)?;
    found.set_item("potential", outcome.potential)?;
    found.set_item("has_energy", outcome.energy.is_some())?;
    found.set_item("work", outcome.work.map(|[.., work]| work))?;
    let used = outcome.backend.as_ref();
    found.set_item("backend", used.map_or("interpreter", |used| used.name.as_str()))?;
    let ready = used.and_then(|used| used.ready).map(|time| time.as_secs_f64());
    found.set_item("ready", ready)?;
    let solver = outcome.solver.map(|solver| (solver.most_iterations, solver.max_residual));
    found.set_item("solver", solver)?;
    Ok(found)
}
