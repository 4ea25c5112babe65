//! The steps of a system, of many states: by the programs where there are any, eight side by side, or one by one.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use coadjoint::groups::Chart;
use coadjoint::{GeneratingFunction, Phase, StepError};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::{Invariants, Scratch, nudge};
use coadjoint_native::cards::Card;
use coadjoint_program::{Precision, Trajectories};
use nalgebra::DVector;
use rayon::prelude::*;

use super::engine::{Drift, Engine, How, Use, Watch, larger};
use super::layout::{Layout, Shape};
use super::march::{Manner, Way};
use super::rows::{Rejected, Rows};
use crate::engine::{
    Compiled, Interpreter, Kept, Numbers, Restore, STEEP, Steepness, advise, card, entries_of,
    phase_of,
};
use crate::error::RunError;

/// Steps of a system on a group.
pub struct Steps<'a, G, C> {
    integrator: &'a Integrator,
    stepper: Interpreter<'a, G, C>,
    /// The same as programs, where it can be.
    compiled: Option<Compiled>,
    /// The same on a device, where one is named.
    card: Option<Mutex<Card>>,
    /// Rows of which the device has refused a step.
    redone: AtomicU64,
    invariants: Invariants,
    /// The numbers of the identity, where rows that give no attitude start.
    identity: Vec<f64>,
    step: f64,
    /// Those of half the size, of a quarter, …, as far as they were needed to advise.
    shorter: Mutex<Vec<Interpreter<'a, G, C>>>,
}

