//! `coadjoint simulate`: a run, what it kept, and pictures of it.

mod interrupt;
mod keep;
mod lattice;
mod plot;
mod records;
mod report;
mod samples;
mod settings;
mod target;

use std::path::Path;
use std::sync::Arc;

use coadjoint_codegen::system::{Parameters, Run, Units};
use coadjoint_learn::ModelFile;
use coadjoint_run::simulate::{Schedule, Setup, Sink, run_model};
use coadjoint_run::{Derived, System, inputs_files, read_varying, text_hash};

use crate::arguments::SimulateOptions;
use crate::error::CliError;
use crate::source::{Accuracy, Source};
use crate::{load, progress};
use keep::{Trajectory, keep};
use settings::{Header, Settings, every};
use target::{Destination, Place, paths};

/// Runs every truncation asked for.
pub(crate) fn run(options: &SimulateOptions) -> Result<(), CliError> {
    if options.input.model.is_none() && lattice::run(options)? {
        return Ok(());
    }
    if let Some(path) = &options.last {
        let what =
            "is the end of a lattice, and this system is none: the report and --out have its end";
        return Err(CliError::Option(format!("--final {}: {what}", path.display())));
    }
    let mut inputs = settings::inputs(options);
    let mut out = settings::check_names(options, &inputs)?;
    let (runs, units) = match &options.input.model {
        Some(path) => (vec![follow(path, options, out.clone())?], Units::default()),
        None => {
            let read = read(options)?;
            let tables = inputs_files(&inputs[0], read.systems[0].signals());
            if !tables.is_empty() {
                inputs.extend(tables);
                out = settings::check_names(options, &inputs)?;
            }
            runs(options, read, out.as_ref())?
        }
    };
    if let Some(path) = &options.plot {
        plot::draw(path, &paths(&inputs), &runs, &units)?;
    }
    let report = report::report(&runs, &units, options.format);
    // Records on the standard output are not mixed with the report.
    if out.is_some_and(|out| out.place == Place::Standard) {
        err!("{report}");
    } else {
        out!("{report}");
    }
    Ok(())
}

/// The systems of all truncations asked for, and the hash of their text.
struct Read {
    systems: Vec<System>,
    hash: String,
}

/// Reads the system of every truncation asked for.
fn read(options: &SimulateOptions) -> Result<Read, CliError> {
    let source = options.input.source(None);
    let path = &source.file;
    // Read once: all runs are of this text, and its hash is that of what was run.
    let text = load::text(path)?;
    let read = |truncation| {
        let source = Source { truncation, ..source.clone() };
        let given = source.options(Parameters::Substituted);
        let name = path.display().to_string();
        let system = read_varying(&name, &text, given, &[])?;
        match &options.until {
            Some(function) => settings::with_end(&name, &text, function, given),
            None => Ok(system),
        }
    };
    let systems: Vec<System> = if options.truncation.is_empty() {
        vec![read(None)?]
    } else {
        options.truncation.iter().map(|&k| read(Some(k))).collect::<Result<_, CliError>>()?
    };
    Ok(Read { systems, hash: text_hash(&text) })
}

/// Runs every truncation asked for, and the rival.
fn runs(
    options: &SimulateOptions,
    Read { systems, hash }: Read,
    out: Option<&Destination>,
) -> Result<(Vec<Trajectory>, Units), CliError> {
    let path = &options.input.source(None).file;
    let outs = outs(out, &systems)?;
    let mut runs = Vec::new();
    let units = systems[0].units.clone();
    for (mut system, out) in systems.into_iter().zip(outs) {
        let truncation = system.problem.facts().truncation;
        let phase = progress::phase("choosing the step");
        let fixed = (!options.truncation.is_empty()).then_some(truncation);
        let asked = options.accuracy.of_run(fixed, options.t0, options.time);
        let met = load::meet_tolerance(path, &mut system, &asked)?;
        drop(phase);
        let choice = met.as_ref().map(|(choice, _)| choice.clone());
        let setup = Setup { choice, ..settings::setup(options, path, &asked, &system.run)? };
        let settings = Settings::new(options, (path, &hash), out, setup)?;
        let setup = &settings.setup;
        let announcement = setup.schedule.announcement();
        if let Some(line) = announcement.filter(|_| runs.is_empty()) {
            errln!("{line}");
        }
        let system = match met {
            Some((_, derived)) => derived,
            None => Arc::new(derived(path, system)?),
        };
        let header = Header::new(&settings, &system);
        let coordinates = system.facts().coordinates;
        let label = system.label();
        let drive = |sink: &mut dyn Sink| coadjoint_run::simulate::run(&system, setup, sink);
        runs.push(keep(&settings, label, header, coordinates, drive)?);
    }
    Ok((runs, units))
}

