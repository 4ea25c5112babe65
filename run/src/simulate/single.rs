//! Steps one at a time, ready to be made.

use std::sync::Arc;

use coadjoint::StepError;
use coadjoint_program::Trajectories;

use super::setup::not_an_element;
use crate::backend::Backend;
use crate::engine::{Compiled, Motion, Numbers};
use crate::error::RunError;
use crate::grid::Grid;
use crate::load::Derived;

/// Entries this near, relatively, to those of an element are those of one: so far rounding goes in many steps.
const SAME: f64 = 1e-12;

/// The step of one size, ready to be made from any state.
#[derive(Debug)]
pub struct Single<S> {
    system: S,
    step: f64,
    /// Rows of the group's matrices.
    size: usize,
    compiled: Option<Arc<Compiled>>,
}

impl<S: AsRef<Derived>> Single<S> {
    /// Prepares steps of this size, about `steps` of which are going to be made.
    ///
    /// # Errors
    /// Fails if the step makes no sense, or the backend asked for cannot be had.
    pub fn new(system: S, step: f64, backend: Backend, steps: f64) -> Result<Self, RunError> {
        let compiled = system.as_ref().compiled(step, backend, steps, Trajectories::One)?;
        let mut single = Self { system, step, size: 0, compiled };
        // The elements that there are do not depend on the time.
        let size = single.motion(0.0, None).map_err(RunError::unmade)?.space().size();
        single.size = size;
        Ok(single)
    }

    /// The backend that makes the steps.
    pub fn backend(&self) -> String {
        Compiled::maker(self.compiled.as_deref())
    }

    /// The system.
    pub fn system(&self) -> &Derived {
        self.system.as_ref()
    }

    /// The steps from this time on, for these values of the parameters that the system keeps, else for those of its text.
    fn motion(&self, start: f64, parameters: Option<&[f64]>) -> Result<Motion<'_>, StepError> {
        let (grid, system) = (Grid { start, step: self.step }, self.system.as_ref());
        match parameters {
            Some(values) => system.with_parameters(grid, values, self.compiled.as_ref()),
            None => system.steps(grid, self.compiled.as_ref()),
        }
    }

    /// Rows of the group's matrices.
    pub fn matrix_size(&self) -> usize {
        self.size
    }

    /// The matrix, row by row, of the element of the group that this one is, up to rounding; one that is an element to
    /// the last digits stays as it is.
    ///
    /// # Errors
    /// Fails if it is none.
    pub fn element(&self, matrix: &[f64]) -> Result<Vec<f64>, RunError> {
        let found = self.motion(0.0, None).map_err(RunError::unmade)?.space().nearest(matrix);
        let found = found.map_err(|error| not_an_element(&self.system.as_ref().file, &error))?;
        let far = found.iter().zip(matrix).any(|(a, b)| (a - b).abs() > SAME * (1.0 + a.abs()));
        Ok(if far { found } else { matrix.to_vec() })
    }

    /// The ratio of the last two terms of the series at a momentum, where it may be worth a warning; else 0.
    pub fn ratio(&self, mu: &[f64]) -> f64 {
        self.motion(0.0, None).map_or(0.0, |motion| motion.ratio(mu))
    }

    /// Makes `steps` steps of the state with this matrix, row by row, and this momentum, which `first` steps from `time` on
    /// have reached, in place, for these values of the parameters that the system keeps, else for those of its text. The matrix is not
    /// checked.
    ///
    /// # Errors
    /// Which step was not made, from 1, and why; the state is then that before it.
    pub fn advance(
        &self,
        matrix: &mut [f64],
        mu: &mut [f64],
        time: f64,
        [first, steps]: [u64; 2],
        parameters: Option<&[f64]>,
    ) -> Result<(), (u64, StepError)> {
        let motion = self.motion(time, parameters).map_err(|error| (1, error))?;
        let mut state = Numbers { g: motion.space().numbers(matrix), mu: mu.to_vec() };
        let made = motion.advance(&mut state, first, steps);
        matrix.copy_from_slice(&motion.space().matrix(&state.g));
        mu.copy_from_slice(&state.mu);
        made.map(drop).map_err(|(done, error)| (done + 1, error))
    }

    /// A state of this time that goes on by such steps; its matrix, row by row, is not checked.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub fn begin(&self, matrix: &[f64], mu: &[f64], start: f64) -> Result<Ongoing, RunError> {
        let motion = self.motion(start, None).map_err(RunError::unmade)?;
        let state = Numbers { g: motion.space().numbers(matrix), mu: mu.to_vec() };
        Ok(Ongoing { state, start, made: 0 })
    }

    /// Makes `steps` more steps of a state, as [`Single::advance`].
    ///
    /// # Errors
    /// As [`Single::advance`].
    pub fn go_on(
        &self,
        ongoing: &mut Ongoing,
        steps: u64,
        parameters: Option<&[f64]>,
    ) -> Result<(), (u64, StepError)> {
        let motion = self.motion(ongoing.start, parameters).map_err(|error| (1, error))?;
        let made = motion.advance(&mut ongoing.state, ongoing.made, steps);
        ongoing.made += made.as_ref().err().map_or(steps, |(done, _)| *done);
        made.map(drop).map_err(|(done, error)| (done + 1, error))
    }

    /// The time of a state, its matrix, row by row, and its momentum.
    pub fn state(&self, ongoing: &Ongoing) -> (f64, Vec<f64>, Vec<f64>) {
        let Ongoing { state, start, made } = ongoing;
        let matrix = match &self.compiled {
            Some(compiled) => compiled.matrix_of(&state.g),
            None => state.g.clone(),
        };
        (Grid { start: *start, step: self.step }.time(*made), matrix, state.mu.clone())
    }
}

/// A state that goes on from call to call, with what its steps leave to the next ones.
#[derive(Clone, Debug)]
pub struct Ongoing {
    state: Numbers,
    start: f64,
    made: u64,
}
