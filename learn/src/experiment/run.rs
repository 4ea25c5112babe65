//! Running experiments by name.

use std::path::PathBuf;

use super::report::Report;
use super::{
    geometrize, hamilton_jacobi, hamiltonian, noise, reduction_error, simulation, table_one,
    table_two,
};
use crate::error::LearnError;

/// The experiments, in the order `all` runs them.
pub const NAMES: [&str; 8] = [
    "simulation",
    "table-2",
    "hamiltonian",
    "geometrize",
    "hamilton-jacobi",
    "reduction-error",
    "noise",
    "table-1",
];

/// How to run an experiment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RunOptions {
    /// Fewer samples and steps, smaller networks: seconds in place of minutes.
    pub quick: bool,
    /// The seed everything follows from.
    pub seed: u64,
    /// Where to write the report and the curves.
    pub out: Option<PathBuf>,
}

/// Runs the experiment `name`, or `all` in turn. With a folder to write to, `all` skips what is
/// already there, so that an interrupted run goes on where it stopped.
///
/// `say` is told what is being done, a line at a time.
///
/// # Errors
/// [`LearnError::InvalidOption`] for an unknown name, else what went wrong.
pub fn run(
    name: &str,
    options: &RunOptions,
    say: &mut dyn FnMut(&str),
) -> Result<Vec<Report>, LearnError> {
    let names: Vec<&str> = match NAMES.iter().find(|&&n| n == name) {
        Some(&name) => vec![name],
        None if name == "all" => NAMES.to_vec(),
        None => {
            return Err(LearnError::InvalidOption {
                option: "experiment",
                value: name.into(),
                requirement: format!("use one of {}, or all", NAMES.join(", ")),
            });
        }
    };
    let resume = name == "all";
    let mut reports = Vec::new();
    for name in names {
        let done = options
            .out
            .as_ref()
            .filter(|_| resume)
            .and_then(|folder| Report::read(folder, name, options));
        if let Some(report) = done {
            say(&format!("{name}: done already"));
            reports.push(report);
            continue;
        }
        say(&format!("{name} …"));
        let report = match name {
            "simulation" => simulation::run(options)?,
            "table-1" => table_one::run(options, say)?,
            "noise" => noise::run(options, say)?,
            "table-2" => table_two::run(options, say)?,
            "hamiltonian" => hamiltonian::run(options)?,
            "geometrize" => geometrize::run(options)?,
            "hamilton-jacobi" => hamilton_jacobi::run(options)?,
            _ => reduction_error::run(options)?,
        };
        if let Some(folder) = &options.out {
            report.write(folder)?;
        }
        reports.push(report);
    }
    Ok(reports)
}

impl RunOptions {
    /// A report to fill in.
    pub(super) fn report(&self, name: &str) -> Report {
        Report {
            name: name.into(),
            quick: self.quick,
            seed: self.seed,
            tables: Vec::new(),
            notes: Vec::new(),
            curves: Vec::new(),
        }
    }

    /// A seed of its own for every use.
    pub(super) fn seed(&self, use_number: u64) -> u64 {
        self.seed.wrapping_mul(1_000_003).wrapping_add(use_number)
    }

    /// `full`, or `quick` in the short version.
    pub(super) fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}
