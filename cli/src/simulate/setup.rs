//! The settings of a run, from the file and the options that replace them.

use std::path::{Path, PathBuf};
use std::time::Duration;

use coadjoint_codegen::file;
use coadjoint_codegen::system::System;
use coadjoint_run::RunError;
use coadjoint_run::simulate::{Schedule, Setup, Times};

use super::target::{Place, Target};
use crate::arguments::SimulateOptions;
use crate::error::{CliError, unwritten};

/// The settings of a run, and what is kept of it.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    /// The system file.
    pub file: PathBuf,
    /// The SHA-256 of its text.
    pub hash: String,
    /// Everything the run reads.
    pub inputs: Vec<PathBuf>,
    /// From where, how far, in which steps.
    pub setup: Setup,
    /// Where records go.
    pub out: Option<Target>,
    /// Whether a picture is asked for.
    pub sampled: bool,
    /// Where the state is kept, and how often.
    pub checkpoint: Option<(PathBuf, Duration)>,
}

impl Settings {
    /// Puts the settings of a run of `file` together.
    ///
    /// # Errors
    /// Where the interval of checkpoints is no duration.
    pub(crate) fn new(
        options: &SimulateOptions,
        (file, hash): (&Path, &str),
        out: Option<Target>,
        setup: Setup,
    ) -> Result<Self, CliError> {
        let what = "--checkpoint-interval must be a number of seconds, 0 or more";
        let interval = Duration::try_from_secs_f64(options.checkpoint_interval);
        let checkpoint = match (options.checkpoint.clone(), interval) {
            (None, _) => None,
            (Some(path), Ok(interval)) => Some((path, interval)),
            (Some(_), Err(_)) => return Err(CliError::Option(what.to_owned())),
        };
        Ok(Self {
            file: file.to_owned(),
            hash: hash.to_owned(),
            inputs: inputs(options),
            setup: Setup { recording: out.is_some(), ..setup },
            out,
            sampled: options.plot.is_some(),
            checkpoint,
        })
    }

    /// Everything the run reads.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        self.inputs.iter().map(PathBuf::as_path).collect()
    }
}

/// The run of a system, by the options, else by the file, or which setting is missing.
///
/// # Errors
/// A setting that is missing or makes no sense.
pub(crate) fn setup(
    options: &SimulateOptions,
    file: &Path,
    system: &System,
) -> Result<Setup, CliError> {
    let run = &system.run;
    let schedule = Schedule::new(file, options.accuracy.step, options.time, run)?;
    let momentum = run.momentum.clone().ok_or_else(|| RunError::Missing {
        file: file.into(),
        key: "[initial] momentum",
        example: "momentum = [2.0, 0.5, 1.0]",
        option: "another file",
    })?;
    let at = options.at.as_deref().map(|at| Times::read(at, &schedule)).transpose()?;
    // Times alone are recorded alone; a step count in the file is then no request.
    let every = match (options.every, &at) {
        (None, Some(_)) => None,
        (count, _) => Some(every(count.or(run.every).unwrap_or(1))?),
    };
    let (backend, group_element) = (options.backend, run.group_element.clone());
    Ok(Setup { every, at, backend, group_element, ..Setup::new(schedule, momentum) })
}

/// Everything a run reads.
pub(crate) fn inputs(options: &SimulateOptions) -> Vec<PathBuf> {
    let times = options.at.iter().map(PathBuf::from);
    let system = options.input.model.clone().unwrap_or_else(|| options.input.source(None).file);
    std::iter::once(system).chain(times).collect()
}

/// Every how many steps a record is written.
///
/// # Errors
/// Where it is 0.
pub(crate) fn every(steps: usize) -> Result<u64, CliError> {
    match steps {
        0 => Err(CliError::Option("--every counts steps from 1; try --every 1".to_owned())),
        steps => Ok(steps as u64),
    }
}

/// Refuses names of files that cannot be what they are to be, before anything is computed.
///
/// # Errors
/// By the name of the option.
pub(crate) fn check_names(options: &SimulateOptions) -> Result<Option<Target>, CliError> {
    let refuse = |what: String| Err(CliError::Option(what));
    let inputs = inputs(options);
    let out = options.out.as_deref().map(|out| Target::new(out, &inputs)).transpose()?;
    let mut used = inputs;
    used.extend(out.iter().flat_map(Target::names));
    for path in options.plot.iter().chain(&options.checkpoint) {
        let others: Vec<&Path> = used.iter().map(PathBuf::as_path).collect();
        file::check(path, &others).map_err(unwritten(path))?;
        used.push(path.clone());
    }
    if let Some(plot) = &options.plot {
        let ending = plot.extension().and_then(|ending| ending.to_str());
        if !ending.is_some_and(|ending| ending.eq_ignore_ascii_case("svg")) {
            return refuse(format!(
                "--plot {}: only SVG is drawn; give a name that ends in .svg and convert the picture",
                plot.display()
            ));
        }
    }
    if options.checkpoint.is_none() {
        return Ok(out);
    }
    if options.truncation.len() > 1 {
        return refuse("--checkpoint is of one run: give one --truncation".to_owned());
    }
    if let Some(out) = out.as_ref().filter(|out| out.place != Place::File) {
        return refuse(format!(
            "--checkpoint: what was written to {} cannot be continued; write to a file",
            out.path.display()
        ));
    }
    Ok(out)
}
