//! Reading the system file.

use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::system::{Options, Parameters, System};
use coadjoint_run::{meet_tolerance as meet, read_with};

pub use coadjoint_run::integrator;

use crate::arguments::{Accuracy, Source};
use crate::error::CliError;

/// The text of the file at `path`.
pub fn text(path: &Path) -> Result<String, CliError> {
    read_text(path).map_err(|source| CliError::Read { path: path.into(), source })
}

/// Reads the file at `path`.
pub fn file(path: &Path, options: Options) -> Result<System, CliError> {
    Ok(read_with(&path.display().to_string(), &text(path)?, options)?)
}

/// Reads the system of a command.
pub fn source(
    source: &Source,
    truncation: Option<usize>,
    parameters: Parameters,
) -> Result<System, CliError> {
    file(&source.file, source.options(truncation, parameters))
}

/// Picks truncation and step where a tolerance is asked for, on the command line or in the file,
/// and says so on the error stream. `truncation` and `time` are what the command line gives.
pub fn meet_tolerance(
    path: &Path,
    system: &mut System,
    asked: &Accuracy,
    truncation: Option<usize>,
    time: Option<f64>,
) -> Result<(), CliError> {
    let Accuracy { step, tolerance, region } = *asked;
    let asked = coadjoint_run::Accuracy { step, tolerance, region, truncation, time };
    if let Some(choice) = meet(path, system, &asked)? {
        eprintln!("{choice}");
    }
    Ok(())
}
