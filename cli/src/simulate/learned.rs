//! `coadjoint simulate --model`: a learned map, run by the driver of every other run.

use std::path::Path;

use coadjoint_learn::{LearnError, ModelFile};
use coadjoint_run::simulate::{Setup, Sink, algebra_of, run_model, schedule_of};
use coadjoint_run::text_hash;

use super::header::Header;
use super::keep::keep;
use super::setup::{Settings, every};
use super::target::Target;
use super::trajectory::Trajectory;
use crate::arguments::SimulateOptions;
use crate::error::CliError;
use crate::load;

/// Follows a learned map, which has its own step.
pub fn run(
    path: &Path,
    options: &SimulateOptions,
    out: Option<Target>,
) -> Result<Trajectory, CliError> {
    let missing = |option: &str| {
        CliError::Option(format!("a learned model says nothing about {option}: give --{option}"))
    };
    if options.accuracy.step.is_some() || options.accuracy.tolerance.is_some() {
        let what = "a learned model has a step of its own: leave out --step and --tolerance";
        return Err(CliError::Option(what.to_owned()));
    }
    if options.start.is_empty() {
        return Err(missing("start"));
    }
    let time = options.time.ok_or_else(|| missing("time"))?;
    let text = load::text(path)?;
    let model = ModelFile::load(path)?;
    let (expected, found) = (algebra_of(&model)?.dim(), options.start.len());
    if found != expected {
        return Err(LearnError::Shape { what: "the start".into(), expected, found }.into());
    }
    if let Some(bad) = options.start.iter().find(|value| !value.is_finite()) {
        return Err(CliError::Option(format!("--start: {bad} is no finite number")));
    }
    let schedule = schedule_of(time, model.step)?;
    let every = Some(every(options.every.unwrap_or(1))?);
    let setup = Setup { every, ..Setup::new(schedule, options.start.clone()) };
    let settings = Settings::new(options, (path, &text_hash(&text)), out, setup)?;
    let coordinates: Vec<String> = (0..expected).map(|i| format!("mu[{i}]")).collect();
    let label = format!("learned {}, {}", model.model.name(), model.chart);
    let header = Header::of_model(&settings, &model);
    let drive = |sink: &mut dyn Sink| run_model(path, &model, &settings.setup, sink);
    keep(&settings, label, header, &coordinates, drive)
}
