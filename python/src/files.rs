//! Files, by the functions of the command.

use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

use coadjoint_codegen::{diagnostic, file};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::error::refused;

/// The text of a file.
#[pyfunction]
pub fn read_text(py: Python<'_>, path: PathBuf) -> PyResult<String> {
    diagnostic::read_text(&path).map_err(|error| raised(py, &path, &error))
}

/// Writes a text: all of it, or what was there stays.
#[pyfunction]
pub fn write_text(py: Python<'_>, path: PathBuf, text: &str) -> PyResult<()> {
    file::write(&path, &[], text.as_bytes()).map_err(|error| raised(py, &path, &error))
}

/// An error of the system as Python's own `open` has it; a name or a content that makes no sense as the package's.
fn raised(py: Python<'_>, path: &Path, error: &Error) -> PyErr {
    let path = path.display().to_string();
    match (error.raw_os_error(), error.kind()) {
        (Some(code), _) => PyOSError::new_err((code, error.to_string(), path)),
        (None, ErrorKind::InvalidInput | ErrorKind::InvalidData) => {
            refused(py, format!("{path}: {error}"))
        }
        _ => PyOSError::new_err(format!("{path}: {error}")),
    }
}
