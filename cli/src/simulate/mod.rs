//! `coadjoint simulate`: a run, what it kept, and pictures of it.

mod checkpoint;
mod element;
mod header;
mod interrupt;
mod keep;
mod learned;
mod plot;
mod records;
mod report;
mod rival;
mod samples;
mod setup;
mod target;
mod trajectory;

use std::path::{Path, PathBuf};

use coadjoint_codegen::system::{Parameters, Run, System, Units};
use coadjoint_run::simulate::{Schedule, Sink};
use coadjoint_run::{Derived, text_hash};

use crate::arguments::SimulateOptions;
use crate::error::CliError;
use crate::source::Source;
use crate::{load, progress};
use header::Header;
use keep::keep;
use setup::Settings;
use target::{Place, Target};
use trajectory::Trajectory;

/// Runs every truncation asked for.
pub fn run(options: &SimulateOptions) -> Result<(), CliError> {
    let out = setup::check_names(options)?;
    let (runs, units) = match &options.input.model {
        Some(path) => (vec![learned::run(path, options, out.clone())?], Units::default()),
        None => runs(options, out.as_ref())?,
    };
    if let Some(path) = &options.plot {
        let inputs = setup::inputs(options);
        let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
        plot::draw(path, &inputs, &runs, &units)?;
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
    let read = |truncation| {
        let source = Source { truncation, ..source.clone() };
        let options = source.options(Parameters::Substituted);
        coadjoint_run::read_with(&path.display().to_string(), &text, options)
    };
    let systems: Vec<System> = if options.truncation.is_empty() {
        vec![read(None)?]
    } else {
        options.truncation.iter().map(|&k| read(Some(k))).collect::<Result<_, _>>()?
    };
    let outs = outs(out, &systems)?;
    let mut runs = Vec::new();
    let units = systems[0].units.clone();
    for (mut system, out) in systems.into_iter().zip(outs) {
        let truncation = system.problem.truncation;
        let phase = progress::phase("choosing the step");
        let fixed = (!options.truncation.is_empty()).then_some(truncation);
        load::meet_tolerance(path, &mut system, &options.accuracy, fixed, options.time)?;
        drop(phase);
        let setup = setup::setup(options, path, &system)?;
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
    if options.compare.is_some() {
        runs.rotate_left(1);
    }
    Ok((runs, units))
}

/// The step size used and how many steps end at the time T, by the options, else by the file. Where it is
/// not the step asked for, a line on the error stream says so.
pub fn schedule(
    file: &Path,
    step: Option<f64>,
    time: Option<f64>,
    run: &Run,
) -> Result<(f64, u64), CliError> {
    let schedule = Schedule::new(file, step, time, run)?;
    if let Some(line) = schedule.announcement() {
        eprintln!("{line}");
    }
    Ok((schedule.step, schedule.steps))
}

/// Where the records of each system go. Several truncations go to a file each; the names are announced.
fn outs(out: Option<&Target>, systems: &[System]) -> Result<Vec<Option<Target>>, CliError> {
    let (Some(out), true) = (out, systems.len() > 1) else {
        return Ok(vec![out.cloned(); systems.len()]);
    };
    let numbered = systems.iter().map(|system| out.numbered(system.problem.truncation));
    let targets: Vec<Target> = numbered.collect::<Result<_, _>>()?;
    let names: Vec<String> = targets.iter().map(|t| t.path.display().to_string()).collect();
    eprintln!("--out: a file for each truncation, {}", names.join(", "));
    Ok(targets.into_iter().map(Some).collect())
}
