//! The runs of systems, flows or flows and kicks, and of learned maps: from the initial state to the end.

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

use coadjoint::StepError;
use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::steps::advance;
use coadjoint_codegen::lie;
use coadjoint_codegen::smooth::Facts;
use coadjoint_codegen::step::Invariants;
use coadjoint_learn::{Generating, LearnError, Model, ModelFile};
use coadjoint_program::Trajectories;

use super::estimate::{Made, Maker};
use super::march::Subject;
use super::milestone::part;
use super::recorder::{Outcome, Watched};
use super::setup::Setup;
use super::sink::Sink;
use super::slow::slow;
use super::tally::Warning;
use super::unknown::Unknown;
use crate::engine::{
    Charted, Elements, Motion, Numbers, Restore, Solved, Solves, Space, one_by_one, product_group,
};
use crate::error::RunError;
use crate::grid::Grid;
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
    system.reaches(schedule)?;
    system.resolves(schedule.grid(), schedule.steps, Some(&setup.momentum))?;
    let (grid, expected) = (schedule.grid(), schedule.steps as f64);
    let compiled = system.compiled(grid.step, setup.backend, expected, Trajectories::One)?;
    let motion = system.steps(grid, compiled.as_ref()).map_err(RunError::unmade)?;
    let start = setup.start(&system.file, motion.space())?;
    motion.defined(&start, grid.start).map_err(RunError::at(grid.start))?;
    let warnings = system.gave_way().map(Warning::Method).into_iter().collect();
    let subject = Subject { setup, watched: system.watched(grid.step), warnings };
    let made = subject.run(motion.as_ref(), &start, sink);
    let code = compiled.as_ref().map(|compiled| compiled.code());
    code.iter().flat_map(|code| code.notes()).for_each(|note| sink.warn(&note));
    let (mut outcome, end, mut kept) = made?;
    let parameters = facts.defaults();
    let maker = Maker { system, parameters: &parameters, compiled: compiled.as_ref() };
    let found = if setup.estimate {
        let sink = RefCell::new(&mut *sink);
        // An event ends a run between two steps.
        let steps = match outcome.time == schedule.end {
            true => schedule.steps as f64,
            false => (outcome.time - grid.start) / grid.step,
        };
        kept.retain(|(place, _)| (*place as f64) < steps);
        let made = Made {
            maker,
            motion: motion.as_ref(),
            ends: [&start, &end],
            kept: &kept,
            part: part(schedule.steps),
            steps,
            grid,
            stop: &|| sink.borrow_mut().stop(),
        };
        made.error()
    } else {
        Err(Unknown::OFF)
    };
    let shorter = |step| maker.steps(Grid { step, ..grid });
    if let Some(warning) = slow(&outcome, grid.step, &start, shorter) {
        sink.warn(&warning.text());
        outcome.warnings.push(warning);
    }
    outcome.estimated(found, setup.tolerance, sink);
    outcome.backend = code.map(|code| code.used());
    Ok(outcome)
}

impl Derived {
    /// The quantities watched in a run in steps of this size.
    pub(crate) fn watched(&self, step: f64) -> Watched<'_> {
        let Facts { algebra, coordinates, .. } = self.facts();
        let damped = self.damping.is_some().then_some(match step < 0.0 {
            true => "rises: damping acts, and the run goes back in time",
            false => "falls: damping acts",
        });
        Watched { algebra, coordinates, invariants: &self.invariants, attitude: true, damped }
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
    let (invariants, attitude) = (Invariants::of(&algebra), model.attitude);
    let (algebra, coordinates, invariants) = (&algebra, &coordinates, &invariants);
    let watched = Watched { algebra, coordinates, invariants, attitude, damped: None };
    let warnings = if attitude { Vec::new() } else { vec![Warning::NoAttitude] };
    let chart = if model.chart == "cayley" { lie::Chart::Cayley } else { lie::Chart::Exponential };
    let group = Charted::new(file, product_group(file, algebra)?, chart)?;
    let grid = setup.schedule.grid();
    let motion: Box<dyn Motion + '_> = match &group.cayley {
        None => Box::new(Learned::<_, Exponential>::new(&group.exponential, model, grid)),
        Some(group) => Box::new(Learned::<_, Cayley>::new(group, model, grid)),
    };
    let start = setup.start(file, motion.space())?;
    let (mut outcome, ..) =
        Subject { setup, watched, warnings }.run(motion.as_ref(), &start, sink)?;
    outcome.estimated_error = Err(Unknown::LEARNED);
    Ok(outcome)
}

struct Learned<'a, G: Restore, C: Chart<G>> {
    elements: Elements<G>,
    grid: Grid,
    map: Generating<G, C, &'a Model>,
}

impl<'a, G: Restore, C: Chart<G>> Learned<'a, G, C> {
    fn new(group: &Arc<G>, model: &'a ModelFile, grid: Grid) -> Self {
        let map = Generating::new((**group).clone(), &model.model);
        Self { elements: Elements { group: group.clone(), compiled: None }, grid, map }
    }
}

impl<G: Restore, C: Chart<G> + Send + Sync> Motion for Learned<'_, G, C> {
    fn space(&self) -> &dyn Space {
        &self.elements
    }

    fn grid(&self) -> Grid {
        self.grid
    }

    fn advance(&self, state: &mut Numbers, _: u64, count: u64) -> Result<Solves, (u64, StepError)> {
        one_by_one(count, || {
            let mut phase = self.elements.phase(state);
            let report = advance(&self.map, &mut phase)?;
            *state = self.elements.state(&phase);
            Ok(Some(Solved::one(report.iterations, report.residual)))
        })
    }

    /// A learned map has one step.
    fn beside(&self, _: &Numbers, _: f64, size: f64) -> Result<Numbers, StepError> {
        Err(StepError::InvalidStep { step: size })
    }

    fn one_at(&self, state: &mut Numbers, _: f64) -> Result<(), StepError> {
        self.advance(state, 0, 1).map(drop).map_err(|(_, error)| error)
    }

    fn defined(&self, _: &Numbers, _: f64) -> Result<(), StepError> {
        Ok(())
    }
}
