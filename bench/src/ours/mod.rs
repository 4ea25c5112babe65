//! Our methods, as users write them.

mod free_body;
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

    /// Integrates by equal steps of about `step`; `None` where there is no integrator for the system.
    fn run(&self, problem: &Problem, step: f64) -> Option<Result<State, RunError>>;
}

/// A truncation as a row.
struct Ours<R> {
    name: String,
    truncation: u32,
    runs: R,
}

impl<R> Ours<R> {
    fn new(truncation: u32, group: &str, runs: R) -> Self {
        Self { name: format!("coadjoint, {group}, K = {truncation}"), truncation, runs }
    }
}

impl<R: Run> Method for Ours<R> {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        "coadjoint"
    }

    fn order(&self) -> Option<u32> {
        Some(self.truncation + 1)
    }

    fn applies(&self, problem: &Problem) -> bool {
        self.runs.applies(&problem.system)
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep(problem)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(&self.name)?;
        self.runs.run(problem, step).unwrap_or_else(|| {
            Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: problem.name.to_owned(),
            })
        })
    }
}
