//! `coadjoint check`: the laws of the method, tried on this system at random points.

mod report;

use coadjoint_codegen::system::Parameters;
use coadjoint_run::Derived;
use coadjoint_run::check::{DEFAULT_STEP, Trial, check};

use crate::arguments::CheckOptions;
use crate::error::CliError;
use crate::load;

/// Tries all laws, prints them, and fails if one does not hold.
pub fn run(options: &CheckOptions) -> Result<(), CliError> {
    let path = &options.source.file;
    let system = load::source(&options.source, options.truncation, Parameters::Substituted)?;
    let run = system.run.clone();
    let (step, points, seed) =
        (options.step.or(run.step).unwrap_or(DEFAULT_STEP), options.points, options.seed);
    let size = run.momentum.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    let size = if size > 0.0 { size } else { 1.0 };
    let trial = Trial::new(step, size, points, seed)?;
    let system = Derived::of_file(path, system)?;
    let (laws, warning) = check(&system, &trial)?;
    if let Some(warning) = &warning {
        eprintln!("warning: {}", warning.text());
    }
    let problem = &system.integrator.problem;
    out!("{}", report::report(problem, &trial, &laws, warning.as_ref(), options.format));
    let failed: Vec<&str> = laws.iter().filter(|law| !law.pass).map(|law| law.name).collect();
    if failed.is_empty() {
        return Ok(());
    }
    Err(CliError::Laws(format!("these laws do not hold: {}", failed.join(", "))))
}