/// Prepares a system, and shows how long that has been taking.
pub(crate) fn derived(path: &Path, system: System) -> Result<Derived, CliError> {
    let what = match system.problem.polynomial() {
        Some(problem) => format!("deriving the series, K = {}", problem.truncation),
        None => "writing the programs of a step".to_owned(),
    };
    let _phase = progress::phase(&what);
    let system = Derived::of_file(path, system)?;
    system.prepare();
    Ok(system)
}

/// Follows a learned map, which has its own step.
fn follow(
    path: &Path,
    options: &SimulateOptions,
    out: Option<Destination>,
) -> Result<Trajectory, CliError> {
    if options.start.is_empty() {
        return Err(unsaid("start"));
    }
    let (model, schedule) = model(path, &options.accuracy, options.time)?;
    let hash = text_hash(&load::text(path)?);
    if let Some(bad) = options.start.iter().find(|value| !value.is_finite()) {
        return Err(CliError::Option(format!("--start: {bad} is no finite number")));
    }
    let every = Some(every(options.every.unwrap_or(1))?);
    let setup = Setup { every, ..Setup::new(schedule, options.start.clone()) };
    let settings = Settings::new(options, (path, &hash), out, setup)?;
    let coordinates: Vec<String> = (0..options.start.len()).map(|i| format!("mu[{i}]")).collect();
    let label = format!("learned {}, {}", model.model.name(), model.chart);
    let header = Header::of_model(&settings, &model);
    let drive = |sink: &mut dyn Sink| run_model(path, &model, &settings.setup, sink);
    keep(&settings, label, header, &coordinates, drive)
}

/// A model and its steps that end at the time T.
pub(crate) fn model(
    path: &Path,
    accuracy: &Accuracy,
    time: Option<f64>,
) -> Result<(ModelFile, Schedule), CliError> {
    if accuracy.step.is_some() || accuracy.tolerance.is_some() {
        let what = "a learned model has a step of its own: leave out --step and --tolerance";
        return Err(CliError::Option(what.to_owned()));
    }
    let time = time.ok_or_else(|| unsaid("time"))?;
    let model = ModelFile::load(path)?;
    let schedule = Schedule::of_model(model.step, time)?;
    Ok((model, schedule))
}

fn unsaid(option: &str) -> CliError {
    CliError::Option(format!("a learned model says nothing about {option}: give --{option}"))
}

/// The steps of a run, by the options, else by the file. Where it is
/// not the step asked for, a line on the error stream says so.
pub(crate) fn schedule(
    file: &Path,
    asked: &coadjoint_run::Accuracy,
    run: &Run,
) -> Result<Schedule, CliError> {
    let schedule = Schedule::new(file, asked, run)?;
    if let Some(line) = schedule.announcement() {
        errln!("{line}");
    }
    Ok(schedule)
}

/// The targets of the records of each system. Several truncations go to a file each; the names are announced.
fn outs(
    out: Option<&Destination>,
    systems: &[System],
) -> Result<Vec<Option<Destination>>, CliError> {
    let (Some(out), true) = (out, systems.len() > 1) else {
        return Ok(vec![out.cloned(); systems.len()]);
    };
    let numbered = systems.iter().map(|system| out.numbered(system.problem.facts().truncation));
    let targets: Vec<Destination> = numbered.collect::<Result<_, _>>()?;
    let names: Vec<String> = targets.iter().map(|t| t.path.display().to_string()).collect();
    errln!("--out: a file for each truncation, {}", names.join(", "));
    Ok(targets.into_iter().map(Some).collect())
}
