//! The extension module of the Python package `coadjoint`: systems that are known as text, run by `coadjoint-run`.
//!
//! Python's own part of the package (`coadjoint/`) builds the text, checks what users pass, and gives results their form.

mod asked;
mod control;
mod derivative;
mod emit;
mod error;
mod event;
mod files;
mod function;
mod lattice;
mod learn;
mod outcome;
mod record;
mod stepper;
mod system;
mod worker;

use pyo3::prelude::*;

/// The extension module.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::derivative::{backward, forward, largest_exponent};
    #[pymodule_export]
    use super::files::{read_text, write_text};
    #[pymodule_export]
    use super::lattice::simulate_lattice;
    #[pymodule_export]
    use super::learn::{ModelCore, learn};
    #[pymodule_export]
    use super::stepper::{ControlLoop, Stepper};
    #[pymodule_export]
    use super::system::Core;

    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
