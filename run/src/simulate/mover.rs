//! The moving part of a run: a state, and the stepper that advances it.

use std::cell::RefCell;

use coadjoint::{Chart, GeneratingFunction, Phase, StepError};
use coadjoint_codegen::step::Scratch;
use nalgebra::DVector;

use super::schedule::Schedule;
use crate::engine::{Compiled, Energy, Group, Interpreter, Numbers, Restore, entries_of, phase_of};
use crate::number::maximum;
use crate::rounding::nudge;

/// A state as it is watched.
pub trait Seen {
    /// μ.
    fn momentum(&self) -> &DVector<f64>;

    /// Ad\*_g μ.
    fn spatial_momentum(&self) -> DVector<f64>;

    /// Observations of the state with its numbers [nudged](nudge): μ, Ad\*_g μ, and the energy if it is known.
    fn nudged(&self, energy: Option<&Energy>) -> (DVector<f64>, DVector<f64>, Option<f64>);

    /// The energy.
    fn energy(&self, energy: &Energy) -> f64;

    /// A number of the group element that is not finite, where there is one.
    fn flaw(&self) -> Option<f64>;
}

/// A state as its group has it.
pub struct At<'a, G: Restore> {
    /// The group.
    pub group: &'a G,
    /// The state.
    pub phase: &'a Phase<G>,
}

impl<G: Restore> Seen for At<'_, G> {
    fn momentum(&self) -> &DVector<f64> {
        &self.phase.momentum
    }

    fn spatial_momentum(&self) -> DVector<f64> {
        self.phase.spatial_momentum(self.group)
    }

    fn nudged(&self, energy: Option<&Energy>) -> (DVector<f64>, DVector<f64>, Option<f64>) {
        let mut matrix = entries_of(self.group, &self.phase.group_element);
        let mut momentum = self.phase.momentum.clone();
        nudge(&mut matrix);
        nudge(momentum.as_mut_slice());
        let phase = phase_of(self.group, &matrix, momentum.as_slice());
        let beside = At { group: self.group, phase: &phase };
        (momentum, beside.spatial_momentum(), energy.map(|energy| beside.energy(energy)))
    }

    fn energy(&self, energy: &Energy) -> f64 {
        energy.value(self.group, self.phase)
    }

    fn flaw(&self) -> Option<f64> {
        let entries = entries_of(self.group, &self.phase.group_element);
        entries.into_iter().find(|entry| !entry.is_finite())
    }
}

/// How steps of the grid went.
#[derive(Clone, Copy, Debug, Default)]
pub struct Made {
    /// The most iterations and the largest residual of a solve, where there was one.
    pub solve: Option<(u32, f64)>,
}

impl Made {
    /// The worse of both in everything.
    fn worse(&mut self, other: Self) {
        self.solve = match (self.solve, other.solve) {
            (Some((a, b)), Some((c, d))) => Some((a.max(c), maximum(b, d))),
            (a, b) => a.or(b),
        };
    }
}

/// A state on its way.
pub trait Mover<G: Group>: Seen {
    /// Puts a state in place of the one that there is; `own` are the numbers that [`Mover::own`] gave of it.
    fn place(&mut self, phase: Phase<G>, own: Option<Vec<f64>>);

    /// Makes `count` steps of the grid after the first `first`. The state that comes of them does not depend on how many
    /// are made at a time.
    ///
    /// # Errors
    /// How many were made, and why the next one was not; the state is then that before it.
    fn advance(&mut self, first: u64, count: u64) -> Result<Made, (u64, StepError)>;

    /// The state as the group has it.
    fn phase(&self) -> Phase<G>;

    /// The numbers that make g, where they are other than its matrix.
    fn own(&self) -> Option<Vec<f64>>;
}

/// Steps made one by one, by what makes a single one from the time given.
pub struct OneByOne<'a, G: Restore, F> {
    group: &'a G,
    phase: Phase<G>,
    schedule: &'a Schedule,
    step: F,
}

impl<'a, G, F> OneByOne<'a, G, F>
where
    G: Restore,
    F: Fn(f64, &mut Phase<G>) -> Result<Made, StepError>,
{
    /// By these steps.
    pub fn new(group: &'a G, schedule: &'a Schedule, step: F) -> Self {
        let phase = Phase::<G>::new(group.identity(), DVector::zeros(group.dim()));
        Self { group, phase, schedule, step }
    }

    fn seen(&self) -> At<'_, G> {
        At { group: self.group, phase: &self.phase }
    }
}

impl<G: Restore, F> Seen for OneByOne<'_, G, F>
where
    F: Fn(f64, &mut Phase<G>) -> Result<Made, StepError>,
{
    fn momentum(&self) -> &DVector<f64> {
        &self.phase.momentum
    }

    fn spatial_momentum(&self) -> DVector<f64> {
        self.seen().spatial_momentum()
    }

    fn nudged(&self, energy: Option<&Energy>) -> (DVector<f64>, DVector<f64>, Option<f64>) {
        self.seen().nudged(energy)
    }

    fn energy(&self, energy: &Energy) -> f64 {
        self.seen().energy(energy)
    }

    fn flaw(&self) -> Option<f64> {
        self.seen().flaw()
    }
}

