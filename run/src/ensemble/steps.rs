//! The steps of a system, of many states: by the programs where there are any, eight side by side, or one by one.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use coadjoint::{Chart, GeneratingFunction, Phase, StepError};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::{Conserved, Invariants, Scratch, nudge};
use coadjoint_device::Card;
use coadjoint_program::{Precision, Trajectories};
use nalgebra::DVector;
use rayon::prelude::*;

use super::attitude::Attitudes;
use super::device::{self, Use};
use super::engine::{Drift, Engine, How, Watch, larger};
use super::layout::{Layout, Shape};
use super::pack::{Manner, march};
use super::rows::{Rejected, Rows, Stopped};
use crate::engine::{
    Compiled, Interpreter, Kept, Numbers, Restore, STEEP, Steepness, advise, entries_of, phase_of,
};
use crate::error::RunError;

/// Steps that all rows make before the next: each is then about as far, and what is told of it is true. The runtime
/// forgets everything after this number of steps, so that cutting a run there changes no bit.
pub const STRETCH: u64 = 256;

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
    attitudes: Attitudes,
    invariants: Invariants,
    /// The numbers of the identity, where rows that give no attitude start.
    identity: Vec<f64>,
    step: f64,
    /// Those of half the size, of a quarter, …, as far as they were needed to advise.
    shorter: Mutex<Vec<Interpreter<'a, G, C>>>,
}

