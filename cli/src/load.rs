//! Reading the system file.

use std::path::Path;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::system::{self, Options, Parameters, Run, System};
use coadjoint_codegen::tolerance::{self, Target};

use crate::arguments::{Accuracy, Source};
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

/// Where a truncation is picked, series may become this large.
const AFFORDABLE: TermLimit = TermLimit { terms: 20_000, products: 2_000_000 };

/// Picks truncation and step where a tolerance is asked for, on the command line or in the file,
/// and says so on the error stream. `truncation` and `time` are what the command line gives.
pub fn meet_tolerance(
    path: &Path,
    System { problem, potential, run, .. }: &mut System,
    asked: &Accuracy,
    truncation: Option<usize>,
    time: Option<f64>,
) -> Result<(), CliError> {
    let replaced = asked.tolerance.is_none() && asked.step.is_some();
    let Some(tolerance) = asked.tolerance.or(run.tolerance).filter(|_| !replaced) else {
        return Ok(());
    };
    if potential.is_some() {
        return Err(CliError::Option(
            "a tolerance says nothing of the kicks of a potential: give the step instead".into(),
        ));
    }
    let duration = time.or(run.time).ok_or_else(|| CliError::Missing {
        file: path.into(),
        key: "[run] time",
        example: "time = 100.0",
        option: "--time 100",
    })?;
    let target = Target {
        tolerance,
        duration,
        start: run.momentum.clone(),
        region: asked.region.map(tolerance::Region::Ball).or_else(|| run.region.clone()),
        truncation: truncation.or(run.truncation),
    };
    let choice = tolerance::choose(problem, &target, AFFORDABLE)
        .map_err(|source| CliError::Tolerance { file: path.into(), source })?;
    eprintln!("{choice}");
    problem.truncation = choice.truncation;
    *run = Run { step: Some(choice.step), ..run.clone() };
    Ok(())
}
