//! `coadjoint simulate`: a run, what it kept, and pictures of it.

mod element;
mod interrupt;
mod keep;
mod plot;
mod records;
mod report;
mod rival;
mod samples;
mod settings;
mod target;

use std::path::Path;

use coadjoint_codegen::smooth::{Hamiltonian, Smooth};
use coadjoint_codegen::system::{Parameters, Run, System, Units};
use coadjoint_learn::{LearnError, ModelFile};
use coadjoint_run::simulate::{Schedule, Setup, Sink, run_model, run_smooth};
use coadjoint_run::{Backend, Derived, text_hash};

use crate::arguments::SimulateOptions;
use crate::error::CliError;
use crate::source::{Accuracy, Source};
use crate::{load, progress};
use keep::{Trajectory, keep};
use settings::{Header, Settings, every};
use target::{Place, Target, paths};

/// Runs every truncation asked for.
pub(crate) fn run(options: &SimulateOptions) -> Result<(), CliError> {
    let out = settings::check_names(options)?;
    let (runs, units) = match &options.input.model {
        Some(path) => (vec![follow(path, options, out.clone())?], Units::default()),
        None => runs(options, out.as_ref())?,
    };
    if let Some(path) = &options.plot {
        plot::draw(path, &paths(&settings::inputs(options)), &runs, &units)?;
    }
    let report = report::report(&runs, &units, options.format);
    // Records on the standard output are not mixed with the report.
    if out.is_some_and(|out| out.place == Place::Standard) {
        eprint!("{report}");
    } else {
        out!("{report}");
    }
    Ok(())
}

/// Runs every truncation asked for, and the rival.
fn runs(
    options: &SimulateOptions,
    out: Option<&Target>,
) -> Result<(Vec<Trajectory>, Units), CliError> {
    let source = options.input.source(None);
    let path = &source.file;
    // Read once: all runs are of this text, and its hash is that of what was run.
    let text = load::text(path)?;
    let hash = text_hash(&text);
    let text = settings::with_end(text, options)?;
    let read = |truncation| {
        let source = Source { truncation, ..source.clone() };
        let options = source.options(Parameters::Substituted);
        coadjoint_run::read_either(&path.display().to_string(), &text, options)
    };
    let systems: Vec<System<Hamiltonian>> = if options.truncation.is_empty() {
        vec![read(None)?]
    } else {
        options.truncation.iter().map(|&k| read(Some(k))).collect::<Result<_, _>>()?
    };
    let outs = outs(out, &systems)?;
    let mut runs = Vec::new();
    let units = systems[0].units.clone();
    for (system, out) in systems.into_iter().zip(outs) {
        let System { problem, potential, run, units, parameters } = system;
        let problem = match problem {
            Hamiltonian::Polynomial(problem) => *problem,
            Hamiltonian::Smooth(smooth) => {
                runs.push(collocated(options, (path, &hash), out, &smooth, &run)?);
                continue;
            }
        };
        let mut system = System { problem, potential, run, units, parameters };
        let truncation = system.problem.truncation;
        let phase = progress::phase("choosing the step");
        let fixed = (!options.truncation.is_empty()).then_some(truncation);
        load::meet_tolerance(path, &mut system, &options.accuracy, fixed, options.time)?;
        drop(phase);
        let setup = settings::setup(options, path, &system.run)?;
        let settings = Settings::new(options, (path, &hash), out, setup)?;
        let setup = &settings.setup;
        let announcement = setup.schedule.announcement();
        if let Some(line) = announcement.filter(|_| runs.is_empty()) {
            eprintln!("{line}");
        }
        let phase =
            progress::phase(&format!("deriving the series, K = {}", system.problem.truncation));
        let system = Derived::of_file(path, system)?;
        drop(phase);
        let problem = &system.integrator.problem;
        let splitting = system.forces.as_ref().map(|forces| forces.splitting);
        let header = Header::new(&settings, problem, splitting);
        let (label, coordinates) = (system.label(), &problem.coordinates);
        let drive = |sink: &mut dyn Sink| coadjoint_run::simulate::run(&system, setup, sink);
        let made = keep(&settings, label, header.clone(), coordinates, drive)?;
        runs.push(Trajectory { truncation: Some(problem.truncation), ..made });
        // The rival knows no truncation: once is enough.
        if options.compare.is_some() && runs.len() == 1 {
            runs.insert(0, rival::rk45(&system, &settings, header, options.compare_tolerance)?);
        }
    }
    // The rival, if any, comes last.
    if options.compare.is_some() && !runs.is_empty() {
        runs.rotate_left(1);
    }
    Ok((runs, units))
}

