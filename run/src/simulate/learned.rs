//! A learned map, run by the driver of every other run.

use std::path::Path;

use coadjoint::StepError;
use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::steps::advance;
use coadjoint_codegen::lie::{LieAlgebra, catalogue};
use coadjoint_codegen::step::Invariants;
use coadjoint_learn::{Generating, LearnError, ModelFile};

use super::march::Subject;
use super::motion::{OneByOne, Steps};
use super::recorder::{Outcome, Watched};
use super::schedule::Schedule;
use super::setup::Setup;
use super::sink::Sink;
use super::warning::Warning;
use crate::engine::Restore;
use crate::engine::{cayley_group, product_group};
use crate::error::RunError;

/// How far, relatively, a time may be from a whole number of steps.
const WHOLE: f64 = 1e-9;
/// The most steps of a run: beyond, the time is surely a slip.
const MOST_STEPS: f64 = 1e12;

/// The algebra of a model.
///
/// # Errors
/// Where its group is not in the catalogue.
pub fn algebra_of(model: &ModelFile) -> Result<LieAlgebra, RunError> {
    catalogue::lookup(&model.group).map_err(|error| {
        let (name, reason) = (model.group.clone(), error.to_string());
        LearnError::UnknownGroup { name, reason }.into()
    })
}

/// Follows a learned map, which is called `file` in messages and has its own step: the setup's schedule is that of
/// [`schedule_of`].
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run_model(
    file: &Path,
    model: &ModelFile,
    setup: &Setup,
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    let algebra = algebra_of(model)?;
    let (expected, found) = (algebra.dim(), setup.momentum.len());
    if found != expected {
        return Err(LearnError::Shape { what: "the start".into(), expected, found }.into());
    }
    let coordinates: Vec<String> = (0..expected).map(|i| format!("mu[{i}]")).collect();
    let (invariants, attitude) = (Invariants::of(&algebra), model.attitude);
    let watched =
        Watched { algebra: &algebra, coordinates: &coordinates, invariants: &invariants, attitude };
    let warnings = if attitude { Vec::new() } else { vec![Warning::NoAttitude] };
    let subject = Subject { file, setup, watched, warnings };
    let group = product_group(file, &algebra)?;
    match model.chart.as_str() {
        "cayley" => follow::<_, Cayley>(cayley_group(file, &group)?, &subject, model, sink),
        _ => follow::<_, Exponential>(group, &subject, model, sink),
    }
}

/// Whole steps of the model's own size that end at the time.
///
/// # Errors
/// Where none do.
pub fn schedule_of(time: f64, step: f64) -> Result<Schedule, RunError> {
    let steps = (time / step).round();
    if !(steps.is_finite() && (1.0..MOST_STEPS).contains(&steps)) {
        return Err(RunError::Option(format!(
            "the time {time} is no number of steps of {step}, the step the model was learned for"
        )));
    }
    let end = steps * step;
    if (end - time).abs() > WHOLE * time {
        return Err(RunError::Option(format!(
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
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    let map = Generating::<G, C, _>::new(group.clone(), &model.model);
    let step = |_, phase: &mut _| {
        let report = advance(&map, phase)?;
        Ok(Some((report.iterations, report.residual)))
    };
    let steps = Steps {
        group: &group,
        schedule: &subject.setup.schedule,
        step: &step,
        // Times between steps are refused: a learned map has one step.
        side: &|_, part, _| Err(StepError::InvalidStep { step: part }),
        ratio: &|_| 0.0,
    };
    let start = subject.setup.start(subject.file, &group)?;
    subject.run(&mut OneByOne::new(steps, start), sink)
}
