//! The derivatives of runs.

use std::collections::HashMap;
use std::sync::Arc;

use coadjoint_codegen::problem::FrameChoice;
use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::system::Options;
use coadjoint_run::simulate::{Event, Schedule, Setup};
use coadjoint_run::{Changes, Derivatives, Derived, RunError};
use nalgebra::DMatrix;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::asked::backend_of;
use crate::control::work;
use crate::error::raised_by;
use crate::event::Watched;
use crate::system::Core;

/// A run, and the parameters that its derivatives are taken in.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Request {
    core: Py<Core>,
    truncation: Option<usize>,
    comoving: bool,
    parameters: Vec<String>,
    step: f64,
    steps: u64,
    t0: f64,
    momentum: Option<Vec<f64>>,
    group_element: Option<Vec<Vec<f64>>>,
    backend: String,
    /// The event that ended the run: itself where it is a function of Python, its number, and its time.
    event: Option<(Option<Watched>, usize, f64)>,
}

/// The system of a run as it was derived for it, with the parameters kept.
fn derived(
    core: &Core,
    truncation: Option<usize>,
    comoving: bool,
    parameters: Vec<String>,
) -> Result<Arc<Derived>, RunError> {
    let frame = if comoving { FrameChoice::Comoving } else { FrameChoice::Fixed };
    let options = Options { truncation, frame: Some(frame), ..Options::default() };
    core.derived.derive(core.path(), core.again(options, &parameters)?, false)
}

/// Does something with the derivatives of a run.
fn with<T: Send + 'static>(
    py: Python<'_>,
    run: Request,
    job: impl FnOnce(&Derivatives<'_>) -> Result<T, RunError> + Send + 'static,
) -> PyResult<T> {
    let backend = backend_of(py, &run.backend)?;
    let core = run.core.get().here();
    let failures = core.failures.clone();
    let result = work(py, None, move |_| {
        let Request { truncation, comoving, parameters, step, steps, t0: start, .. } = run;
        let given = core.run();
        let momentum = run.momentum.or_else(|| given.momentum.clone());
        let group_element = run.group_element.or_else(|| given.group_element.clone());
        let derived = derived(&core, truncation, comoving, parameters)?;
        let end = start + step * steps as f64;
        let schedule = Schedule { asked: step, step, steps, start, end };
        let setup = Setup::new(schedule, momentum.unwrap_or_default());
        let setup = Setup { backend, group_element, ..setup };
        let derivatives = Derivatives::new(&derived, &setup)?;
        let ended = run.event.and_then(|(function, number, time)| {
            let size = core.shape().matrix_size;
            let of_file = || given.events.get(number).cloned().map(Event::of);
            let of_python = function.map(|own| own.event(size, core.failures.clone()));
            Some((of_python.or_else(of_file)?, time))
        });
        job(&match ended {
            Some((event, time)) => derivatives.until(event, time),
            None => derivatives,
        })
    })?;
    result.map_err(|error: RunError| raised_by(py, &error, &failures))
}

/// The derivatives of a sum, those in the samples of inputs by their names.
type Backward<'py> = (Bound<'py, PyArray1<f64>>, HashMap<String, Bound<'py, PyArray1<f64>>>);

fn matrix(array: &PyReadonlyArray2<'_, f64>) -> DMatrix<f64> {
    let array = array.as_array();
    DMatrix::from_fn(array.nrows(), array.ncols(), |i, j| array[(i, j)])
}

/// The tangents after these numbers of steps, of k columns of (ξ, ν) at the start, of changes of the parameters and of the samples of
/// inputs by their names: column after column, step after step; last of all the change of the time of the event that ended the run.
#[pyfunction]
pub fn forward<'py>(
    py: Python<'py>,
    run: Request,
    tangents: PyReadonlyArray2<'py, f64>,
    parameters: PyReadonlyArray2<'py, f64>,
    inputs: HashMap<String, PyReadonlyArray2<'py, f64>>,
    at: Vec<u64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (state, parameters) = (matrix(&tangents), matrix(&parameters));
    let mut inputs: HashMap<_, _> =
        inputs.iter().map(|(name, own)| (name.clone(), matrix(own))).collect();
    let job = move |run: &Derivatives<'_>| {
        let samples = |signal: &Signal| DMatrix::zeros(signal.table()[0].len(), state.ncols());
        let own = |signal: &Signal| inputs.remove(&signal.name).unwrap_or_else(|| samples(signal));
        let inputs = run.signals().iter().map(own).collect();
        run.forward(&Changes { state, parameters, inputs }, &at)
    };
    let found = with(py, run, job)?;
    Ok(found.iter().flatten().copied().collect::<Vec<f64>>().into_pyarray(py))
}

/// The derivatives in (ξ, ν) at the start, after them in the parameters, and in the samples of each input by its name, of a sum given by
/// a cotangent, a row (λ, κ) and the derivative in its time, for each of these numbers of steps.
#[pyfunction]
pub fn backward<'py>(
    py: Python<'py>,
    run: Request,
    cotangents: PyReadonlyArray2<'py, f64>,
    at: Vec<u64>,
) -> PyResult<Backward<'py>> {
    let array = cotangents.as_array();
    let rows: Vec<Vec<f64>> = array.rows().into_iter().map(|row| row.to_vec()).collect();
    let (found, names) = with(py, run, move |run| {
        let names = run.signals().iter().map(|signal| signal.name.clone()).collect::<Vec<_>>();
        // Of states at fixed times the time does not change.
        let column = |(at, row): (u64, Vec<f64>)| {
            (at, DMatrix::from_iterator(run.rows(at), 1, row.into_iter().take(run.rows(at))))
        };
        let cotangents: Vec<_> = at.into_iter().zip(rows).map(column).collect();
        Ok((run.backward(&cotangents)?, names))
    })?;
    let numbers: Vec<f64> = found.state.iter().chain(found.parameters.iter()).copied().collect();
    let own = |own: &DMatrix<f64>| own.as_slice().to_vec().into_pyarray(py);
    let inputs = names.into_iter().zip(found.inputs.iter().map(own)).collect();
    Ok((numbers.into_pyarray(py), inputs))
}

/// The largest Lyapunov exponent, without the first steps.
#[pyfunction]
pub fn largest_exponent(py: Python<'_>, run: Request, transient: u64) -> PyResult<f64> {
    with(py, run, move |run| run.largest_exponent(transient))
}
