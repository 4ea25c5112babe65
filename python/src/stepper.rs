//! Single steps of one size.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use coadjoint_run::Derived;
use coadjoint_run::simulate::{Ongoing, Single};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::control::work;
use crate::error::{raised, refused, stopped};
use crate::function::Failures;

/// The most steps made at once without checking for signals.
const FEW: u64 = 64;

/// Steps of one size, ready to be made.
#[pyclass(frozen, module = "coadjoint._core")]
pub struct Stepper {
    /// The steps.
    pub single: Arc<Single<Arc<Derived>>>,
    /// The dimension of the algebra.
    pub dimension: usize,
    /// The failures of the system's functions.
    pub failures: Arc<Failures>,
}

#[pymethods]
impl Stepper {
    /// The backend that makes the steps.
    #[getter]
    fn backend(&self) -> String {
        self.single.backend()
    }

    /// The parameters that the steps are given, in the order of their numbers, and how many numbers each is.
    #[getter]
    fn parameters(&self) -> Vec<(String, usize)> {
        let parameters = self.single.system().facts().parameters.iter();
        parameters.map(|one| (one.name.clone(), one.shape.len())).collect()
    }

    /// A state of this time that goes on by these steps.
    fn begin(
        &self,
        py: Python<'_>,
        momentum: PyReadonlyArray1<'_, f64>,
        group_element: Option<PyReadonlyArray2<'_, f64>>,
        time: f64,
    ) -> PyResult<ControlLoop> {
        let (matrix, mu) = self.state(py, &momentum, group_element.as_ref())?;
        let ongoing = self.single.begin(&matrix, &mu, time);
        let ongoing = ongoing.map_err(|error| raised(py, &error))?;
        let (single, failures) = (self.single.clone(), self.failures.clone());
        Ok(ControlLoop { single, failures, ongoing })
    }

    /// The state after `steps` steps of one of this time: momentum and matrix.
    #[allow(clippy::type_complexity)]
    fn advance<'py>(
        &self,
        py: Python<'py>,
        momentum: PyReadonlyArray1<'py, f64>,
        group_element: Option<PyReadonlyArray2<'py, f64>>,
        time: f64,
        steps: u64,
        parameters: Option<Vec<f64>>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>)> {
        let size = self.single.matrix_size();
        let (mut matrix, mut mu) = self.state(py, &momentum, group_element.as_ref())?;
        let made = if steps <= FEW {
            self.single.advance(&mut matrix, &mut mu, time, [0, steps], parameters.as_deref())
        } else {
            let single = self.single.clone();
            let (made, new_matrix, new_mu) = work(py, None, move |control| {
                let mut done = 0;
                let mut made = Ok(());
                while done < steps && made.is_ok() && !control.stop.load(Ordering::Relaxed) {
                    let count = (steps - done).min(FEW);
                    // With the bits of one call.
                    let parameters = parameters.as_deref();
                    made = single.advance(&mut matrix, &mut mu, time, [done, count], parameters);
                    made = made.map_err(|(step, error)| (done + step, error));
                    done += count;
                }
                (made, matrix, mu)
            })?;
            (matrix, mu) = (new_matrix, new_mu);
            made
        };
        made.map_err(|(step, error)| stopped(py, step, error.to_string(), &self.failures))?;
        Ok((mu.into_pyarray(py), matrix.into_pyarray(py).reshape([size, size])?))
    }
}

/// The state of a control loop: what holds between samples is given to each call.
#[pyclass(module = "coadjoint._core")]
pub struct ControlLoop {
    single: Arc<Single<Arc<Derived>>>,
    failures: Arc<Failures>,
    ongoing: Ongoing,
}

#[pymethods]
impl ControlLoop {
    /// Makes `steps` more steps with these values of the parameters, one after the other.
    fn advance(
        &mut self,
        py: Python<'_>,
        steps: u64,
        parameters: Option<Vec<f64>>,
    ) -> PyResult<()> {
        let parameters = parameters.as_deref();
        let mut left = steps;
        while left > 0 {
            let count = left.min(FEW);
            let made = self.single.go_on(&mut self.ongoing, count, parameters);
            made.map_err(|(step, error)| {
                stopped(py, steps - left + step, error.to_string(), &self.failures)
            })?;
            left -= count;
            if left > 0 {
                py.check_signals()?;
            }
        }
        Ok(())
    }

    /// The time, the momentum and the matrix now.
    #[getter]
    #[allow(clippy::type_complexity)]
    fn state<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(f64, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>)> {
        let size = self.single.matrix_size();
        let (time, matrix, mu) = self.single.state(&self.ongoing);
        Ok((time, mu.into_pyarray(py), matrix.into_pyarray(py).reshape([size, size])?))
    }
}

impl Stepper {
    /// The matrix, row by row, and the momentum that are given, once they are checked.
    fn state(
        &self,
        py: Python<'_>,
        momentum: &PyReadonlyArray1<'_, f64>,
        group_element: Option<&PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<(Vec<f64>, Vec<f64>)> {
        let size = self.single.matrix_size();
        let mu = momentum.as_array().to_vec();
        if mu.len() != self.dimension {
            let what =
                format!("momentum has {} numbers; the group needs {}", mu.len(), self.dimension);
            return Err(refused(py, what));
        }
        if let Some(bad) = mu.iter().find(|x| !x.is_finite()) {
            return Err(refused(py, format!("momentum: {bad} is no finite number")));
        }
        let matrix = match group_element {
            None => {
                (0..size * size).map(|at| f64::from(u8::from(at / size == at % size))).collect()
            }
            Some(given) => {
                if given.shape() != [size, size] {
                    let what = format!("group_element must be a matrix of {size} rows and columns");
                    return Err(refused(py, what));
                }
                let given: Vec<f64> = given.as_array().iter().copied().collect();
                self.single.element(&given).map_err(|error| raised(py, &error))?
            }
        };
        Ok((matrix, mu))
    }
}
