//! The runs of systems: flows, or flows and kicks, from the initial state to the end.

use coadjoint_program::Trajectories;

use super::estimate::{ENDED, estimate};
use super::march::Subject;
use super::recorder::{Outcome, Watched};
use super::setup::Setup;
use super::sink::Sink;
use crate::engine::Compiled;
use crate::error::RunError;
use crate::load::Derived;

/// Runs a system from the start to the end.
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run(system: &Derived, setup: &Setup, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
    let integrator = &system.integrator;
    if setup.momentum.len() != integrator.problem.algebra.dim() {
        return Err(RunError::Option("the momentum does not fit the group".to_owned()));
    }
    let (group, schedule) = (system.charted()?, &setup.schedule);
    let (backend, expected) = (setup.backend, schedule.steps as f64);
    let (step, kept) = (schedule.step, &system.kept);
    let compiled = Compiled::new(integrator, step, backend, expected, Trajectories::One, kept)?;
    let motion = group.steps(system.equations(), step, compiled.clone());
    let start = setup.start(&system.file, motion.space())?;
    let subject = Subject { setup, watched: system.watched(), warnings: Vec::new() };
    let made = subject.run(motion.as_ref(), &start, sink);
    let code = compiled.as_ref().map(|compiled| compiled.code());
    code.iter().flat_map(|code| code.notes()).for_each(|note| sink.warn(&note));
    let (mut outcome, end) = made?;
    let other = |size| group.anew(system.equations(), step * size, compiled.as_ref());
    let order = system.order();
    let found = match outcome.time == schedule.end {
        true => estimate(motion.as_ref(), other, [&start, &end], schedule.steps, order),
        false => Err(ENDED),
    };
    outcome.estimated(found, sink);
    outcome.backend = code.map(|code| code.used());
    Ok(outcome)
}

impl Derived {
    /// The quantities watched in a run.
    pub fn watched(&self) -> Watched<'_> {
        let problem = &self.integrator.problem;
        let (algebra, coordinates) = (&problem.algebra, problem.coordinates.as_slice());
        Watched { algebra, coordinates, invariants: &self.invariants, attitude: true }
    }
}
