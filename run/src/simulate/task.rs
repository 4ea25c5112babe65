//! The runs of systems: flows, or flows and kicks, from the initial state to the end.

use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::lie;
use coadjoint_program::Trajectories;
use nalgebra::DVector;

use super::march::Subject;
use super::motion::{ByPrograms, OneByOne, Steps};
use super::recorder::{Outcome, Watched};
use super::setup::Setup;
use super::sink::Sink;
use crate::engine::{
    Compiled, Forces, Interpreter, Restore, Steepness, advise, cayley_group, map, product_group,
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
    let (integrator, forces) = (&system.integrator, system.forces.as_ref());
    let (schedule, kept) = (&setup.schedule, &system.kept);
    let h = schedule.step;
    let make = |h| map::<G, C>(integrator, forces, group, h);
    let made = make(h).map_err(at_start)?;
    let longest = h * forces.map_or(1.0, Forces::longest_flow);
    let flow = Interpreter::<G, C>::new(integrator, group.clone(), longest).map_err(at_start)?;
    let steepness = Steepness::new(&flow);
    let step = |_, phase: &mut Phase<G>| {
        made(phase).map_err(|error| {
            advise(error, h, |h| make(h).is_ok_and(|step| step(&mut phase.clone()).is_ok()))
        })
    };
    let side = |_, part, phase: &mut Phase<G>| make(part)?(phase).map(drop);
    let ratio = |mu: &DVector<f64>| steepness.ratio(mu);
    let steps = Steps { group, schedule, step: &step, side: &side, ratio: &ratio };
    let start = setup.start(subject.file, group)?;
    let (backend, expected) = (setup.backend, schedule.steps as f64);
    let compiled = Compiled::new(integrator, h, backend, expected, Trajectories::One, kept)?;
    let Some(compiled) = compiled else {
        return subject.run(&mut OneByOne::new(steps, start), sink);
    };
    let outcome = subject.run(&mut ByPrograms::new(&compiled, steps, start), sink);
    compiled.code().notes().iter().for_each(|note| sink.warn(note));
    Ok(Outcome { backend: Some(compiled.code().used()), ..outcome? })
}

fn at_start(source: StepError) -> RunError {
    RunError::Step { time: 0.0, source }
}
