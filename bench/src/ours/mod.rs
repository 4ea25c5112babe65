//! Our methods, as users write them.

pub(crate) mod free_body;
mod moving_body;

use crate::{
    method::{Method, RunError, Setting, step_sweep},
    problem::{Problem, System},
    state::State,
};

/// Every row of ours.
#[must_use]
pub fn all() -> Vec<Box<dyn Method>> {
    let mut methods = free_body::all();
    methods.extend(moving_body::all());
    methods
}

/// Generated integrators of one truncation.
trait Run {
    /// Whether there is one for such a system.
    fn applies(&self, system: &System) -> bool;

    /// Integrates by equal steps of about `step`, with the series as it is or tuned to the motion;
    /// `None` where there is no integrator for the system.
    fn run(&self, problem: &Problem, step: f64, tuned: bool) -> Option<Result<State, RunError>>;
}

/// A truncation as a row.
struct Ours<R> {
    name: String,
    truncation: u32,
    tuned: bool,
    runs: R,
}

/// The rows of a truncation: the series as it is, and with its tail summed.
fn rows<R: Run + Copy + 'static>(
    truncation: u32,
    group: &str,
    runs: R,
) -> impl Iterator<Item = Box<dyn Method>> {
    let plain = format!("coadjoint, {group}, K = {truncation}");
    [(plain.clone(), false), (format!("{plain}, tuned"), true)].into_iter().map(
        move |(name, tuned)| Box::new(Ours { name, truncation, tuned, runs }) as Box<dyn Method>,
    )
}

impl<R: Run> Method for Ours<R> {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        "coadjoint"
    }

    /// Tuned, the term of order K + 1 is small beside the next, and no order is measured cleanly.
    fn order(&self) -> Option<u32> {
        (!self.tuned).then_some(self.truncation + 1)
    }

    fn applies(&self, problem: &Problem) -> bool {
        self.runs.applies(&problem.system)
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep(problem)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(&self.name)?;
        self.runs.run(problem, step, self.tuned).unwrap_or_else(|| {
            Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: problem.name.to_owned(),
            })
        })
    }
}
