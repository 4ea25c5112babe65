//! Systems and learned models as code.

use std::path::Path;

use coadjoint_codegen::emit::c::{self, HeaderOptions, Language};
use coadjoint_codegen::emit::{Options, file, items, items_of, potential_items};
use coadjoint_codegen::integrator::Kick;
use coadjoint_codegen::tolerance::Choice;
use coadjoint_learn::{ModelFile, problem};
use coadjoint_program::Precision;
use coadjoint_program::print::DeviceLanguage;

use crate::engine::device_text;
use crate::error::RunError;
use crate::load::{Derived, System, derive, integrator, learned};

/// The source of emitted code.
#[derive(Debug)]
pub enum Emittable {
    /// A system, and what was chosen for its tolerance.
    System(Box<System>, Option<Choice>),
    /// A learned polynomial.
    Model(Box<ModelFile>),
}

/// The Rust module. That of a learned polynomial, built with the model's step, is the model.
///
/// # Errors
/// Fails if the series is too large, or the model is no polynomial.
pub fn rust(path: &Path, source: Emittable) -> Result<String, RunError> {
    let (system, choice) = match source {
        Emittable::System(system, choice) => (*system, choice),
        Emittable::Model(model) => {
            let problem = problem(&model, "learned")?;
            let style = Options::for_problem(&problem.name);
            return Ok(format!(
                "//! Learned for the step {step}: build it with `new({step})`; other steps mean nothing.\n{}",
                file(items(&integrator(path, problem)?, &style)),
                step = model.step
            ));
        }
    };
    system.writable().map_err(RunError::of(path))?;
    let style = Options::for_problem(system.problem.facts().name);
    let origin = derive(path, system.problem.settled().0)?;
    if origin.is_function() {
        return Err(of_function(path));
    }
    let mut module = file(items_of(&origin, &style).map_err(RunError::of(path))?);
    if let Some(line) = choice.as_ref().map(chosen) {
        module.insert_str(0, &format!("//! {line}\n"));
    }
    if let Some((potential, _)) = system.potential {
        module.push_str(&potential_items(&Kick::build(potential), &style));
    }
    Ok(module)
}

/// The header of C or C++; all names in it begin with `prefix`, or with the system's name.
///
/// # Errors
/// Fails if the series is too large, or the system is not written as C.
pub fn header(
    path: &Path,
    source: Emittable,
    language: Language,
    prefix: Option<String>,
) -> Result<String, RunError> {
    let style = HeaderOptions { language, ..HeaderOptions::default() };
    let (system, style, choice) = match source {
        Emittable::Model(model) => {
            (learned(&model)?, HeaderOptions { only_step: Some(model.step), ..style }, None)
        }
        Emittable::System(system, choice) => {
            let units = &system.units;
            let of = |i| units.coordinate(i).map(str::to_owned);
            let momentum = (0..system.problem.facts().algebra.dim()).map(of).collect();
            let time = units.time.clone();
            (*system, HeaderOptions { time, momentum, ..style }, choice)
        }
    };
    let derived = written(path, system)?;
    let prefix = prefix.unwrap_or_else(|| derived.facts().name.to_owned());
    let origin = derived.origin().ok_or_else(|| of_function(path))?;
    let text = c::header(origin, &HeaderOptions { prefix, ..style }).map_err(RunError::of(path))?;
    let line = choice.as_ref().map(|choice| format!("/* {} */\n", chosen(choice)));
    Ok(line.unwrap_or_default() + &text)
}

/// The steps of a system of which code can be written.
fn written(path: &Path, system: System) -> Result<Derived, RunError> {
    system.writable().map_err(RunError::of(path))?;
    Derived::of_file(path, system)
}

/// The error of a Hamiltonian of which no code can be written.
fn of_function(path: &Path) -> RunError {
    let what = "no code is written of a Hamiltonian, a velocity or a torque that is a function: give it as an expression";
    RunError::Option(format!("{}: {what}", path.display()))
}

/// The choice, for a comment.
fn chosen(choice: &Choice) -> String {
    let Choice { tolerance, truncation, step, error, .. } = choice;
    format!(
        "Chosen for the tolerance {tolerance:e}: K = {truncation}, step h = {step} (error {error:.1e} at the end of the run)."
    )
}

/// The steps as a kernel for devices, which is for one step size alone; `step` replaces that of the system, and a model
/// has its own.
///
/// # Errors
/// Fails if the step is missing, or the system is not written as a kernel.
pub fn kernel(
    path: &Path,
    source: Emittable,
    step: Option<f64>,
    precision: Precision,
    language: DeviceLanguage,
) -> Result<String, RunError> {
    let (system, step, choice) = match source {
        Emittable::Model(model) => {
            if step.is_some() {
                return Err(RunError::Option("--step: a learned model has its own".into()));
            }
            (learned(&model)?, model.step, None)
        }
        Emittable::System(system, choice) => {
            let step = step.or(system.run.step).ok_or_else(|| RunError::no_step(path))?;
            (*system, step, choice)
        }
    };
    let derived = written(path, system)?;
    let origin = derived.origin().ok_or_else(|| of_function(path))?;
    let facts = derived.facts();
    let method = match derived.series() {
        Some(series) => format!("{} chart, K = {}", series.problem.chart, facts.truncation),
        None => derived.label(),
    };
    let chosen = choice.as_ref().map(|choice| format!("\n{}", chosen(choice)));
    let about = format!(
        "{} on {}, {method}, step {step}.{}\nWritten by coadjoint {}.",
        facts.name,
        facts.algebra.name(),
        chosen.unwrap_or_default(),
        env!("CARGO_PKG_VERSION"),
    );
    device_text(origin, step, precision, language, &about)
}
