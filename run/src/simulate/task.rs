//! The runs of systems: flows, or flows and kicks, from the initial state to the end.

use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint::steps::advance;
use coadjoint::{Phase, StepError};
use coadjoint_codegen::lie;
use coadjoint_program::Trajectories;
use nalgebra::DVector;

use super::march::Subject;
use super::motion::{ByPrograms, OneByOne, Solves, Steps};
use super::recorder::{Outcome, Watched};
use super::setup::Setup;
use super::sink::Sink;
use crate::engine::{
    Compiled, Forces, Interpreter, Restore, Steepness, advise, cayley_group, product_group,
    whole_group,
};
use crate::error::RunError;
use crate::load::Derived;

/// Runs a system from the start to the end.
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run(system: &Derived, setup: &Setup, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
    let problem = &system.integrator.problem;
    if setup.momentum.len() != problem.algebra.dim() {
        return Err(RunError::Option("the momentum does not fit the group".to_owned()));
    }
    let group = system.group()?;
    match problem.chart {
        lie::Chart::Exponential => integrate::<_, Exponential>(system, setup, &group, sink),
        lie::Chart::Cayley => {
            let group = cayley_group(&system.file, &group)?;
            integrate::<_, Cayley>(system, setup, &group, sink)
        }
    }
}

impl Derived {
    /// The group that the equations are on. Kicks look at the matrices of the whole group; a flow alone goes factor by
    /// factor.
    ///
    /// # Errors
    /// Where the data defines no group.
    pub fn group(&self) -> Result<DirectProduct<MatrixGroup>, RunError> {
        let algebra = &self.integrator.problem.algebra;
        match &self.forces {
            Some(_) => whole_group(&self.file, algebra),
            None => product_group(&self.file, algebra),
        }
    }

    /// The quantities watched in a run.
    pub fn watched(&self) -> Watched<'_> {
        let problem = &self.integrator.problem;
        let (algebra, coordinates) = (&problem.algebra, problem.coordinates.as_slice());
        Watched { algebra, coordinates, invariants: &self.invariants, attitude: true }
    }

    /// The method of a run, in a few words.
    pub fn label(&self) -> String {
        let problem = &self.integrator.problem;
        let mut label = format!("K = {}, {}", problem.truncation, problem.chart);
        if problem.comoving.is_some() {
            label.push_str(", comoving");
        }
        if let Some(forces) = &self.forces {
            label = format!("{label}, {}", forces.splitting.name());
        }
        label
    }
}

/// Advances from the initial state to the end.
fn integrate<G: Restore, C: Chart<G>>(
    system: &Derived,
    setup: &Setup,
    group: &G,
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    let subject =
        Subject { file: &system.file, setup, watched: system.watched(), warnings: Vec::new() };
    match &system.forces {
        Some(forces) => kicked::<G, C>(system, &subject, group, forces, sink),
        None => flow::<G, C>(system, &subject, group, sink),
    }
}

/// Flows and kicks.
fn kicked<G: Restore, C: Chart<G>>(
    system: &Derived,
    subject: &Subject<'_>,
    group: &G,
    forces: &Forces,
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    let (integrator, schedule) = (&system.integrator, &subject.setup.schedule);
    let h = schedule.step;
    let make = |h| forces.step::<G, C>(integrator, group, h);
    let made = make(h).map_err(at_start)?;
    let longest = h * forces.longest_flow();
    let flow = Interpreter::<G, C>::new(integrator, group.clone(), longest);
    let flow = flow.map_err(at_start)?;
    let steepness = Steepness::new(&flow);
    let step = |time, phase: &mut Phase<G>| {
        let made = made(phase, time);
        made.map(|()| None).map_err(|error| {
            let works = |h| make(h).is_ok_and(|s| s(&mut phase.clone(), time).is_ok());
            advise(error, h, works)
        })
    };
    let side = |time, part, phase: &mut Phase<G>| make(part)?(phase, time);
    let ratio = |mu: &DVector<f64>| steepness.ratio(mu);
    let steps = Steps { group, schedule, step: &step, side: &side, ratio: &ratio };
    let start = subject.setup.start(subject.file, group)?;
    subject.run(&mut OneByOne::new(steps, start), sink)
}

/// The flow alone.
fn flow<G: Restore, C: Chart<G>>(
    system: &Derived,
    subject: &Subject<'_>,
    group: &G,
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    let (integrator, setup) = (&system.integrator, subject.setup);
    let schedule = &setup.schedule;
    let h = schedule.step;
    let series = |h| Interpreter::<G, C>::new(integrator, group.clone(), h);
    let interpreter = series(h).map_err(at_start)?;
    let steepness = Steepness::new(&interpreter);
    let advised = |error, phase: &Phase<G>| {
        advise(error, h, |h| series(h).is_ok_and(|step| advance(&step, &mut phase.clone()).is_ok()))
    };
    let step = |_, phase: &mut Phase<G>| -> Result<Solves, StepError> {
        let report = advance(&interpreter, phase).map_err(|error| advised(error, phase))?;
        Ok(Some((report.iterations, report.residual)))
    };
    let side = |_, part, phase: &mut Phase<G>| advance(&series(part)?, phase).map(drop);
    let ratio = |mu: &DVector<f64>| steepness.ratio(mu);
    let steps = Steps { group, schedule, step: &step, side: &side, ratio: &ratio };
    let start = setup.start(subject.file, group)?;
    let expected = schedule.steps as f64;
    let kept = &system.kept;
    let Some(compiled) =
        Compiled::new(&interpreter, setup.backend, expected, Trajectories::One, kept)?
    else {
        return subject.run(&mut OneByOne::new(steps, start), sink);
    };
    let mut motion = ByPrograms::new(&compiled, &interpreter, steps, &advised, start);
    let outcome = subject.run(&mut motion, sink);
    compiled.code().notes().iter().for_each(|note| sink.warn(note));
    Ok(Outcome { backend: Some(compiled.code().used()), ..outcome? })
}

fn at_start(source: StepError) -> RunError {
    RunError::Step { time: 0.0, source }
}
