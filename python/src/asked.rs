//! The options of a run, as Python passes them.

use coadjoint_run::{Accuracy, Backend};
use pyo3::prelude::*;

use crate::error::refused;

/// Finds a backend by its name.
///
/// # Errors
/// Refuses an unknown name.
pub fn backend_of(py: Python<'_>, name: &str) -> PyResult<Backend> {
    match name {
        "auto" => Ok(Backend::Auto),
        "interpreter" => Ok(Backend::Interpreter),
        "c" => Ok(Backend::C),
        "jit" => Ok(Backend::Jit),
        _ => Err(refused(
            py,
            format!("backend=\"{name}\": there are \"auto\", \"interpreter\", \"jit\" and \"c\""),
        )),
    }
}

/// The options of accuracy that both kinds of run share.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    step: Option<f64>,
    tolerance: Option<f64>,
    region: Option<f64>,
    truncation: Option<usize>,
    t0: Option<f64>,
    time: Option<f64>,
    frame: Option<String>,
}

impl Asked {
    /// Checks the options and converts them for a run.
    ///
    /// # Errors
    /// Refuses an even truncation or one above 63, and a step beside a tolerance.
    pub fn accuracy(&self, py: Python<'_>) -> PyResult<Accuracy> {
        let Self { step, tolerance, region, truncation, t0, time, .. } = *self;
        let comoving = self.frame.as_ref().map(|frame| frame == "comoving");
        if let Some(k) = truncation
            && (k % 2 == 0 || k > 63)
        {
            let what = "truncation must be an odd number from 1 to 63: the even terms vanish";
            return Err(refused(py, format!("{what}; {k} was given")));
        }
        if step.is_some() && tolerance.is_some() {
            return Err(refused(py, "give step or tolerance, not both".to_owned()));
        }
        Ok(Accuracy { step, tolerance, region, truncation, t0, time, comoving })
    }
}