impl<G: Restore, F> Mover<G> for OneByOne<'_, G, F>
where
    F: Fn(f64, &mut Phase<G>) -> Result<Made, StepError>,
{
    fn place(&mut self, phase: Phase<G>, _own: Option<Vec<f64>>) {
        self.phase = phase;
    }

    fn advance(&mut self, first: u64, count: u64) -> Result<Made, (u64, StepError)> {
        let mut total = Made::default();
        for done in 0..count {
            let time = self.schedule.time(first + done);
            let made = (self.step)(time, &mut self.phase).map_err(|error| (done, error))?;
            total.worse(made);
        }
        Ok(total)
    }

    fn phase(&self) -> Phase<G> {
        self.phase.clone()
    }

    fn own(&self) -> Option<Vec<f64>> {
        None
    }
}

/// Steps made by programs.
pub struct ByPrograms<'a, 's, G: Restore, C> {
    compiled: &'a Compiled,
    interpreter: &'a Interpreter<'s, G, C>,
    /// Adds advice to the error of a refused step, given the state before it.
    advised: &'a dyn Fn(StepError, &Phase<G>) -> StepError,
    state: Numbers,
    /// The same μ as the state's.
    mu: DVector<f64>,
    /// The state that was put here, as long as no step was made: what is read of it has the bits that were given.
    placed: Option<Phase<G>>,
    scratch: RefCell<Scratch>,
}

impl<'a, 's, G: Restore, C: Chart<G>> ByPrograms<'a, 's, G, C> {
    /// By these programs, and where they refuse by the interpreter of the generating function.
    pub fn new(
        compiled: &'a Compiled,
        interpreter: &'a Interpreter<'s, G, C>,
        advised: &'a dyn Fn(StepError, &Phase<G>) -> StepError,
    ) -> Self {
        Self {
            compiled,
            interpreter,
            advised,
            state: Numbers { g: Vec::new(), mu: Vec::new() },
            mu: DVector::zeros(0),
            placed: None,
            scratch: RefCell::default(),
        }
    }

    fn spatial_momentum_of(&self, state: &Numbers) -> DVector<f64> {
        let mut momentum = DVector::zeros(self.mu.len());
        let scratch = &mut self.scratch.borrow_mut();
        self.compiled.spatial_momentum(state, scratch, momentum.as_mut_slice());
        momentum
    }
}

impl<G: Restore, C: Chart<G>> Seen for ByPrograms<'_, '_, G, C> {
    fn momentum(&self) -> &DVector<f64> {
        &self.mu
    }

    fn spatial_momentum(&self) -> DVector<f64> {
        self.spatial_momentum_of(&self.state)
    }

    fn nudged(&self, energy: Option<&Energy>) -> (DVector<f64>, DVector<f64>, Option<f64>) {
        let mut state = self.state.clone();
        nudge(&mut state.g);
        nudge(&mut state.mu);
        let spatial = self.spatial_momentum_of(&state);
        let energy = energy.map(|energy| energy.kinetic(&state.mu));
        (DVector::from_vec(state.mu), spatial, energy)
    }

    fn energy(&self, energy: &Energy) -> f64 {
        energy.kinetic(&self.state.mu)
    }

    fn flaw(&self) -> Option<f64> {
        self.state.g.iter().copied().find(|number| !number.is_finite())
    }
}

impl<G: Restore, C: Chart<G>> Mover<G> for ByPrograms<'_, '_, G, C> {
    fn place(&mut self, phase: Phase<G>, own: Option<Vec<f64>>) {
        self.state = self.compiled.numbers(self.interpreter.group(), &phase);
        if let Some(own) = own {
            self.state.g = own;
        }
        self.mu.clone_from(&phase.momentum);
        self.placed = Some(phase);
    }

    fn advance(&mut self, _first: u64, count: u64) -> Result<Made, (u64, StepError)> {
        let Self { compiled, interpreter, state, .. } = self;
        let made = compiled.advance(state, count, |numbers| compiled.rescue(interpreter, numbers));
        self.mu.copy_from_slice(&self.state.mu);
        self.placed = None;
        let made = made.map_err(|(done, error)| (done, (self.advised)(error, &self.phase())))?;
        // A bound, which may be far below what rounding leaves.
        Ok(Made { solve: Some((made.corrections, made.residual.max(f64::EPSILON))) })
    }

    fn phase(&self) -> Phase<G> {
        let made = || self.compiled.phase(self.interpreter.group(), &self.state);
        self.placed.clone().unwrap_or_else(made)
    }

    fn own(&self) -> Option<Vec<f64>> {
        Some(self.state.g.clone())
    }
}
