//! Reading the system file.

use std::path::Path;
use std::sync::Arc;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::system::{Options, Parameters};
use coadjoint_codegen::tolerance::Choice;
use coadjoint_learn::GroupChoice;
use coadjoint_run::{
    Accuracy, Derivations, Derived, System, meet_tolerance as meet, read_group, read_varying,
};

use crate::error::{CliError, unread};
use crate::source::Source;

/// The text of the file at `path`.
pub(crate) fn text(path: &Path) -> Result<String, CliError> {
    read_text(path).map_err(unread(path))
}

/// Reads the file at `path`.
pub(crate) fn file(path: &Path, options: Options) -> Result<System, CliError> {
    Ok(read_varying(&path.display().to_string(), &text(path)?, options, &[])?)
}

/// The group of this name in the catalogue, or of the system file at this path.
pub(crate) fn group(name: &str) -> Result<GroupChoice, CliError> {
    match system_file(name) {
        Some(path) => Ok(read_group(name, &text(path)?)?),
        None => Ok(name.into()),
    }
}

/// The path that a group is given by, where it is that of a system file.
pub(crate) fn system_file(group: &str) -> Option<&Path> {
    let path = Path::new(group);
    (path.extension()? == "toml").then_some(path)
}

/// Reads the system of a command, where the parameters with these names vary.
pub(crate) fn varying(source: &Source, names: &[String]) -> Result<System, CliError> {
    let (path, options) = (&source.file, source.options(Parameters::Substituted));
    Ok(read_varying(&path.display().to_string(), &text(path)?, options, names)?)
}

/// Reads the system of a command.
pub(crate) fn source(source: &Source, parameters: Parameters) -> Result<System, CliError> {
    file(&source.file, source.options(parameters))
}

/// Picks truncation, step and frame where a tolerance is asked for, on the command line or in the file,
/// and says so on the error stream; what was picked, and the system with its method.
pub(crate) fn meet_tolerance(
    path: &Path,
    system: &mut System,
    asked: &Accuracy,
) -> Result<Option<(Choice, Arc<Derived>)>, CliError> {
    let met = meet(path, system, asked, &Derivations::default())?;
    met.iter().for_each(|(choice, _)| errln!("{choice}"));
    Ok(met)
}

/// Reads the system of a command that has no run of its own, with the truncation and the step that the file's tolerance asks
/// for, as a run of the file has them; the choice is told on the error stream. What is asked for is given on the command line.
pub(crate) fn settled(
    given: &Source,
    asked: &Accuracy,
    parameters: Parameters,
) -> Result<(System, Option<Choice>), CliError> {
    let mut system = source(given, parameters)?;
    let run = &system.run;
    let missing = if run.time.is_none() {
        Some("`[run] time`")
    } else if run.momentum.is_none() && run.region.is_none() {
        Some("`[initial] momentum` or `[integrator] region`")
    } else {
        None
    };
    let choice = match missing {
        Some(key)
            if run.tolerance.is_some() && asked.step.is_none() && given.truncation.is_none() =>
        {
            return Err(CliError::Option(format!(
                "{}: `tolerance` picks the truncation, which needs {key}: add it, or give --truncation",
                given.file.display()
            )));
        }
        // Without a run there is no error at its end, by which a step could be picked.
        Some(_) => None,
        None => {
            let asked = Accuracy { truncation: given.truncation, ..*asked };
            meet_tolerance(&given.file, &mut system, &asked)?.map(|(choice, _)| choice)
        }
    };
    Ok((system, choice))
}