/// A state on its way that no programs serve.
struct Lone<G: Restore> {
    phase: Phase<G>,
    stopped: Option<(u64, StepError)>,
    /// The largest ratio seen.
    ratio: f64,
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
        let compiled = Compiled::new(&stepper, how.backend, how.work, Trajectories::Lanes, kept)?;
        let card = how.device.map(|asked| device::open(&stepper, asked)).transpose()?;
        let attitudes = Attitudes::of(&integrator.problem.algebra);
        let group = stepper.group();
        let identity = numbers_of(compiled.as_ref(), entries_of(group, &group.identity()));
        Ok(Self {
            integrator,
            stepper,
            compiled,
            card: card.map(Mutex::new),
            redone: AtomicU64::new(0),
            attitudes,
            invariants: Invariants::of(&integrator.problem.algebra),
            identity,
            step,
            shorter: Mutex::default(),
        })
    }

    /// The numbers of the element with this matrix, row by row.
    fn element_of(&self, matrix: Vec<f64>) -> Vec<f64> {
        numbers_of(self.compiled.as_ref(), matrix)
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
        let matrix = entries_of(self.stepper.group(), &phase.group_element);
        Numbers { g: self.element_of(matrix), mu: phase.momentum.as_slice().to_vec() }
    }

    /// Puts a state of single precision onto the group, as the group's own products do.
    fn settle(&self, own: &mut Numbers) {
        let group = self.stepper.group();
        let (mut phase, one) = (self.phase(own), group.identity());
        for _ in 0..2 {
            phase.group_element = group.compose(&phase.group_element, &one);
        }
        *own = self.numbers(&phase);
    }

    /// The state of a row, or what is wrong with it.
    fn read(&self, layout: &Layout, row: &[f64]) -> Result<Numbers, String> {
        if let Some(place) = row.iter().position(|value| !value.is_finite()) {
            let name = layout.names().swap_remove(place);
            return Err(format!("{name} is {}", row[place]));
        }
        let group = self.stepper.group();
        let (mu, attitude) = row.split_at(group.dim());
        let given = self.attitudes.read(layout.attitude, group.matrix_size(), attitude)?;
        let Some(matrix) = given else {
            return Ok(Numbers { g: self.identity.clone(), mu: mu.to_vec() });
        };
        let size = group.matrix_size();
        let element = group.element_from_matrix(|i, j| matrix[i * size + j]);
        let element = element.map_err(|_| "the attitude is no element of the group".to_owned())?;
        Ok(Numbers { g: self.element_of(entries_of(group, &element)), mu: mu.to_vec() })
    }

    /// Writes a state into a row.
    fn write(&self, layout: &Layout, numbers: &Numbers, row: &mut [f64]) {
        let (mu, attitude) = row.split_at_mut(numbers.mu.len());
        mu.copy_from_slice(&numbers.mu);
        if !attitude.is_empty() {
            self.attitudes.write(layout.attitude, &self.matrix_of(&numbers.g), attitude);
        }
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
            coadjoint::advance(&shorter[place - 1], &mut state.clone()).is_ok()
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
        let mut conserved = |state: &Numbers| -> Conserved {
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

    /// Makes the steps of all states; why those stopped that did, by their places, and the largest ratio of the last two
    /// terms of the series that is worth a warning.
    fn march(
        &self,
        states: &mut [Numbers],
        steps: u64,
        watch: &Watch<'_>,
    ) -> Result<(BTreeMap<usize, Stopped>, f64), RunError> {
        let steepness = Steepness::new(&self.stepper);
        let ratio = |mu: &[f64]| steepness.ratio(&DVector::from_column_slice(mu));
        let before = states.iter().map(|state| ratio(&state.mu)).fold(0.0, larger);
        let (mut failed, along) = match &self.compiled {
            Some(compiled) => {
                let rescue = |own: &mut Numbers| compiled.rescue(&self.stepper, own);
                let manner = Manner { compiled, rescue: &rescue, ratio: &ratio, stop: watch.stop };
                match &self.card {
                    Some(card) => self.march_device(&manner, card, states, steps, watch.made)?,
                    None => march(&manner, states, (steps, STRETCH), watch.made),
                }
            }
            None => self.one_by_one(states, steps, &steepness, watch),
        };
        for failure in failed.values_mut() {
            failure.error = self.advise(failure.error, &self.phase(&states[failure.index]));
        }
        let ratio = larger(before, along);
        Ok((failed, if ratio <= STEEP { 0.0 } else { ratio }))
    }

    /// The same on a device.
    fn march_device(
        &self,
        manner: &Manner<'_>,
        card: &Mutex<Card>,
        states: &mut [Numbers],
        steps: u64,
        made: &dyn Fn(u64),
    ) -> Result<(BTreeMap<usize, Stopped>, f64), RunError> {
        // A thread that panicked has left a whole card: its rows are its own.
        let mut card = card.lock().unwrap_or_else(PoisonError::into_inner);
        let single = card.precision() == Precision::Single;
        let settle = |own: &mut Numbers| {
            if single {
                self.settle(own);
            }
        };
        let moved = device::march(manner, &mut card, &settle, states, (steps, made))?;
        self.redone.fetch_add(moved.redone, Ordering::Relaxed);
        Ok((moved.failed, moved.ratio))
    }

    /// The same without programs.
    fn one_by_one(
        &self,
        states: &mut [Numbers],
        steps: u64,
        steepness: &Steepness<'_, Interpreter<'a, G, C>>,
        watch: &Watch<'_>,
    ) -> (BTreeMap<usize, Stopped>, f64) {
        let lone = |state: &Numbers| Lone { phase: self.phase(state), stopped: None, ratio: 0.0 };
        let mut moving: Vec<Lone<G>> = states.par_iter().map(lone).collect();
        let mut done = 0;
        let stop = watch.stop;
        while done < steps && !watch.stopped() {
            let stretch = STRETCH.min(steps - done);
            moving.par_iter_mut().filter(|own| own.stopped.is_none()).for_each(|own| {
                if stop.load(Ordering::Relaxed) {
                    return;
                }
                let advanced = coadjoint::advance_by(&self.stepper, &mut own.phase, stretch);
                own.stopped = advanced.err().map(|stopped| (done + stopped.steps, stopped.error));
                own.ratio = larger(own.ratio, steepness.ratio(&own.phase.momentum));
            });
            done += stretch;
            (watch.made)(done);
        }
        let mut failed = BTreeMap::new();
        let mut ratio = 0.0;
        for (index, (own, state)) in moving.iter().zip(states).enumerate() {
            *state = self.numbers(&own.phase);
            ratio = larger(ratio, own.ratio);
            if let Some((step, error)) = own.stopped {
                failed.insert(index, Stopped { index, step, error });
            }
        }
        (failed, ratio)
    }
}

impl<G, C> Engine for Steps<'_, G, C>
where
    G: Restore<Element: Send + Sync> + Send + Sync,
    C: Chart<G> + Send + Sync,
{
    fn shape(&self) -> Shape {
        let group = self.stepper.group();
        let quaternions = self.attitudes == Attitudes::Rotations;
        Shape { dim: group.dim(), matrix_size: group.matrix_size(), quaternions }
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
        let mut places = Vec::with_capacity(read.len());
        let mut states = Vec::with_capacity(read.len());
        for (place, state) in read.into_iter().enumerate() {
            let row = rows.first + place as u64;
            match state {
                _ if known.binary_search(&row).is_ok() => {}
                Ok(state) => {
                    places.push(place);
                    states.push(state);
                }
                Err(reason) => rows.rejected.push(Rejected { row, step: 0, reason }),
            }
        }
        let before = states.clone();
        let (failed, ratio) = self.march(&mut states, steps, watch)?;
        if watch.stopped() {
            return Err(RunError::Halted { time: 0.0, step: 0 });
        }
        for (place, failure) in &failed {
            rows.rejected.push(Rejected {
                row: rows.first + places[*place] as u64,
                step: failure.step + 1,
                reason: failure.error.to_string(),
            });
        }
        rows.values.fill(f64::NAN);
        let drift = |scratch: &mut Scratch,
                     (place, (before, after)): (usize, (&Numbers, &Numbers))| {
            (!failed.contains_key(&place)).then(|| self.drift(scratch, before, after))
        };
        let rows_moved = before.par_iter().zip(&states).enumerate();
        let drifts: Vec<Option<Drift>> = rows_moved.map_init(Scratch::default, drift).collect();
        let mut largest = Drift { ratio, ..Drift::default() };
        for ((&place, state), drift) in places.iter().zip(&states).zip(drifts) {
            let Some(drift) = drift else { continue };
            let row = &mut rows.values[place * width..(place + 1) * width];
            self.write(layout, state, row);
            if let Err(reason) = check(layout, row) {
                row.fill(f64::NAN);
                let row = rows.first + place as u64;
                rows.rejected.push(Rejected { row, step: steps, reason });
                continue;
            }
            largest = largest.max(drift);
        }
        rows.rejected.sort_by_key(|r| r.row);
        Ok(largest)
    }
}

/// The numbers of the element with this matrix, row by row: the matrix itself where there are no programs.
fn numbers_of(compiled: Option<&Compiled>, matrix: Vec<f64>) -> Vec<f64> {
    match compiled {
        Some(compiled) => compiled.element_of(&matrix),
        None => matrix,
    }
}

/// Refuses an end state with a number that is not finite.
fn check(layout: &Layout, row: &[f64]) -> Result<(), String> {
    let Some(place) = row.iter().position(|value| !value.is_finite()) else { return Ok(()) };
    let name = layout.names().swap_remove(place);
    Err(format!("{name} is {} at the end", row[place]))
}

#[cfg(test)]
mod tests {
    use super::super::layout::Attitude;
    use super::*;

    #[test]
    fn what_is_not_finite_is_never_an_end_state() {
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
