//! `coadjoint ensemble`: many trajectories of one system, from a file of states to a file of
//! states.

mod journal;
mod report;
mod run;
mod shard;
mod states;

pub(crate) use shard::Shard;

use std::path::{Path, PathBuf};

use coadjoint_codegen::system::Parameters;
use coadjoint_program::{Precision, WIDTH};
use coadjoint_run::ensemble::{Attitude, Course, Engine, How, Known, Shape, Use, in_lanes};
use coadjoint_run::simulate::Times;
use coadjoint_run::{inputs_files, inputs_hash, learned};

use crate::arguments::EnsembleOptions;
use crate::error::CliError;
use crate::form::Form;
use crate::note::Identity;
use crate::{load, simulate};
use journal::fingerprint;
use run::Job;
use states::States;

/// Reads, advances and writes.
pub(crate) fn run(options: &EnsembleOptions) -> Result<(), CliError> {
    let source = options.input.source(options.truncation);
    let (path, initial) = (source.file.as_path(), options.initial.as_path());
    let path = options.input.model.as_deref().unwrap_or(path);
    let accuracy = &options.accuracy;
    // A learned model has its schedule with it.
    let (mut system, attitude, schedule) = match &options.input.model {
        Some(path) => {
            let (model, schedule) = simulate::model(path, accuracy, options.time)?;
            (learned(&model)?, model.attitude, Some(schedule))
        }
        None => (load::source(&source, Parameters::Substituted)?, true, None),
    };
    let known = Known::of(&system.problem.facts(), &system.parameters);
    let tables = inputs_files(path, system.signals());
    let inputs: Vec<&Path> =
        [path, initial].into_iter().chain(tables.iter().map(PathBuf::as_path)).collect();
    // Refused before the derivation, which may take long.
    run::Files::of(&options.out).check(&inputs)?;
    let form = Form::of(&options.out, "--out")?;
    options.threads.map_or(Ok(()), check_threads)?;
    let paths = options.at.is_some();
    let mut states = States::open(initial, form, paths, Shape::of_system(&system), &known)?;
    if !attitude && states.found.layout.attitude != Attitude::None {
        return Err(CliError::Option(format!(
            "{}: the model was learned from momenta alone, so it says nothing about attitudes: leave their columns out",
            initial.display()
        )));
    }
    let varied = states.found.layout.varied();
    if !varied.is_empty() {
        system = load::varying(&source, &varied)?;
    }
    let schedule = match schedule {
        Some(schedule) => schedule,
        None => {
            let asked = accuracy.of_run(source.truncation, options.t0, options.time);
            load::meet_tolerance(path, &mut system, &asked)?;
            simulate::schedule(path, &asked, &system.run)?
        }
    };
    let (step, steps) = (schedule.step, schedule.steps);
    let at = options.at.as_deref().map(|at| Times::read(at, &schedule)).transpose()?;
    states.times = at.as_ref().map(|times| times.0.clone());
    let momentum = system.run.momentum.clone();
    let derived = simulate::derived(path, in_lanes(system)?)?;
    derived.gave_way().iter().for_each(|note| errln!("note: {note}"));
    let facts = derived.facts();
    let precision = options.precision;
    let device = options.device.map(|device| (device, precision));
    // Little is left of what a device makes.
    let work = if device.is_some() { 0.0 } else { work(options, facts.algebra.dim(), steps) };
    let how = How { backend: options.backend, work, device };
    derived.reaches(&schedule)?;
    derived.resolves(schedule.grid(), steps, momentum.as_deref())?;
    let engine = Engine::new(&derived, schedule.grid(), how)?;
    let [chart, frame] = match derived.series().map(|series| &series.problem) {
        Some(problem) => [problem.chart.to_string(), problem.frame_name().to_owned()],
        None => ["collocation", "fixed"].map(str::to_owned),
    };
    let mut identity: Identity = [
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("system file", fingerprint(path)?),
        ("initial file", fingerprint(initial)?),
        ("truncation", facts.truncation.to_string()),
        ("chart", chart),
        ("frame", frame),
        ("step", step.to_string()),
        ("number of steps", steps.to_string()),
        ("shard", options.shard.to_string()),
    ]
    .map(|(key, value)| (key.to_owned(), value))
    .into();
    // Absent is 0.
    let start = (schedule.start != 0.0).then(|| schedule.start.to_string());
    identity.extend(start.map(|start| ("initial time".to_owned(), start)));
    identity.extend(inputs_hash(derived.signals()).map(|hash| ("inputs".to_owned(), hash)));
    // In double precision all devices and processors have the same bits.
    if let Some(Use { precision: Precision::Single, name, device, .. }) = engine.device() {
        identity.insert("precision".to_owned(), format!("single, by {device} ({name})"));
    }
    if let Some(times) = &at {
        identity.insert("at".to_owned(), times.text());
    }
    let stops = at.map(|times| times.stops(&schedule)).unwrap_or_default();
    let parameters = states.found.layout.parameters.clone();
    let (range, course) = (options.shard.rows(states.count()?), Course { steps, stops });
    let job =
        Job { options, engine: &engine, inputs: &inputs, range, states, form, course, identity };
    if let Some(threads) = options.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|error| CliError::Option(format!("--threads {threads}: {error}")))?;
    }
    let outcome = run::run(job);
    engine.notes().iter().for_each(|note| errln!("warning: {note}"));
    let outcome = outcome?;
    report::warnings(&outcome, steps, &engine)
        .iter()
        .for_each(|(_, text)| errln!("warning: {text}"));
    let report =
        report::report(&outcome, (&derived, &parameters), &schedule, &engine, options.format);
    out!("{report}");
    let failed = outcome.journal.rejected;
    if outcome.trajectories > 0 && failed == outcome.trajectories {
        return Err(CliError::Rows { failed, list: outcome.list });
    }
    Ok(())
}

/// About how many steps all lanes together make: rows are guessed from the size of the file.
fn work(options: &EnsembleOptions, dim: usize, steps: u64) -> f64 {
    /// Bytes of a number in a file, about.
    const NUMBER: f64 = 16.0;
    let bytes = std::fs::metadata(&options.initial).map_or(0.0, |found| found.len() as f64);
    let rows = bytes / (NUMBER * dim as f64);
    steps as f64 * (rows / WIDTH as f64).max(1.0)
}

/// Threads that are always allowed, however few processors there are.
const THREADS: usize = 256;

/// Refuses a number of threads that no machine is faster with.
fn check_threads(threads: usize) -> Result<(), CliError> {
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let most = THREADS.max(4 * processors);
    if threads <= most {
        return Ok(());
    }
    Err(CliError::Option(format!(
        "--threads {threads}: at most {most} are started, and more than the {processors} processors \
         of this machine save no time; leave it out for one each"
    )))
}
