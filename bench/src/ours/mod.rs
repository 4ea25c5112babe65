//! Our methods, as users write them.

pub(crate) mod free_body;
mod moving_body;

use crate::{
    method::{Method, RunError, Setting, step_sweep_about},
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

    /// By what factor its steps are longer than those of other methods.
    fn pace(&self, system: &System) -> f64 {
        let _ = system;
        1.0
    }

    /// Integrates by equal steps of about `step`; `None` where there is no integrator for the system.
    fn run(&self, problem: &Problem, step: f64) -> Option<Result<State, RunError>>;
}

/// A truncation as a row.
struct Ours<R> {
    name: String,
    truncation: u32,
    runs: R,
}

/// The row of a truncation.
fn rows<R: Run + Copy + 'static>(
    truncation: u32,
    group: &str,
    runs: R,
) -> impl Iterator<Item = Box<dyn Method>> {
    let name = format!("coadjoint, {group}, K = {truncation}");
    std::iter::once(Box::new(Ours { name, truncation, runs }) as Box<dyn Method>)
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
        step_sweep_about(self.runs.pace(&problem.system) * problem.time_scale)
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
