//! `coadjoint simulate`: a run, what it kept, and pictures of it.

mod plot;
mod report;
mod rival;
mod setup;
mod task;
mod trajectory;
mod write;

use coadjoint::{Cayley, Exponential};
use coadjoint_codegen::lie;
use coadjoint_codegen::system::{Parameters, System};

use crate::arguments::{Format, SimulateOptions};
use crate::engine::{Energy, Forces, cayley_group, matrix_group, product_group};
use crate::error::CliError;
use crate::{load, model};
use setup::Setup;
pub use setup::schedule;
use task::Task;

/// Follows a learned map, which has its own step.
fn learned(path: &std::path::Path, options: &SimulateOptions) -> Result<(), CliError> {
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
    model::simulate(&model::Run {
        model: path.into(),
        start: options.start.clone(),
        time: options.time.ok_or_else(|| missing("time"))?,
        every: options.every.unwrap_or(1),
        out: options.out.clone(),
    })
}

/// Runs every truncation asked for.
pub fn run(options: &SimulateOptions) -> Result<(), CliError> {
    if let Some(path) = &options.input.model {
        return learned(path, options);
    }
    let source = options.input.source();
    let path = &source.file;
    let read = |truncation| load::source(&source, truncation, Parameters::Substituted);
    let systems: Vec<System> = if options.truncation.is_empty() {
        vec![read(None)?]
    } else {
        options.truncation.iter().map(|&k| read(Some(k))).collect::<Result<_, _>>()?
    };
    let mut runs = Vec::new();
    let mut heading = systems.first().map(plot::Heading::new);
    let first = systems.first().filter(|_| options.format == Format::Text);
    let units = first.and_then(|system| system.units.sentence(&system.problem.coordinates));
    for mut system in systems {
        let truncation = system.problem.truncation;
        let fixed = (!options.truncation.is_empty()).then_some(truncation);
        load::meet_tolerance(path, &mut system, &options.accuracy, fixed, options.time)?;
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
        let setup = Setup::new(options, &run, problem.algebra.dim())?;
        heading.iter_mut().for_each(|heading| heading.step(setup.step));
        let kept = potential.as_ref().map(|(potential, _)| potential);
        // Kicks look at the matrices of the whole group; a flow alone goes factor by factor.
        let kicked = kept.map(|potential| matrix_group(path, &problem.algebra, Some(potential)));
        let kicked = kicked.transpose()?;
        let energy = Energy::new(&problem, kept);
        let forces = potential.map(|(potential, splitting)| Forces::new(potential, splitting));
        let integrator = load::integrator(path, problem)?;
        let task = Task {
            integrator: &integrator,
            forces: forces.as_ref(),
            energy: &energy,
            setup: &setup,
        };
        let algebra = &integrator.problem.algebra;
        let trajectory = match (&kicked, integrator.problem.chart) {
            (Some(group), lie::Chart::Exponential) => {
                task.integrate::<_, Exponential>(group.clone())?
            }
            (Some(group), lie::Chart::Cayley) => {
                let group = group
                    .clone()
                    .into_cayley()
                    .map_err(|source| CliError::Group { file: path.clone(), source })?;
                task.integrate::<_, Cayley>(group)?
            }
            (None, lie::Chart::Exponential) => {
                task.integrate::<_, Exponential>(product_group(path, algebra)?)?
            }
            (None, lie::Chart::Cayley) => {
                let group = product_group(path, algebra)?;
                task.integrate::<_, Cayley>(cayley_group(path, &group)?)?
            }
        };
        if let Some(out) = &options.out {
            let out = write::numbered(out, &trajectory, options.truncation.len() > 1);
            write::trajectory(&out, &trajectory)?;
        }
        runs.push(trajectory);
        // The rival knows no truncation: once is enough.
        if options.compare.is_some() && runs.len() == 1 {
            let group = match kicked {
                Some(group) => group,
                None => matrix_group(path, algebra, None)?,
            };
            runs.insert(0, rival::rk45(&group, &task, options.compare_tolerance)?);
        }
    }
    // The rival, if any, comes last.
    if options.compare.is_some() {
        runs.rotate_left(1);
    }
    if let (Some(path), Some(heading)) = (&options.plot, &heading) {
        plot::draw(path, &plot::picture(heading, &runs))?;
    }
    out!("{}", report::report(&runs, options.format));
    if let Some(units) = units {
        outln!("  units: {units}");
    }
    Ok(())
}