/// Runs a system whose Hamiltonian is no polynomial.
fn collocated(
    options: &SimulateOptions,
    (path, hash): (&Path, &str),
    out: Option<Target>,
    smooth: &Smooth,
    run: &Run,
) -> Result<Trajectory, CliError> {
    let by_tolerance = options.accuracy.tolerance.is_some()
        || options.accuracy.step.or(run.step).is_none() && run.tolerance.is_some();
    for (asked, option, advice) in [
        (by_tolerance, "a tolerance", "give --step"),
        (options.compare.is_some(), "--compare", "leave it out"),
        (options.checkpoint.is_some(), "--checkpoint", "leave it out"),
        (
            !matches!(options.backend, Backend::Auto | Backend::Interpreter),
            "a compiled --backend",
            "leave it out",
        ),
    ] {
        if asked {
            return Err(CliError::Option(format!(
                "{option} is for polynomials: the Hamiltonian of {} is none, and runs by collocation; {advice}",
                path.display()
            )));
        }
    }
    let setup = settings::setup(options, path, run)?;
    let settings = Settings::new(options, (path, hash), out, setup)?;
    if let Some(line) = settings.setup.schedule.announcement() {
        eprintln!("{line}");
    }
    let label = format!("collocation, {} nodes", smooth.nodes());
    let header = Header::of_smooth(&settings, smooth);
    let drive = |sink: &mut dyn Sink| run_smooth(path, smooth, &settings.setup, sink);
    keep(&settings, label, header, &smooth.coordinates, drive)
}

/// Follows a learned map, which has its own step.
fn follow(
    path: &Path,
    options: &SimulateOptions,
    out: Option<Target>,
) -> Result<Trajectory, CliError> {
    if options.start.is_empty() {
        return Err(unsaid("start"));
    }
    let (model, schedule) = model(path, &options.accuracy, options.time)?;
    let hash = text_hash(&load::text(path)?);
    let (expected, found) = (model.group.algebra()?.dim(), options.start.len());
    if found != expected {
        return Err(LearnError::Shape { what: "the start".into(), expected, found }.into());
    }
    if let Some(bad) = options.start.iter().find(|value| !value.is_finite()) {
        return Err(CliError::Option(format!("--start: {bad} is no finite number")));
    }
    let every = Some(every(options.every.unwrap_or(1))?);
    let setup = Setup { every, ..Setup::new(schedule, options.start.clone()) };
    let settings = Settings::new(options, (path, &hash), out, setup)?;
    let coordinates: Vec<String> = (0..expected).map(|i| format!("mu[{i}]")).collect();
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

/// The steps that end at the time T, by the options, else by the file. Where it is
/// not the step asked for, a line on the error stream says so.
pub(crate) fn schedule(
    file: &Path,
    step: Option<f64>,
    time: Option<f64>,
    run: &Run,
) -> Result<Schedule, CliError> {
    let schedule = Schedule::new(file, step, time, run)?;
    if let Some(line) = schedule.announcement() {
        eprintln!("{line}");
    }
    Ok(schedule)
}

/// Where the records of each system go. Several truncations go to a file each; the names are announced.
fn outs(
    out: Option<&Target>,
    systems: &[System<Hamiltonian>],
) -> Result<Vec<Option<Target>>, CliError> {
    let (Some(out), true) = (out, systems.len() > 1) else {
        return Ok(vec![out.cloned(); systems.len()]);
    };
    let numbered = systems.iter().map(|system| out.numbered(system.problem.truncation()));
    let targets: Vec<Target> = numbered.collect::<Result<_, _>>()?;
    let names: Vec<String> = targets.iter().map(|t| t.path.display().to_string()).collect();
    eprintln!("--out: a file for each truncation, {}", names.join(", "));
    Ok(targets.into_iter().map(Some).collect())
}
