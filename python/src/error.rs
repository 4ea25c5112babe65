//! Errors as exceptions of `coadjoint.errors`.

use coadjoint_codegen::diagnostic::visible;
use coadjoint_run::RunError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

use crate::function::{Failure, Failures};

static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();

/// The exception for a failure of this kind: `input`, `run` or `learn`.
fn make(py: Python<'_>, kind: &str, message: String, at: (Option<f64>, Option<u64>)) -> PyErr {
    let module =
        MODULE.get_or_try_init(py, || Ok::<_, PyErr>(py.import("coadjoint.errors")?.unbind()));
    let message = visible(&message).into_owned();
    let made = module
        .and_then(|module| module.bind(py).call_method1("_make", (kind, message, at.0, at.1)));
    match made {
        Ok(value) => PyErr::from_value(value),
        Err(error) => error,
    }
}

/// The exception of a failure.
pub fn raised(py: Python<'_>, error: &RunError) -> PyErr {
    let at = match error {
        RunError::Step { time, .. } => (*time, None),
        RunError::Run { time, step, .. } => (Some(*time), Some(*step)),
        _ => (None, None),
    };
    let kind = if error.is_input() { "input" } else { "run" };
    make(py, kind, error.to_string(), at)
}

/// The exception of a failure of a system, whose Hamiltonian or inputs may be functions of Python: why these failed, and what they
/// raised as its cause.
pub fn raised_by(py: Python<'_>, error: &RunError, failures: &Failures) -> PyErr {
    explained(py, raised(py, error), failures)
}

/// An exception with the reason for which functions of Python failed, where they did.
pub fn explained(py: Python<'_>, error: PyErr, failures: &Failures) -> PyErr {
    let Some(Failure { text, cause }) = failures.take() else { return error };
    let (value, said) = (error.value(py), error.value(py).to_string());
    let said = if said.ends_with(&text) { said } else { format!("{said}: {text}") };
    if let Err(error) = value.setattr("args", (said,)) {
        return error;
    }
    error.set_cause(py, cause);
    error
}

/// The exception for something that makes no sense.
pub fn refused(py: Python<'_>, message: String) -> PyErr {
    make(py, "input", message, (None, None))
}

/// The exception of a step that was not made.
pub fn stopped(py: Python<'_>, step: u64, message: String, failures: &Failures) -> PyErr {
    explained(py, make(py, "run", message, (None, Some(step))), failures)
}
