//! Events as functions of Python.

use std::sync::Arc;

use coadjoint_run::simulate::{Direction, Event};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

use crate::function::Failures;

/// A function whose changes of sign are looked for: its name, itself, the sign of the direction that counts (0 for both),
/// and whether it ends the run.
#[derive(FromPyObject)]
pub struct Watched(String, Py<PyAny>, i8, bool);

impl Watched {
    /// The event, for groups of matrices of this size. The function is called with the time, g and μ.
    pub fn event(self, size: usize, failures: Arc<Failures>) -> Event {
        let Self(name, function, sign, terminal) = self;
        let direction = Direction::of_slope(sign);
        let value = move |time: f64, matrix: &[f64], mu: &[f64]| {
            let called = Python::attach(|py| {
                let matrix = PyArray1::from_slice(py, matrix).reshape([size, size])?;
                let mu = PyArray1::from_slice(py, mu);
                function.call1(py, (time, matrix, mu))?.extract::<f64>(py)
            });
            called.map_err(|error| {
                let text = error.to_string();
                failures.note(text.clone(), Some(error));
                text
            })
        };
        Event { name, function: Arc::new(value), direction, terminal }
    }
}
