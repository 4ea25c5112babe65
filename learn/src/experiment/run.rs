//! Running experiments by name.

use std::path::{Path, PathBuf};

use super::report::Report;
use super::{
    geometrize, hamilton_jacobi, hamiltonian, harder, learned, noise, orders, reduction_error,
    simulation, table_one, table_two, work,
};
use crate::error::LearnError;

/// The experiments, in the order `all` runs them.
pub const NAMES: [&str; 12] = [
    "simulation",
    "orders",
    "work",
    "table-2",
    "hamiltonian",
    "geometrize",
    "hamilton-jacobi",
    "reduction-error",
    "learned",
    "noise",
    "table-1",
    "harder-truths",
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

/// Runs the experiment `name`, or `all` in turn. With a folder to write to, an interrupted run goes
/// on where it stopped: `all` skips experiments that are done, tables that are done are kept, and
/// networks go on from their last checkpoint.
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
    let count = names.len();
    for (number, name) in names.into_iter().enumerate() {
        let turn = if resume { format!("{} of {count}: ", number + 1) } else { String::new() };
        let done =
            options.out.as_ref().filter(|_| resume).and_then(|folder| {
                Report::read(&folder.join(format!("{name}.json")), name, options)
            });
        if let Some(report) = done {
            say(&format!("{turn}{name}: done already"));
            reports.push(report);
            continue;
        }
        say(&format!("{turn}{name} …"));
        let report = match name {
            "simulation" => simulation::run(options)?,
            "orders" => orders::run(options)?,
            "work" => work::run(options)?,
            "learned" => learned::run(options, say)?,
            "table-1" => table_one::run(options, say)?,
            "harder-truths" => harder::run(options, say)?,
            "noise" => noise::run(options, say)?,
            "table-2" => table_two::run(options, say)?,
            "hamiltonian" => hamiltonian::run(options)?,
            "geometrize" => geometrize::run(options)?,
            "hamilton-jacobi" => hamilton_jacobi::run(options)?,
            _ => reduction_error::run(options)?,
        };
        if let Some(folder) = &options.out {
            report.write(folder)?;
            clear(folder, name)?;
        }
        reports.push(report);
    }
    Ok(reports)
}

/// The ending of the tables of an unfinished experiment.
const PART: &str = ".part";
/// The ending of the state of an unfinished training.
const CHECKPOINT: &str = ".checkpoint";

/// Removes what an experiment left for its own use.
fn clear(folder: &Path, name: &str) -> Result<(), LearnError> {
    let fail = |source| LearnError::File { path: folder.into(), source };
    for entry in std::fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        let file = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        let rest = file.strip_prefix(name).filter(|rest| rest.starts_with('.'));
        if rest.is_some_and(|rest| rest.ends_with(CHECKPOINT) || rest == PART) {
            std::fs::remove_file(&path).map_err(fail)?;
        }
    }
    Ok(())
}

impl RunOptions {
    /// A report to fill in, with the tables an interrupted run has left.
    pub(super) fn report(&self, name: &str) -> Report {
        let part = self
            .out
            .as_ref()
            .and_then(|folder| Report::read(&folder.join(format!("{name}{PART}")), name, self));
        part.unwrap_or_else(|| Report {
            name: name.into(),
            quick: self.quick,
            seed: self.seed,
            tables: Vec::new(),
            notes: Vec::new(),
            judgements: Vec::new(),
            curves: Vec::new(),
        })
    }

    /// Keeps the tables so far, in case the run is interrupted.
    pub(super) fn keep(&self, report: &Report) -> Result<(), LearnError> {
        match &self.out {
            Some(folder) => {
                report.save(&folder.join(format!("{}{PART}", report.name)))?;
                report.write_curves(folder)
            }
            None => Ok(()),
        }
    }

    /// Where the training called `label`, which begins with the experiment's name, keeps its
    /// state.
    pub(super) fn checkpoint(&self, label: &str) -> Option<PathBuf> {
        let folder = self.out.as_ref()?;
        // Where the folder cannot be made, writing the checkpoint says so.
        let _ = std::fs::create_dir_all(folder);
        Some(folder.join(format!("{label}{CHECKPOINT}")))
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
