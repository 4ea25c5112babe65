//! Hamiltonians, velocities, torques and inputs as functions of Python.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use coadjoint_codegen::drive::{Actor, Acts};
use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::smooth::{Given, Oracle};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

/// The spacing of the differences by which a gradient is checked, relative to the momentum.
const SPACING: f64 = 1e-5;
/// Later times at which the energy must be the same, when it is first asked for.
const LATER: [f64; 3] = [0.3, 1.0, 7.0];
/// A gradient may differ from these differences by this, relatively.
const SAME: f64 = 1e-5;

/// An energy and its gradient, functions of the time and the momentum.
pub struct Callables {
    energy: Py<PyAny>,
    gradient: Py<PyAny>,
    /// True once the gradient was found to be the energy's, at its first call.
    checked: AtomicBool,
    failures: Arc<Failures>,
}

/// A failed call of a function.
pub struct Failure {
    /// The message.
    pub text: String,
    /// The exception that it raised, if it did.
    pub cause: Option<PyErr>,
}

/// The first failure of the functions of a system that nobody has been told.
#[derive(Default)]
pub struct Failures(Mutex<Option<Failure>>);

impl Failures {
    /// The first failure since this was last asked.
    pub fn take(&self) -> Option<Failure> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Takes note of a failure, unless there was one before.
    pub fn note(&self, text: String, cause: Option<PyErr>) {
        let mut failure = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        failure.get_or_insert(Failure { text, cause });
    }
}

/// An input u(t) as a function of the time; NaN where it fails, which is noted.
pub fn input(name: String, function: Py<PyAny>, failures: Arc<Failures>) -> Signal {
    let called = name.clone();
    Signal::of_function(name, move |time| {
        let value = Python::attach(|py| function.call1(py, (time,))?.extract::<f64>(py));
        let (what, cause) = match value {
            Ok(value) if value.is_finite() => return value,
            Ok(value) => (format!("is {value}"), None),
            Err(error) => (format!("raised {error}"), Some(error)),
        };
        failures.note(format!("the input {called} {what}, at time {time}"), cause);
        f64::NAN
    })
}

/// A velocity or a torque, a function of the time, the matrix of g and the momentum.
struct Called {
    function: Py<PyAny>,
    name: &'static str,
    failures: Arc<Failures>,
}

/// A velocity or a torque by this name; NaN where it fails, which is noted.
pub fn acting(name: &'static str, function: Py<PyAny>, failures: Arc<Failures>) -> Acts {
    Acts(Arc::new(Called { function, name, failures }))
}

impl Actor for Called {
    fn acting(&self, time: f64, entries: &[f64], mu: &[f64]) -> Vec<f64> {
        let size = entries.len().isqrt();
        let found = Python::attach(|py| {
            let matrix = PyArray1::from_slice(py, entries).reshape([size, size])?;
            let found =
                self.function.bind(py).call1((time, matrix, PyArray1::from_slice(py, mu)))?;
            numbers(&found)
        });
        told(&self.failures, (self.name, mu.len()), found, || {
            format!("time {time}, momentum {mu:?}")
        })
    }
}

/// The numbers of a list or an array.
fn numbers(found: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    match found.extract::<PyReadonlyArray1<'_, f64>>() {
        Ok(array) => Ok(array.as_array().to_vec()),
        Err(_) => found.extract::<Vec<f64>>(),
    }
}

/// The numbers that a function gave, as many as are needed; NaN where it failed, which is noted.
fn told(
    failures: &Failures,
    (name, count): (&str, usize),
    called: PyResult<Vec<f64>>,
    place: impl Fn() -> String,
) -> Vec<f64> {
    match called {
        Ok(numbers) if numbers.len() == count => {
            if let Some(number) = numbers.iter().find(|number| !number.is_finite()) {
                failures.note(format!("{name} is {number} at {}", place()), None);
            }
            numbers
        }
        Ok(numbers) => {
            let found = numbers.len();
            failures.note(format!("{name} has {found} numbers; {count} are needed"), None);
            vec![f64::NAN; count]
        }
        Err(error) => {
            failures.note(format!("{name} raised {error}, at {}", place()), Some(error));
            vec![f64::NAN; count]
        }
    }
}

impl Callables {
    /// The function of a system, of these two.
    pub fn given(energy: Py<PyAny>, gradient: Py<PyAny>, failures: Arc<Failures>) -> Given {
        Given(Arc::new(Self { energy, gradient, checked: AtomicBool::new(false), failures }))
    }

    fn fail(&self, text: String, cause: Option<PyErr>) {
        self.failures.note(text, cause);
    }

    /// The numbers that a function gives; NaN where it fails, which is noted.
    fn call(&self, gradient: bool, time: f64, mu: &[f64]) -> Vec<f64> {
        let (function, name, count) = match gradient {
            true => (&self.gradient, "the gradient", mu.len()),
            false => (&self.energy, "the energy", 1),
        };
        let called = Python::attach(|py| {
            let found = function.bind(py).call1((time, PyArray1::from_slice(py, mu)))?;
            if gradient { numbers(&found) } else { Ok(vec![found.extract::<f64>()?]) }
        });
        told(&self.failures, (name, count), called, || format!("time {time}, momentum {mu:?}"))
    }

    /// Checks that the energy is independent of the time, at a few times, and that the gradient agrees with central
    /// differences; records a failure otherwise.
    fn check(&self, time: f64, mu: &[f64]) -> bool {
        let energy = self.value(time, mu);
        if LATER.iter().any(|later| (self.value(time + later, mu) - energy).abs() > 0.0) {
            let help = "write it as text, in which t is the time";
            self.fail(format!("the energy depends on the time, as no function may: {help}"), None);
            return false;
        }
        let gradient = self.call(true, time, mu);
        let size = mu.iter().fold(1e-3_f64, |size, x| size.max(x.abs()));
        let spacing = SPACING * size;
        let difference = |i: usize| {
            let at = |by: f64| {
                let mut mu = mu.to_vec();
                mu[i] += by;
                self.value(time, &mu)
            };
            (at(spacing) - at(-spacing)) / (2.0 * spacing)
        };
        let differences: Vec<f64> = (0..mu.len()).map(difference).collect();
        let both = gradient.iter().chain(&differences);
        let scale = both.fold(0.0_f64, |scale, x| scale.max(x.abs()));
        // The effect of rounding of the energy on a difference.
        let rounding = 1e-15 * energy.abs() / spacing;
        let apart = |i: &usize| (gradient[*i] - differences[*i]).abs() > SAME * scale + rounding;
        let Some(i) = (0..mu.len()).find(apart) else { return true };
        self.fail(
            format!(
                "the gradient is not that of the energy: at time {time}, momentum {mu:?}, its number {i} is {}, and {} by \
                 differences of the energy",
                gradient[i], differences[i]
            ),
            None,
        );
        false
    }
}

impl Oracle for Callables {
    fn value(&self, time: f64, mu: &[f64]) -> f64 {
        self.call(false, time, mu).first().copied().unwrap_or(f64::NAN)
    }

    fn gradient(&self, time: f64, mu: &[f64]) -> Vec<f64> {
        if !self.checked.load(Ordering::Relaxed) {
            if !self.check(time, mu) {
                return vec![f64::NAN; mu.len()];
            }
            self.checked.store(true, Ordering::Relaxed);
        }
        self.call(true, time, mu)
    }
}
