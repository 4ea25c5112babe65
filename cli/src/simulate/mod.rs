//! `coadjoint simulate`: a run, what it kept, and pictures of it.

mod plot;
mod report;
mod rival;
mod setup;
mod trajectory;
mod write;

use coadjoint::{Cayley, Chart, Exponential, GeneratingFunction, Phase, StepError, advance, solve};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_codegen::system::{Parameters, System};

use crate::arguments::SimulateOptions;
use crate::engine::{Group, Interpreter, matrix_group};
use crate::error::CliError;
use crate::{load, model, progress};
use nalgebra::DVector;
use setup::Setup;
use trajectory::{Recorder, Trajectory};

/// Follows a learned map, which has its own step.
fn learned(path: &std::path::Path, options: &SimulateOptions) -> Result<(), CliError> {
    let missing = |option: &str| {
        CliError::Option(format!("a learned model says nothing about {option}: give --{option}"))
    };
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
    for System { problem, run } in systems {
        let setup = Setup::new(options, &run, problem.algebra.dim())?;
        let group = matrix_group(path, &problem.algebra)?;
        let integrator = load::integrator(path, problem)?;
        let trajectory = match integrator.problem.chart {
            lie::Chart::Exponential => integrate::<_, Exponential>(group, &integrator, &setup)?,
            lie::Chart::Cayley => {
                let group = group
                    .into_cayley()
                    .map_err(|source| CliError::Group { file: path.clone(), source })?;
                integrate::<_, Cayley>(group, &integrator, &setup)?
            }
        };
        if let Some(out) = &options.out {
            let out = write::numbered(out, &trajectory, options.truncation.len() > 1);
            write::trajectory(&out, &trajectory)?;
        }
        runs.push(trajectory);
        // The rival knows no truncation: once is enough.
        if options.compare.is_some() && runs.len() == 1 {
            let group = matrix_group(path, &integrator.problem.algebra)?;
            let step = Interpreter::<_, Exponential>::new(&integrator, group, setup.step)
                .map_err(|source| CliError::Step { time: 0.0, source })?;
            let rival = rival::rk45(&step, &integrator, &setup, options.compare_tolerance)?;
            runs.insert(0, rival);
        }
    }
    // The rival, if any, comes last.
    if options.compare.is_some() {
        runs.rotate_left(1);
    }
    if let Some(plot) = &options.plot {
        plot::draw(plot, &runs)?;
    }
    print!("{}", report::report(&runs, options.format));
    Ok(())
}

/// Advances from the initial state to the end.
fn integrate<G: Group, C: Chart<G>>(
    group: G,
    integrator: &Integrator,
    setup: &Setup,
) -> Result<Trajectory, CliError> {
    let at = |time: f64| move |source| CliError::Step { time, source };
    let step = Interpreter::<G, C>::new(integrator, group.clone(), setup.step).map_err(at(0.0))?;
    let mut phase = Phase::<G>::new(setup.element(&group)?, setup.momentum.clone());
    let energy = |mu: &_| step.energy(mu);
    let label = format!("K = {}, {}", integrator.problem.truncation, integrator.problem.chart);
    let mut recorder = Recorder::new(&group, &energy, &phase, integrator, label);
    let bar = progress::bar(setup.steps, "integrating");
    for n in 1..=setup.steps {
        let now = at((n - 1) as f64 * setup.step);
        let residual = residual(&step, &phase.momentum).map_err(now)?;
        let report = advance(&step, &mut phase).map_err(now)?;
        recorder.solved(report.iterations, residual);
        recorder.visit(n as f64 * setup.step, &phase, n % setup.every == 0 || n == setup.steps);
        if n % 256 == 0 {
            bar.set_position(n);
        }
    }
    bar.finish_and_clear();
    Ok(recorder.finish(setup.steps, &phase))
}

/// What the solve leaves of J_L(x, p) = μ, relative to the largest coordinate of μ: measured, where
/// the step itself reports an estimate.
fn residual<G: Group, C: Chart<G>>(
    step: &Interpreter<'_, G, C>,
    mu: &DVector<f64>,
) -> Result<f64, StepError> {
    let solution = solve(step, mu)?;
    let reached = C::default().left_momentum(step.group(), &solution.x, &solution.p);
    let size = mu.amax();
    Ok(if size > 0.0 { (reached - mu).amax() / size } else { 0.0 })
}
