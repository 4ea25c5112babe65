//! The runs of systems: flows, or flows and kicks, from the initial state to the end.

use coadjoint_codegen::smooth::Facts;
use coadjoint_program::Trajectories;

use super::estimate::{ENDED, estimate};
use super::march::Subject;
use super::recorder::{Outcome, Watched};
use super::setup::Setup;
use super::sink::Sink;
use crate::error::RunError;
use crate::load::Derived;

/// Runs a system from the start to the end.
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run(system: &Derived, setup: &Setup, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
    let facts = system.facts();
    if setup.momentum.len() != facts.algebra.dim() {
        return Err(RunError::Option("the momentum does not fit the group".to_owned()));
    }
    let schedule = &setup.schedule;
    system.reaches(schedule.end)?;
    let (step, expected) = (schedule.step, schedule.steps as f64);
    let compiled = system.compiled(step, setup.backend, expected, Trajectories::One)?;
    let motion = system.steps(step, compiled.as_ref());
    let motion = motion.map_err(RunError::at_start)?;
    let start = setup.start(&system.file, motion.space())?;
    motion.defined(&start).map_err(RunError::at_start)?;
    let subject = Subject { setup, watched: system.watched(), warnings: Vec::new() };
    let made = subject.run(motion.as_ref(), &start, sink);
    let code = compiled.as_ref().map(|compiled| compiled.code());
    code.iter().flat_map(|code| code.notes()).for_each(|note| sink.warn(&note));
    let (mut outcome, end) = made?;
    let parameters = facts.defaults();
    let other = |size| system.varied(step * size, &parameters, compiled.as_ref());
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
        let Facts { algebra, coordinates, .. } = self.facts();
        Watched { algebra, coordinates, invariants: &self.invariants, attitude: true }
    }
}
