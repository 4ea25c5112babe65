//! Reading the system file.

use std::path::Path;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::system::{self, Options, Parameters, System};

use crate::arguments::Source;
use crate::error::CliError;

/// Reads the file at `path`.
pub fn file(path: &Path, options: Options) -> Result<System, CliError> {
    let text = std::fs::read_to_string(path)
        .map_err(|source| CliError::Read { path: path.into(), source })?;
    system::read(&text, options)
        .map_err(|mistakes| CliError::Input(mistakes.render(&path.display().to_string(), &text)))
}

/// Reads the system of a command.
pub fn source(
    source: &Source,
    truncation: Option<usize>,
    parameters: Parameters,
) -> Result<System, CliError> {
    let (chart, solver) = (source.chart.map(Into::into), source.solver.map(Into::into));
    file(&source.file, Options { parameters, truncation, chart, solver })
}

/// Derives and lowers a problem.
pub fn integrator(path: &Path, problem: Problem) -> Result<Integrator, CliError> {
    Integrator::build(problem, TermLimit::default())
        .map_err(|source| CliError::Derive { file: path.into(), source })
}
