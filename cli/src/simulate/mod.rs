//! `coadjoint simulate`: a run, what it kept, and pictures of it.

mod checkpoint;
mod element;
mod header;
mod interrupt;
mod learned;
mod march;
mod names;
mod number;
mod plot;
mod report;
mod rival;
mod samples;
mod schedule;
mod setup;
mod sink;
mod subject;
mod target;
mod task;
mod times;
mod trajectory;
mod warning;

use std::path::Path;

use coadjoint::{Cayley, Exponential};
use coadjoint_codegen::lie;
use coadjoint_codegen::system::{self, Parameters, System, Units};
use coadjoint_draw::run::Picture;

use crate::arguments::SimulateOptions;
use crate::engine::{Energy, Forces, cayley_group, product_group, whole_group};
use crate::error::CliError;
use crate::{load, progress};
pub use header::text_hash;
pub use schedule::schedule;
use setup::Setup;
use target::{Place, Target};
use task::Task;
use trajectory::Trajectory;

/// Runs every truncation asked for.
pub fn run(options: &SimulateOptions) -> Result<(), CliError> {
    if let Some(path) = &options.input.model {
        return learned::run(path, options);
    }
    let out = setup::check_names(options)?;
    let Runs { runs, heading, units } = runs(options, out.as_ref())?;
    if let Some(path) = &options.plot {
        plot::draw(path, &plot::picture(&heading, &runs))?;
    }
    print(&runs, &units, options, out.as_ref());
    Ok(())
}

/// What is drawn of a system that is run as its file says.
pub fn pictured(file: &Path) -> Result<Picture, CliError> {
    let options = SimulateOptions::drawn(file)?;
    let Runs { runs, heading, .. } = runs(&options, None)?;
    Ok(plot::picture(&heading, &runs))
}

/// The runs asked for.
struct Runs {
    runs: Vec<Trajectory>,
    heading: plot::Heading,
    units: Units,
}

/// Runs every truncation asked for, and the rival.
fn runs(options: &SimulateOptions, out: Option<&Target>) -> Result<Runs, CliError> {
    let source = options.input.source();
    let path = &source.file;
    // Read once: all runs are of this text, and its hash is that of what was run.
    let text = std::fs::read_to_string(path)
        .map_err(|source| CliError::Read { path: path.clone(), source })?;
    let hash = text_hash(&text);
    let read = |truncation| {
        let (chart, solver) = (source.chart.map(Into::into), source.solver.map(Into::into));
        let parameters = Parameters::Substituted;
        system::read(&text, system::Options { parameters, truncation, chart, solver }).map_err(
            |mistakes| CliError::Input(mistakes.render(&path.display().to_string(), &text)),
        )
    };
    let systems: Vec<System> = if options.truncation.is_empty() {
        vec![read(None)?]
    } else {
        options.truncation.iter().map(|&k| read(Some(k))).collect::<Result<_, _>>()?
    };
    let outs = outs(out, &systems)?;
    let mut runs = Vec::new();
    let mut heading = plot::Heading::new(&systems[0]);
    let units = systems[0].units.clone();
    for (mut system, out) in systems.into_iter().zip(outs) {
        let truncation = system.problem.truncation;
        let phase = progress::phase("choosing the step");
        let fixed = (!options.truncation.is_empty()).then_some(truncation);
        load::meet_tolerance(path, &mut system, &options.accuracy, fixed, options.time)?;
        drop(phase);
        let System { problem, potential, run, .. } = system;
        let follows = [("--tuned", options.tuned), ("--fitted", options.fitted.is_some())];
        if let Some((option, _)) = follows.iter().find(|(_, given)| *given)
            && potential.is_some()
        {
            let what = format!(
                "{option} follows the flow, which kicks of a potential leave: leave it out"
            );
            return Err(CliError::Option(what));
        }
        let setup = Setup::new(options, &hash, out, &run, problem.algebra.dim())?;
        heading.step(setup.schedule.step);
        let announcement = setup.schedule.announcement();
        if let Some(line) = announcement.filter(|_| runs.is_empty()) {
            eprintln!("{line}");
        }
        let phase = progress::phase(&format!("deriving the series, K = {}", problem.truncation));
        let kept = potential.as_ref().map(|(potential, _)| potential);
        let algebra = &problem.algebra;
        // Kicks look at the matrices of the whole group; a flow alone goes factor by factor.
        let group = match kept {
            Some(potential) => whole_group(path, algebra, Some(potential))?,
            None => product_group(path, algebra)?,
        };
        let energy = Energy::new(&problem, kept);
        let forces = potential.map(|(potential, splitting)| Forces::new(potential, splitting));
        let integrator = load::integrator(path, problem)?;
        drop(phase);
        let task = Task {
            integrator: &integrator,
            forces: forces.as_ref(),
            energy: &energy,
            setup: &setup,
        };
        let trajectory = match integrator.problem.chart {
            lie::Chart::Exponential => task.integrate::<_, Exponential>(&group)?,
            lie::Chart::Cayley => task.integrate::<_, Cayley>(&cayley_group(path, &group)?)?,
        };
        runs.push(trajectory);
        // The rival knows no truncation: once is enough.
        if options.compare.is_some() && runs.len() == 1 {
            runs.insert(0, rival::rk45(&group, &task, options.compare_tolerance)?);
        }
    }
    // The rival, if any, comes last.
    if options.compare.is_some() {
        runs.rotate_left(1);
    }
    Ok(Runs { runs, heading, units })
}

/// Prints the report.
fn print(runs: &[Trajectory], units: &Units, options: &SimulateOptions, out: Option<&Target>) {
    let report = report::report(runs, units, options.format);
    // Records on the standard output are not mixed with the report.
    if out.is_some_and(|out| out.place == Place::Standard) {
        eprint!("{report}");
    } else {
        out!("{report}");
    }
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
