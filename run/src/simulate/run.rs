//! The runs of systems, flows or flows and kicks, and of learned maps: from the initial state to the end.

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

use coadjoint_codegen::lie;
use coadjoint_codegen::smooth::Facts;
use coadjoint_codegen::step::Invariants;
use coadjoint_learn::{LearnError, ModelFile};
use coadjoint_program::Trajectories;

use super::blocks::blocks;
use super::estimate::{Made, Maker};
use super::march::Subject;
use super::milestone::part;
use super::recorder::{Outcome, Watched};
use super::setup::{Setup, start};
use super::sink::Sink;
use super::slow::slow;
use super::tally::Warning;
use super::unknown::Unknown;
use crate::engine::{Charted, Compiled, Motion, Numbers, Space, group_of};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::Derived;

/// Runs a system from the start to the end.
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run(system: &Derived, setup: &Setup, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
    let (schedule, grid) = (&setup.schedule, setup.schedule.grid());
    let (compiled, motion, start) = system.begin(setup)?;
    motion.defined(&start, grid.start).map_err(RunError::at(grid.start))?;
    let gave_way = system.gave_way().map(|text| Warning::Method { text });
    let kinks = system.drive().map(|drive| drive.kinks.join(", "));
    let kinks = kinks.filter(|kinks| !kinks.is_empty());
    let kinks = kinks.map(|expressions| Warning::Kink { expressions });
    let warnings = gave_way.into_iter().chain(kinks).collect();
    let subject = Subject { setup, watched: system.watched(motion.space(), grid.step), warnings };
    let made = subject.run(&motion, &start, sink);
    let code = compiled.as_ref().map(|compiled| compiled.code());
    code.iter().flat_map(|code| code.notes()).for_each(|note| sink.warn(&note));
    let (mut outcome, end, mut kept) = made?;
    let ends = [(grid.start, &start), (outcome.time, &end)];
    outcome.work = compiled.as_ref().and_then(|compiled| compiled.work(ends));
    let maker = Maker { system, parameters: &system.values, compiled: compiled.as_ref() };
    let known = setup.known_error().filter(|_| outcome.time == schedule.end);
    let found = if !setup.estimate {
        Err(Unknown::OFF)
    } else if let Some(known) = known {
        Ok(known)
    } else {
        let sink = RefCell::new(&mut *sink);
        // An event ends a run between two steps.
        let steps = match outcome.time == schedule.end {
            true => schedule.steps as f64,
            false => (outcome.time - grid.start) / grid.step,
        };
        kept.retain(|(place, _)| (*place as f64) < steps);
        let made = Made {
            maker,
            motion: &motion,
            ends: [&start, &end],
            kept: &kept,
            part: part(schedule.steps),
            steps,
            stop: &|| sink.borrow_mut().stop(),
        };
        made.error()
    };
    let shorter = |step| maker.steps(Grid { step, ..grid });
    if let Some(warning) = slow(&outcome, grid.step, &start, shorter) {
        sink.warn(&warning.text());
        outcome.warnings.push(warning);
    }
    let tolerance = setup.choice.as_ref().map(|choice| choice.tolerance);
    outcome.estimated(found, tolerance, sink);
    outcome.backend = code.map(|code| code.used());
    Ok(outcome)
}

impl Derived {
    /// The programs of a run with these settings, where there are any, its steps, and its start.
    ///
    /// # Errors
    /// Settings that make no sense.
    pub(crate) fn begin(
        &self,
        setup: &Setup,
    ) -> Result<(Option<Arc<Compiled>>, Motion<'_>, Numbers), RunError> {
        if setup.momentum.len() != self.facts().algebra.dim() {
            return Err(RunError::Option("the momentum does not fit the group".to_owned()));
        }
        let (schedule, grid) = (&setup.schedule, setup.schedule.grid());
        self.reaches(schedule)?;
        self.resolves(grid, schedule.steps, Some(&setup.momentum))?;
        let steps = schedule.steps as f64;
        let compiled = self.compiled(grid.step, setup.backend, steps, Trajectories::One)?;
        let motion = self.steps(grid, compiled.as_ref()).map_err(RunError::unmade)?;
        let start =
            start(&self.file, motion.space(), setup.group_element.as_deref(), &setup.momentum)?;
        Ok((compiled, motion, start))
    }

    /// The quantities watched in a run in steps of this size.
    pub(crate) fn watched(&self, space: &Space, step: f64) -> Watched<'_> {
        let Facts { algebra, coordinates, .. } = self.facts();
        let drive = self.drive().filter(|drive| drive.velocity);
        let damped = drive.map(|drive| match (drive.is_dissipative(), step < 0.0) {
            (true, true) => "rises: damping acts, and the run goes back in time",
            (true, false) => "falls: damping acts",
            (false, _) => "not conserved: a velocity acts beside the Hamiltonian",
        });
        let blocks = self.blocks.get_or_init(|| blocks(algebra, space.size()));
        Watched { algebra, coordinates, invariants: &self.invariants, blocks, damped }
    }
}

/// Follows a learned map, which is called `file` in messages and has its own step: the setup's schedule is that of
/// [`Schedule::of_model`](super::Schedule::of_model).
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run_model(
    file: &Path,
    model: &ModelFile,
    setup: &Setup,
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    let algebra = model.group.algebra()?;
    let (expected, found) = (algebra.dim(), setup.momentum.len());
    if found != expected {
        return Err(LearnError::Shape { what: "the start".into(), expected, found }.into());
    }
    let coordinates: Vec<String> = (0..expected).map(|i| format!("mu[{i}]")).collect();
    let invariants = Invariants::of(&algebra);
    let chart = if model.chart == "cayley" { lie::Chart::Cayley } else { lie::Chart::Exponential };
    let group = Charted::new(file, group_of(file, &algebra, false)?, chart)?;
    let grid = setup.schedule.grid();
    let motion = group.learned(model, grid).map_err(RunError::unmade)?;
    let start = start(file, motion.space(), setup.group_element.as_deref(), &setup.momentum)?;
    let (blocks, warnings) = match model.attitude {
        true => (blocks(&algebra, motion.space().size()), Vec::new()),
        false => (Vec::new(), vec![Warning::NoAttitude]),
    };
    let (algebra, coordinates, invariants, blocks) = (&algebra, &coordinates, &invariants, &blocks);
    let watched = Watched { algebra, coordinates, invariants, blocks, damped: None };
    let (mut outcome, ..) = Subject { setup, watched, warnings }.run(&motion, &start, sink)?;
    outcome.estimated_error = Err(Unknown::LEARNED);
    Ok(outcome)
}
