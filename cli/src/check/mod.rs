//! `coadjoint check`: the laws of the method, tried on this system at random points.

mod report;

use coadjoint_codegen::system::Parameters;
use coadjoint_run::Derived;
use coadjoint_run::check::{Trial, check};

use crate::arguments::CheckOptions;
use crate::error::CliError;
use crate::load;

/// Tries all laws, prints them, and fails if one does not hold.
pub fn run(options: &CheckOptions) -> Result<(), CliError> {
    let path = &options.source.file;
    let (system, _) = load::settled(&options.source, options.step, Parameters::Substituted)?;
    let trial = Trial::new(options.step, &system.run, options.points, options.seed)?;
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
