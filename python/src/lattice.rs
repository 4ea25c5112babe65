//! Runs of lattices of spins, by the engine of the command.

use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::Ordering;

use coadjoint_run::RunError;
use coadjoint_run::lattice::{Arrays, News, Simulation};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::Asked;
use crate::control::work;
use crate::error::raised;

/// Runs the lattice of a text, in which arrays stand for the files of their names; a dictionary of arrays and facts.
///
/// # Errors
/// All mistakes, and those of the run.
#[pyfunction]
#[pyo3(signature = (text, name, arrays, asked, *, every, estimate, progress))]
#[allow(clippy::too_many_arguments)]
pub fn simulate_lattice<'py>(
    py: Python<'py>,
    text: String,
    name: String,
    arrays: HashMap<String, PyReadonlyArrayDyn<'py, f64>>,
    asked: Asked,
    every: Option<u64>,
    estimate: bool,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let accuracy = asked.accuracy(py)?;
    let given = |(name, array): (String, PyReadonlyArrayDyn<'py, f64>)| {
        let numbers = array.as_array().iter().copied().collect();
        (name, (array.shape().to_vec(), numbers))
    };
    let arrays: Arrays = arrays.into_iter().map(given).collect();
    let made = work(py, progress.as_ref(), move |control| {
        let (mut time, mut magnetisation, mut energy) = (Vec::new(), Vec::new(), Vec::new());
        let mut chosen: Vec<f64> = Vec::new();
        let mut told = |news: News<'_>| {
            match news {
                News::Record(record) => {
                    time.push(record.time);
                    magnetisation.extend(record.magnetisation);
                    energy.push(record.energy);
                    chosen.extend(record.spins.as_flattened());
                }
                News::Steps(n, _) => control.done.store(n, Ordering::Relaxed),
            }
            !control.stop.load(Ordering::Relaxed)
        };
        // Threads of its own: those of a parent process are not there in a fork.
        let pool = rayon::ThreadPoolBuilder::new().build();
        let pool = pool.map_err(|error| RunError::Option(error.to_string()))?;
        let end = pool.install(|| {
            let lattice = Simulation::read(Path::new(&name), &text, &arrays)?;
            let none = || RunError::Option("the text has no [lattice]".to_owned());
            let settings = (Some(every.unwrap_or(1)), estimate);
            let lattice = lattice.ok_or_else(none)?;
            let plan = lattice.plan(&accuracy, None)?;
            control.total.store(plan.schedule.steps, Ordering::Relaxed);
            lattice.run(plan, settings, None, &mut told)
        })?;
        Ok((end, time, magnetisation, energy, chosen))
    })?;
    let (end, time, magnetisation, energy, chosen) =
        made.map_err(|error: RunError| raised(py, &error))?;
    let found = PyDict::new(py);
    let (sites, rows) = (end.spins.len(), time.len());
    found.set_item("spins", end.spins.into_flattened().into_pyarray(py).reshape([sites, 3])?)?;
    found.set_item("time", time.into_pyarray(py))?;
    found.set_item("magnetisation", magnetisation.into_pyarray(py).reshape([rows, 3])?)?;
    found.set_item("energy", energy.into_pyarray(py))?;
    let each = chosen.len() / (3 * rows.max(1));
    found.set_item("sites", chosen.into_pyarray(py).reshape([rows, each, 3])?)?;
    found.set_item("method", end.plan.method.label())?;
    found.set_item("step", end.plan.schedule.step)?;
    found.set_item("steps", end.plan.schedule.steps)?;
    found.set_item("length_drift", end.lengths)?;
    found.set_item("estimated_error", end.error)?;
    Ok(found)
}