impl<'a, G, C> Steps<'a, G, C>
where
    G: Restore<Element: Send + Sync> + Send + Sync,
    C: Chart<G> + Send + Sync,
{
    /// Steps of this length, by these means.
    ///
    /// # Errors
    /// Where the step makes no sense, or the backend or device that the user named cannot be had.
    pub fn new(
        integrator: &'a Integrator,
        group: G,
        step: f64,
        how: How,
        kept: &Kept,
    ) -> Result<Self, RunError> {
        let stepper = Interpreter::<G, C>::new(integrator, group, step)
            .map_err(|source| RunError::Step { time: 0.0, source })?;
        let compiled =
            Compiled::new(integrator, step, how.backend, how.work, Trajectories::Lanes, kept)?;
        let card = how.device.map(|asked| card(integrator, step, asked.device, asked.precision));
        let card = card.transpose()?.map(Mutex::new);
        let (redone, shorter) = Default::default();
        let invariants = Invariants::of(&integrator.problem.algebra);
        let mut steps = Self {
            integrator,
            stepper,
            compiled,
            card,
            redone,
            invariants,
            identity: Vec::new(),
            step,
            shorter,
        };
        let one = steps.stepper.group().identity();
        steps.identity = steps.element_of(&one);
        Ok(steps)
    }

    /// The numbers of an element: its matrix, row by row, where there are no programs.
    fn element_of(&self, element: &G::Element) -> Vec<f64> {
        let matrix = entries_of(self.stepper.group(), element);
        match &self.compiled {
            Some(compiled) => compiled.element_of(&matrix),
            None => matrix,
        }
    }

    /// The matrix of an element, row by row.
    fn matrix_of(&self, g: &[f64]) -> Vec<f64> {
        match &self.compiled {
            Some(compiled) => compiled.matrix_of(g),
            None => g.to_vec(),
        }
    }

    fn phase(&self, numbers: &Numbers) -> Phase<G> {
        phase_of(self.stepper.group(), &self.matrix_of(&numbers.g), &numbers.mu)
    }

    fn numbers(&self, phase: &Phase<G>) -> Numbers {
        let g = self.element_of(&phase.group_element);
        Numbers { g, mu: phase.momentum.as_slice().to_vec() }
    }

    /// The state of a row, or what is wrong with it.
    fn read(&self, layout: &Layout, row: &[f64]) -> Result<Numbers, String> {
        check(layout, row)?;
        let group = self.stepper.group();
        let (mu, attitude) = row.split_at(group.dim());
        let g = match layout.read_attitude(attitude)? {
            None => self.identity.clone(),
            Some(matrix) => {
                let size = group.matrix_size();
                let element = group.element_from_matrix(|i, j| matrix[i * size + j]);
                let off = |_| "the attitude is no element of the group".to_owned();
                self.element_of(&element.map_err(off)?)
            }
        };
        Ok(Numbers { g, mu: mu.to_vec() })
    }

    /// The error of the next step of a state, with a step size that works there.
    fn advise(&self, error: StepError, state: &Phase<G>) -> StepError {
        // A thread that panicked has left whole steppers, if any.
        let mut shorter = self.shorter.lock().unwrap_or_else(PoisonError::into_inner);
        let mut place = 0;
        advise(error, self.step, |h| {
            if shorter.len() == place {
                let group = self.stepper.group().clone();
                let Ok(stepper) = Interpreter::new(self.integrator, group, h) else { return false };
                shorter.push(stepper);
            }
            place += 1;
            coadjoint::steps::advance(&shorter[place - 1], &mut state.clone()).is_ok()
        })
    }

    fn spatial_momentum(&self, state: &Numbers, scratch: &mut Scratch) -> Vec<f64> {
        let mut momentum = vec![0.0; state.mu.len()];
        match &self.compiled {
            Some(compiled) => compiled.spatial_momentum(state, scratch, &mut momentum),
            None => {
                let found = self.phase(state).spatial_momentum(self.stepper.group());
                momentum.copy_from_slice(found.as_slice());
            }
        }
        momentum
    }

    /// The drifts of one row.
    fn drift(&self, scratch: &mut Scratch, before: &Numbers, after: &Numbers) -> Drift {
        let invariants = &self.invariants;
        let start = invariants.start(&before.mu, &self.spatial_momentum(before, scratch), Vec::new);
        let mut conserved = |state: &Numbers| {
            invariants.conserved(&state.mu, &self.spatial_momentum(state, scratch), Vec::new)
        };
        let mut beside = after.clone();
        nudge(&mut beside.g);
        nudge(&mut beside.mu);
        let conserved = start.measured(&conserved(after), conserved(&beside));
        let hidden = conserved.spatial_momentum.is_none()
            || !invariants.casimirs.is_empty() && conserved.casimirs.is_none();
        Drift { conserved, unmeasured: hidden.into(), ratio: 0.0 }
    }

    /// Makes the steps of all states.
    fn march(
        &self,
        states: Vec<Numbers>,
        steps: u64,
        watch: &Watch<'_>,
    ) -> Result<Vec<Way>, RunError> {
        let steepness = Steepness::new(&self.stepper);
        let manner = Manner {
            compiled: self.compiled.as_ref(),
            rescue: &|state| {
                let mut phase = self.phase(state);
                let report = coadjoint::steps::advance(&self.stepper, &mut phase)?;
                *state = self.numbers(&phase);
                Ok(Some((report.iterations, report.residual)))
            },
            ratio: &|mu| steepness.ratio(&DVector::from_column_slice(mu)),
            stop: watch.stop,
        };
        let mut ways: Vec<Way> = states.into_iter().map(|state| manner.way(state)).collect();
        if let Some(card) = &self.card {
            // A thread that panicked has left a whole card: its rows are its own.
            let mut card = card.lock().unwrap_or_else(PoisonError::into_inner);
            let single = card.precision() == Precision::Single;
            // Puts a state of single precision onto the group, as the group's own products do.
            let settle = |own: &mut Numbers| {
                let (group, mut phase) = (self.stepper.group(), self.phase(own));
                for _ in 0..2 {
                    phase.group_element = group.compose(&phase.group_element, &group.identity());
                }
                *own = self.numbers(&phase);
            };
            let settle = |own: &mut Numbers| {
                if single {
                    settle(own)
                }
            };
            let redone = manner.march_on(&mut card, &settle, &mut ways, (steps, watch.made));
            self.redone.fetch_add(redone.map_err(RunError::Device)?, Ordering::Relaxed);
        } else {
            manner.march(&mut ways, steps, watch.made);
        }
        for way in &mut ways {
            if let Some((_, error)) = &mut way.stopped {
                *error = self.advise(*error, &self.phase(&way.state));
            }
        }
        Ok(ways)
    }
}

