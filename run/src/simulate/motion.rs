//! A state on its way, and what makes its steps.

use std::cell::RefCell;

use coadjoint::{Phase, StepError};
use coadjoint_codegen::step::Scratch;
use nalgebra::DVector;

use super::schedule::Schedule;
use crate::engine::{Compiled, Numbers, Restore, Solves, entries_of, phase_of};
use crate::number::maximum;

/// How the numbers of a state are read.
pub trait Space {
    /// The rows of the group's matrices.
    fn size(&self) -> usize;

    /// The matrix of the element with these numbers, row by row.
    fn matrix(&self, g: &[f64]) -> Vec<f64>;

    /// Ad\*_g μ.
    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64>;
}

/// A state on its way.
pub trait Motion: Space {
    /// The state.
    fn state(&self) -> &Numbers;

    /// Puts another state in its place.
    fn place(&mut self, state: Numbers);

    /// Makes `count` steps of the grid after the first `first`. The state that comes of them does not depend on how many
    /// are made at a time.
    ///
    /// # Errors
    /// How many were made, and why the next one was not; the state is then that before it.
    fn advance(&mut self, first: u64, count: u64) -> Result<Solves, (u64, StepError)>;

    /// The state after a step of another length from this time.
    ///
    /// # Errors
    /// Where there is none.
    fn beside(&self, time: f64, part: f64) -> Result<Numbers, StepError>;

    /// The ratio of the last two terms of the series at the momentum, where it may be worth a warning; else 0.
    fn ratio(&self) -> f64;
}

/// States whose elements are the matrices of a group.
pub struct Matrices<'a, G>(pub &'a G);

impl<G: Restore> Space for Matrices<'_, G> {
    fn size(&self) -> usize {
        self.0.matrix_size()
    }

    fn matrix(&self, g: &[f64]) -> Vec<f64> {
        g.to_vec()
    }

    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64> {
        phase_of(self.0, &state.g, &state.mu).spatial_momentum(self.0).as_slice().to_vec()
    }
}

/// Makes a step of the grid from this time.
type GridStep<'a, G> = dyn Fn(f64, &mut Phase<G>) -> Result<Solves, StepError> + 'a;

/// Makes a step of another length from this time: (time, length, state).
type SideStep<'a, G> = dyn Fn(f64, f64, &mut Phase<G>) -> Result<(), StepError> + 'a;

/// Steps of a group's states, made one by one.
pub struct Steps<'a, G: Restore> {
    /// The group.
    pub group: &'a G,
    /// The grid.
    pub schedule: &'a Schedule,
    /// A step of the grid.
    pub step: &'a GridStep<'a, G>,
    /// A step of another length.
    pub side: &'a SideStep<'a, G>,
    /// The ratio of [`Motion::ratio`] at a momentum.
    pub ratio: &'a dyn Fn(&DVector<f64>) -> f64,
}

/// A state that moves step by step.
pub struct OneByOne<'a, G: Restore> {
    steps: Steps<'a, G>,
    state: Numbers,
}

impl<'a, G: Restore> OneByOne<'a, G> {
    /// From this state.
    pub fn new(steps: Steps<'a, G>, state: Numbers) -> Self {
        Self { steps, state }
    }

    fn phase(&self) -> Phase<G> {
        phase_of(self.steps.group, &self.state.g, &self.state.mu)
    }

    fn numbers(&self, phase: &Phase<G>) -> Numbers {
        let g = entries_of(self.steps.group, &phase.group_element);
        Numbers { g, mu: phase.momentum.as_slice().to_vec() }
    }
}

impl<G: Restore> Space for OneByOne<'_, G> {
    fn size(&self) -> usize {
        self.steps.group.matrix_size()
    }

    fn matrix(&self, g: &[f64]) -> Vec<f64> {
        g.to_vec()
    }

    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64> {
        Matrices(self.steps.group).spatial_momentum(state)
    }
}

impl<G: Restore> Motion for OneByOne<'_, G> {
    fn state(&self) -> &Numbers {
        &self.state
    }

    fn place(&mut self, state: Numbers) {
        self.state = state;
    }

    fn advance(&mut self, first: u64, count: u64) -> Result<Solves, (u64, StepError)> {
        let (mut total, mut phase) = (None, self.phase());
        let made = (first..first + count).try_for_each(|n| {
            let time = self.steps.schedule.time(n);
            let made = (self.steps.step)(time, &mut phase).map_err(|error| (n - first, error))?;
            total = match (total, made) {
                (Some((a, b)), Some((c, d))) => Some((u32::max(a, c), maximum(b, d))),
                (a, b) => a.or(b),
            };
            Ok(())
        });
        self.state = self.numbers(&phase);
        made.map(|()| total)
    }

    fn beside(&self, time: f64, part: f64) -> Result<Numbers, StepError> {
        let mut phase = self.phase();
        (self.steps.side)(time, part, &mut phase)?;
        Ok(self.numbers(&phase))
    }

    fn ratio(&self) -> f64 {
        (self.steps.ratio)(&DVector::from_column_slice(&self.state.mu))
    }
}

/// A state that programs move; `steps` are made where these refuse, and beside the grid.
pub struct ByPrograms<'a, G: Restore> {
    compiled: &'a Compiled,
    steps: Steps<'a, G>,
    state: Numbers,
    scratch: RefCell<Scratch>,
}

impl<'a, G: Restore> ByPrograms<'a, G> {
    /// From the state with this matrix, row by row.
    pub fn new(compiled: &'a Compiled, steps: Steps<'a, G>, start: Numbers) -> Self {
        let state = Numbers { g: compiled.element_of(&start.g), mu: start.mu };
        Self { compiled, steps, state, scratch: RefCell::default() }
    }
}

impl<G: Restore> Space for ByPrograms<'_, G> {
    fn size(&self) -> usize {
        self.steps.group.matrix_size()
    }

    fn matrix(&self, g: &[f64]) -> Vec<f64> {
        self.compiled.matrix_of(g)
    }

    fn spatial_momentum(&self, state: &Numbers) -> Vec<f64> {
        let mut momentum = vec![0.0; state.mu.len()];
        self.compiled.spatial_momentum(state, &mut self.scratch.borrow_mut(), &mut momentum);
        momentum
    }
}

impl<G: Restore> Motion for ByPrograms<'_, G> {
    fn state(&self) -> &Numbers {
        &self.state
    }

    fn place(&mut self, state: Numbers) {
        self.state = state;
    }

    fn advance(&mut self, first: u64, count: u64) -> Result<Solves, (u64, StepError)> {
        let Self { compiled, steps, state, .. } = self;
        let time = steps.schedule.time(first);
        let one = |phase: &mut Phase<G>| (steps.step)(time, phase);
        let made =
            compiled.advance(state, count, |state| compiled.rescue(steps.group, state, one))?;
        // A bound, which may be far below what rounding leaves.
        Ok(Some((made.corrections, made.residual.max(f64::EPSILON))))
    }

    fn beside(&self, time: f64, part: f64) -> Result<Numbers, StepError> {
        let mut phase = self.compiled.phase(self.steps.group, &self.state);
        (self.steps.side)(time, part, &mut phase)?;
        Ok(self.compiled.numbers(self.steps.group, &phase))
    }

    fn ratio(&self) -> f64 {
        (self.steps.ratio)(&DVector::from_column_slice(&self.state.mu))
    }
}
