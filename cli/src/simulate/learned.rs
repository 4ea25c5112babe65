//! `coadjoint simulate --model`: a learned map, run by the driver of every other run.

use std::path::Path;

use coadjoint::{Cayley, Chart, Exponential, StepError, advance};
use coadjoint_codegen::lie::catalogue;
use coadjoint_codegen::system::Units;
use coadjoint_learn::{Generating, LearnError, ModelFile};
use nalgebra::DVector;

use super::header::{Header, text_hash};
use super::march::{Made, March, Stepper, each};
use super::schedule::Schedule;
use super::setup::{Setup, check_names, checkpoint, every};
use super::subject::Subject;
use super::trajectory::{Trajectory, Watched};
use super::warning::Warning;
use crate::arguments::SimulateOptions;
use crate::engine::Restore;
use crate::engine::{cayley_group, product_group};
use crate::error::CliError;

/// How far, relatively, a time may be from a whole number of steps.
const WHOLE: f64 = 1e-9;
/// The most steps of a run: beyond, the time is surely a slip.
const MOST_STEPS: f64 = 1e12;

/// Follows a learned map, which has its own step.
pub fn run(path: &Path, options: &SimulateOptions) -> Result<(), CliError> {
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
    let out = check_names(options)?;
    let text = std::fs::read_to_string(path)
        .map_err(|source| CliError::Read { path: path.into(), source })?;
    let model = ModelFile::load(path)?;
    let algebra = catalogue::lookup(&model.group).map_err(|error| {
        let (name, reason) = (model.group.clone(), error.to_string());
        LearnError::UnknownGroup { name, reason }
    })?;
    let (expected, found) = (algebra.dim(), options.start.len());
    if found != expected {
        return Err(LearnError::Shape { what: "the start".into(), expected, found }.into());
    }
    if let Some(bad) = options.start.iter().find(|value| !value.is_finite()) {
        return Err(CliError::Option(format!("--start: {bad} is no finite number")));
    }
    let schedule = schedule(time, model.step)?;
    let setup = Setup {
        file: path.into(),
        hash: text_hash(&text),
        schedule,
        every: Some(every(options.every.unwrap_or(1))?),
        at: None,
        out,
        sampled: false,
        checkpoint: checkpoint(options)?,
        tuned: false,
        backend: crate::backend::Backend::Interpreter,
        fitted: None,
        momentum: DVector::from_column_slice(&options.start),
        group_element: None,
    };
    let coordinates: Vec<String> = (0..expected).map(|i| format!("mu[{i}]")).collect();
    let watched = Watched {
        algebra: &algebra,
        coordinates: &coordinates,
        energy: None,
        attitude: model.attitude,
        symmetries: None,
    };
    let warnings = if model.attitude { Vec::new() } else { vec![Warning::NoAttitude] };
    warnings.iter().for_each(|warning: &Warning| eprintln!("warning: {}", warning.text()));
    let subject = Subject {
        setup: &setup,
        label: format!("learned {}, {}", model.model.name(), model.chart),
        header: Header::of_model(&setup, &model),
        truncation: None,
        watched,
        warnings,
    };
    let group = product_group(path, &algebra)?;
    let trajectory = match model.chart.as_str() {
        "cayley" => follow::<_, Cayley>(cayley_group(path, &group)?, &subject, &model)?,
        _ => follow::<_, Exponential>(group, &subject, &model)?,
    };
    super::print(&[trajectory], &Units::default(), options, setup.out.as_ref());
    Ok(())
}

/// Whole steps of the model's own size that end at the time.
fn schedule(time: f64, step: f64) -> Result<Schedule, CliError> {
    let steps = (time / step).round();
    if !(steps.is_finite() && (1.0..MOST_STEPS).contains(&steps)) {
        return Err(CliError::Option(format!(
            "the time {time} is no number of steps of {step}, the step the model was learned for"
        )));
    }
    let end = steps * step;
    if (end - time).abs() > WHOLE * time {
        return Err(CliError::Option(format!(
            "the time {time} is no whole number of steps of {step}, the step the model was learned \
             for: give --time {end}"
        )));
    }
    Ok(Schedule { asked: step, step, steps: steps as u64, end })
}

fn follow<G: Restore, C: Chart<G>>(
    group: G,
    subject: &Subject<'_>,
    model: &ModelFile,
) -> Result<Trajectory, CliError> {
    let map = Generating::<G, C, _>::new(group.clone(), &model.model);
    March { subject, group: &group }.run(&Stepper {
        steps: &each(&subject.setup.schedule, |_, phase| {
            let report = advance(&map, phase)?;
            Ok(Made { solve: Some((report.iterations, report.residual)) })
        }),
        // Times between steps are refused: a learned map has one step.
        side: &|_, part, _| Err(StepError::InvalidStep { step: part }),
        ratio: &|_| 0.0,
        kept: None,
    })
}
