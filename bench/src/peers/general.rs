//! Methods for any system of ordinary differential equations, made rows of the comparison.

use crate::{
    method::{Method, RunError, Setting, step_sweep, tolerance_sweep},
    problem::{FreeBody, MovingBody, Problem, System, Translation, VectorField},
    state::State,
};

/// How a general method's accuracy is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// By a fixed step.
    Step,
    /// By a tolerance.
    Tolerance,
}

/// A method for ẏ = f(y).
pub trait Solver {
    /// How its accuracy is set.
    const CONTROL: Control;

    /// y(end), with `accuracy` the step or the tolerance.
    ///
    /// # Errors
    /// When an implicit equation is not solved or the step becomes too small.
    fn solve<const N: usize, F: VectorField<N>>(
        &self,
        field: &F,
        initial: [f64; N],
        end: f64,
        accuracy: f64,
    ) -> Result<[f64; N], RunError>;
}

/// A general method as a row.
#[derive(Clone, Debug)]
pub struct General<S> {
    name: String,
    family: &'static str,
    order: u32,
    solver: S,
}

impl<S: Solver> General<S> {
    /// Names a solver.
    pub fn new(name: impl Into<String>, family: &'static str, order: u32, solver: S) -> Self {
        Self { name: name.into(), family, order, solver }
    }

    fn moving<T: Translation>(
        &self,
        body: &MovingBody<T>,
        problem: &Problem,
        accuracy: f64,
    ) -> Result<State, RunError> {
        let initial = MovingBody::<T>::pack(&problem.initial);
        self.solver.solve(body, initial, problem.end, accuracy).map(|y| MovingBody::<T>::unpack(&y))
    }
}

impl<S: Solver> Method for General<S> {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        self.family
    }

    fn order(&self) -> Option<u32> {
        Some(self.order)
    }

    fn applies(&self, _: &Problem) -> bool {
        true
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        match S::CONTROL {
            Control::Step => step_sweep(problem),
            Control::Tolerance => tolerance_sweep(),
        }
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let accuracy = match (setting, S::CONTROL) {
            (Setting::Step(h), Control::Step) => h,
            (Setting::Tolerance(tolerance), Control::Tolerance) => tolerance,
            (given, control) => {
                let wanted = if control == Control::Step { "a step" } else { "a tolerance" };
                return Err(RunError::Setting { method: self.name.clone(), wanted, given });
            }
        };
        match &problem.system {
            System::FreeBody(body) => self
                .solver
                .solve(body, FreeBody::pack(&problem.initial), problem.end, accuracy)
                .map(|y| FreeBody::unpack(&y)),
            System::HeavyTop(body) => self.moving(body, problem, accuracy),
            System::Kirchhoff(body) => self.moving(body, problem, accuracy),
            System::Kovalevskaya(body) => self.moving(body, problem, accuracy),
        }
    }
}