impl<G, C> Engine for Steps<'_, G, C>
where
    G: Restore<Element: Send + Sync> + Send + Sync,
    C: Chart<G> + Send + Sync,
{
    fn shape(&self) -> Shape {
        Shape::of(&self.integrator.problem.algebra)
    }

    fn casimirs(&self) -> usize {
        self.invariants.casimirs.len()
    }

    fn device(&self) -> Option<Use> {
        let card = self.card.as_ref()?.lock().unwrap_or_else(PoisonError::into_inner);
        Some(Use::of(&card, self.redone.load(Ordering::Relaxed)))
    }

    fn backend(&self) -> String {
        let maker = |compiled: &Compiled| compiled.code().maker().to_owned();
        self.compiled.as_ref().map_or_else(|| "interpreter".to_owned(), maker)
    }

    fn notes(&self) -> Vec<String> {
        self.compiled.as_ref().map_or_else(Vec::new, |compiled| compiled.code().notes())
    }

    fn advance(
        &self,
        layout: &Layout,
        steps: u64,
        rows: &mut Rows,
        watch: &Watch<'_>,
    ) -> Result<Drift, RunError> {
        let width = layout.width();
        let read: Vec<_> =
            rows.values.par_chunks(width).map(|row| self.read(layout, row)).collect();
        let known: Vec<u64> = rows.rejected.iter().map(|r| r.row).collect();
        let (mut places, mut before) = (Vec::new(), Vec::new());
        for ((place, state), row) in read.into_iter().enumerate().zip(rows.first..) {
            match state {
                _ if known.binary_search(&row).is_ok() => {}
                Ok(state) => {
                    places.push(place);
                    before.push(state);
                }
                Err(reason) => rows.rejected.push(Rejected { row, step: 0, reason }),
            }
        }
        let ways = self.march(before.clone(), steps, watch)?;
        if watch.stopped() {
            return Err(RunError::Halted { time: 0.0, step: 0 });
        }
        rows.values.fill(f64::NAN);
        // The row at the end and its drift, or the step that was not made and why.
        let end = |scratch: &mut Scratch, (before, way): (&Numbers, &Way)| {
            if let Some((step, error)) = &way.stopped {
                return Err((step + 1, error.to_string()));
            }
            let mut row = vec![0.0; width];
            let (mu, attitude) = row.split_at_mut(before.mu.len());
            mu.copy_from_slice(&way.state.mu);
            if !attitude.is_empty() {
                layout.write_attitude(&self.matrix_of(&way.state.g), attitude);
            }
            check(layout, &row).map_err(|what| (steps, format!("{what} at the end")))?;
            Ok((row, self.drift(scratch, before, &way.state)))
        };
        let ends: Vec<_> = before.par_iter().zip(&ways).map_init(Scratch::default, end).collect();
        let ratio = ways.iter().map(|way| way.ratio).fold(0.0, larger);
        let ratio = if ratio <= STEEP { 0.0 } else { ratio };
        let mut largest = Drift { ratio, ..Drift::default() };
        for (place, end) in places.into_iter().zip(ends) {
            match end {
                Ok((row, drift)) => {
                    rows.values[place * width..][..width].copy_from_slice(&row);
                    largest = largest.max(drift);
                }
                Err((step, reason)) => {
                    let row = rows.first + place as u64;
                    rows.rejected.push(Rejected { row, step, reason });
                }
            }
        }
        rows.rejected.sort_by_key(|r| r.row);
        Ok(largest)
    }
}

/// Refuses a row with a number that is not finite.
fn check(layout: &Layout, row: &[f64]) -> Result<(), String> {
    let Some(place) = row.iter().position(|value| !value.is_finite()) else { return Ok(()) };
    Err(format!("{} is {}", layout.names().swap_remove(place), row[place]))
}

#[cfg(test)]
mod tests {
    use super::super::layout::Attitude;
    use super::*;

    #[test]
    fn no_number_that_is_not_finite_becomes_an_end_state() {
        let shape = Shape { dim: 3, matrix_size: 3, quaternions: true };
        let layout = Layout { shape, attitude: Attitude::Quaternion };
        let row = [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0];
        assert_eq!(check(&layout, &row), Ok(()));
        for (place, value, expected) in
            [(1, f64::NAN, "mu_2 is NaN"), (5, f64::INFINITY, "q_y is inf")]
        {
            let mut wrong = row;
            wrong[place] = value;
            assert!(check(&layout, &wrong).unwrap_err().starts_with(expected));
        }
        assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan());
        assert_eq!((larger(1.0, 2.0), larger(2.0, 1.0)), (2.0, 2.0));
    }
}
