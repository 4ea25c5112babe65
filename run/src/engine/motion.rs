//! Steps of one size, whatever makes them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coadjoint::steps::{Piece, Splitting, compose};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::integrator::Kicks;
use coadjoint_codegen::step::Origin;

use super::breaks::Breaks;
use super::compiled::{Compiled, Folded, Numbers, Solved, Solves};
use super::kick::Torque;
use super::method::{Flow, Propagator, advise};
use super::space::{Space, Tables};
use super::tangent::{Carried, Read, Reading, Tangents};
use crate::backend::Backend;
use crate::grid::Grid;

/// Makes the method for these values of the parameters that are kept.
pub(super) type Maker<'a> =
    Box<dyn Fn(&[f64]) -> Result<Box<dyn Propagator<'a> + 'a>, StepError> + Send + Sync + 'a>;

/// The kicks between the flows of a step.
#[derive(Debug)]
struct Kicked<'a> {
    kicks: &'a Kicks,
    torque: Torque<'a>,
}

/// A step of this size without programs: its flows, one after the other.
struct Map<'a> {
    size: f64,
    flows: Vec<Flow<'a>>,
}

impl Map<'_> {
    /// Makes a step of a state from this time.
    fn step(
        &self,
        kicked: Option<&Kicked<'_>>,
        phase: &mut Phase<Tables>,
        time: f64,
    ) -> Result<Solves, StepError> {
        let Some(Kicked { kicks, torque }) = kicked else {
            return self.flows.first().map(|flow| flow(phase, time)).transpose();
        };
        compose(
            kicks.splitting,
            phase,
            [time, self.size],
            |piece, phase, time, length| match piece {
                Piece::Kick => torque.kick(phase, time, length),
                Piece::Flow(number) => self.flows[number](phase, time).map(drop),
            },
        )?;
        Ok(None)
    }
}

/// The lengths of the flows of a step of this size.
fn lengths(kicks: Option<&Kicks>, size: f64) -> Vec<f64> {
    let parts = |splitting: Splitting| splitting.flows().map(|part| size * part).collect();
    kicks.map_or_else(|| vec![size], |kicks| parts(kicks.splitting))
}

/// Sizes of steps whose coefficients are kept, beside that of the grid.
const MOST_OTHERS: usize = 16;

/// Moves states by steps of one size: by programs where there are any, else by its [`Propagator`], which also makes the steps that
/// programs refuse.
pub(crate) struct Motion<'a> {
    space: Space,
    grid: Grid,
    /// The values of the parameters that are kept.
    parameters: Vec<f64>,
    maker: Maker<'a>,
    /// The method for these values, once it was needed.
    method: OnceLock<Box<dyn Propagator<'a> + 'a>>,
    kicked: Option<Kicked<'a>>,
    /// The step without programs, once one was needed.
    map: OnceLock<Map<'a>>,
    /// The programs of steps of other sizes that were made last.
    others: Mutex<VecDeque<Arc<Compiled>>>,
    /// The system, where its steps may have derivatives.
    origin: Option<&'a Origin>,
    /// The times at which the equations jump or bend, so that steps end there.
    breaks: Breaks,
}

impl<'a> Motion<'a> {
    /// The steps of this grid for these values of the parameters that are kept.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite; where there are no programs also if the size of the step makes no sense.
    pub(super) fn new(
        space: Space,
        grid: Grid,
        parameters: Vec<f64>,
        maker: Maker<'a>,
        origin: Option<&'a Origin>,
    ) -> Result<Self, StepError> {
        let kicks = origin.and_then(Origin::kicks);
        let kicked = kicks.map(|kicks| {
            let torque = Torque::new(&kicks.kick, &space.group, &parameters)?;
            Ok::<_, StepError>(Kicked { kicks, torque })
        });
        let kicked = kicked.transpose()?;
        let (method, map, others) = Default::default();
        let breaks = Breaks::new(origin.map(Origin::breaks).unwrap_or_default());
        let motion =
            Self { space, grid, parameters, maker, method, kicked, map, others, origin, breaks };
        if motion.space.compiled.is_none() {
            motion.whole()?;
        }
        Ok(motion)
    }

    /// The group that the states belong to.
    pub(crate) fn space(&self) -> &Space {
        &self.space
    }

    /// The times between steps.
    pub(crate) fn grid(&self) -> Grid {
        self.grid
    }

    fn kicks(&self) -> Option<&'a Kicks> {
        self.kicked.as_ref().map(|own| own.kicks)
    }

    /// The method for these values of the parameters.
    fn method(&self) -> Result<&dyn Propagator<'a>, StepError> {
        if let Some(method) = self.method.get() {
            return Ok(&**method);
        }
        let made = (self.maker)(&self.parameters)?;
        Ok(&**self.method.get_or_init(|| made))
    }

    /// The step of this size by a method.
    fn map<'m>(&self, method: &dyn Propagator<'m>, size: f64) -> Result<Map<'m>, StepError> {
        let flow = |length| method.flow(&self.space.group, length, &self.parameters);
        let flows: Result<_, _> = lengths(self.kicks(), size).into_iter().map(flow).collect();
        Ok(Map { size, flows: flows? })
    }

    /// The step without programs.
    fn whole(&self) -> Result<&Map<'a>, StepError> {
        if let Some(map) = self.map.get() {
            return Ok(map);
        }
        let made = self.map(self.method()?, self.grid.step)?;
        Ok(self.map.get_or_init(|| made))
    }

    /// A step of this size without programs. The error of one that cannot be made names a size that works, if one is found.
    fn rescue(&self, state: &mut Numbers, time: f64, size: f64) -> Result<Solves, StepError> {
        let (kicked, phase) = (self.kicked.as_ref(), self.space.phase(state));
        let step = |phase: &mut Phase<Tables>, size: f64| match size == self.grid.step {
            true => self.whole()?.step(kicked, phase, time),
            false => self.map(self.method()?, size)?.step(kicked, phase, time),
        };
        let mut next = phase.clone();
        let solves = step(&mut next, size).map_err(|error| {
            advise(error, size, |shorter| step(&mut phase.clone(), shorter).is_ok())
        })?;
        *state = self.space.state(&next);
        if let Some(compiled) = &self.space.compiled {
            compiled.lose_work(state);
        }
        Ok(solves)
    }

    /// Makes one step of this size by the programs, if any, else without.
    fn alone(
        &self,
        compiled: Option<&Arc<Compiled>>,
        state: &mut Numbers,
        [time, size]: [f64; 2],
    ) -> Result<(), StepError> {
        match compiled.is_some_and(|own| own.one_at(state, time)) {
            true => Ok(()),
            false => self.rescue(state, time, size).map(drop),
        }
    }

    /// Makes `count` steps of a state that `first` steps from the start of the [grid](Motion::grid) have reached. The state
    /// that comes of them does not depend on how many are made at a time.
    ///
    /// # Errors
    /// Returns the number of steps made and the error of the next one; the state is then the one before it.
    pub(crate) fn advance(
        &self,
        state: &mut Numbers,
        first: u64,
        count: u64,
    ) -> Result<Solves, (u64, StepError)> {
        self.make(state, [first, count], true)
    }

    /// As [`advance`](Motion::advance), but steps that programs refuse are not made by other means, which take long.
    ///
    /// # Errors
    /// As [`advance`](Motion::advance), the error of such a step being of no use.
    pub(crate) fn advance_unrescued(
        &self,
        state: &mut Numbers,
        first: u64,
        count: u64,
    ) -> Result<(), (u64, StepError)> {
        self.make(state, [first, count], false).map(drop)
    }

    /// Makes steps that may contain breaks; by other means those that programs refuse, if they are to be rescued.
    fn make(
        &self,
        state: &mut Numbers,
        [first, count]: [u64; 2],
        rescued: bool,
    ) -> Result<Solves, (u64, StepError)> {
        let (mut total, mut done): (Solves, u64) = (None, 0);
        while done < count {
            let next = self.breaks.next(self.grid, first + done);
            let whole = next.map_or(count, |next| count.min(next - first)) - done;
            let made = match whole {
                0 => self.in_parts(state, first + done).map_err(|error| (done, error))?,
                _ => {
                    let made = self.undivided(state, [first + done, whole], rescued);
                    made.map_err(|(more, error)| (done + more, error))?
                }
            };
            done += whole.max(1);
            total = both(total, made);
        }
        Ok(total)
    }

    /// The first step of the grid from this one on that contains a break.
    pub(crate) fn divided(&self, first: u64) -> Option<u64> {
        self.breaks.next(self.grid, first)
    }

    /// Makes the step of this number, in parts that end at breaks.
    fn in_parts(&self, state: &mut Numbers, number: u64) -> Result<Solves, StepError> {
        *state = self.beside(state, self.grid.time(number), self.grid.step)?;
        if let Some(compiled) = &self.space.compiled {
            // The sizes of the parts differ, so that their rates do not extrapolate.
            compiled.forget(state);
        }
        Ok(self.space.compiled.is_some().then_some(Solved::one(0, f64::EPSILON)))
    }

    /// Makes `count` steps, none of which contains a break, after the first ones.
    fn undivided(
        &self,
        state: &mut Numbers,
        [first, count]: [u64; 2],
        rescued: bool,
    ) -> Result<Solves, (u64, StepError)> {
        if let Some(compiled) = &self.space.compiled {
            let rescue = |state: &mut Numbers, number| match rescued {
                true => self.rescue(state, self.grid.time(number), self.grid.step),
                false => Err(StepError::InvalidStep { step: f64::NAN }),
            };
            let made = compiled.advance(state, self.grid.start, [first, count], rescue)?;
            // A bound, which may be far below what rounding leaves.
            return Ok(Some(Solved { residual: made.residual.max(f64::EPSILON), ..made }));
        }
        one_by_one(first, count, |number| {
            let (time, mut phase) = (self.grid.time(number), self.space.phase(state));
            if let Some(solved) = self.method()?.go_on(&mut phase, time) {
                *state = self.space.state(&phase);
                return Ok(Some(solved));
            }
            self.rescue(state, time, self.grid.step)
        })
    }

    /// The state after one step of another size from this time.
    ///
    /// # Errors
    /// Fails if there is none.
    pub(crate) fn beside(
        &self,
        state: &Numbers,
        time: f64,
        size: f64,
    ) -> Result<Numbers, StepError> {
        let mut next = state.clone();
        for [time, size] in self.breaks.parts([time, size]) {
            let other = self.space.compiled.as_ref().map(|own| self.of_size(own, size));
            self.alone(other.transpose()?.as_ref(), &mut next, [time, size])?;
        }
        Ok(next)
    }

    /// The programs with the coefficients of another size.
    fn of_size(&self, own: &Arc<Compiled>, size: f64) -> Result<Arc<Compiled>, StepError> {
        // A thread that panicked has left whole programs, if any.
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        for known in &*others {
            if known.is_for(size, &self.parameters) {
                return Ok(known.clone());
            }
        }
        let made = own.anew(size, &self.parameters)?;
        others.push_front(made.clone());
        others.truncate(MOST_OTHERS);
        Ok(made)
    }

    /// Makes one step from this time, whatever steps were made before.
    ///
    /// # Errors
    /// Returns the reason for which there is none.
    pub(crate) fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError> {
        *state = self.beside(state, time, self.grid.step)?;
        Ok(())
    }

    /// The ratio of the last two terms of the series at a momentum, where it may be worth a warning; else 0.
    pub(crate) fn ratio(&self, mu: &[f64]) -> f64 {
        self.largest_ratio((mu, 1))
    }

    /// The largest ratio at momenta that lie side by side in this many lanes.
    pub(crate) fn largest_ratio(&self, momenta: (&[f64], usize)) -> f64 {
        let longer = |longest: f64, own: f64| if own.abs() > longest.abs() { own } else { longest };
        let flows = self.kicks().map(|kicks| kicks.splitting.flows().fold(0.0, longer));
        let longest = self.grid.step * flows.unwrap_or(1.0);
        let compiled = self.space.compiled.as_deref();
        let method = self.method();
        method.map_or(0.0, |own| own.ratio(compiled, longest, &self.parameters, momenta))
    }

    /// Advice beside that of an error, for a step from this time that this state refused.
    pub(crate) fn advice(
        &self,
        state: &Numbers,
        time: f64,
        error: &StepError,
    ) -> Option<&'static str> {
        if !error.asks_for_smaller_step() {
            return None;
        }
        let comoving = self.method().ok()?.comoving()?;
        let map = self.map(&*comoving, self.grid.step).ok()?;
        let made = map.step(self.kicked.as_ref(), &mut self.space.phase(state), time);
        made.is_ok().then_some(
            "; this step can be made in the comoving frame: [integrator] frame = \"comoving\"",
        )
    }

    /// Checks that the Hamiltonian and the torque of kicks are defined in a state of this time.
    ///
    /// # Errors
    /// The expression in them that is not.
    pub(crate) fn defined(&self, state: &Numbers, time: f64) -> Result<(), StepError> {
        self.method()?.defined(time, &|| self.space.phase(state), &state.mu)?;
        self.kicked.as_ref().map_or(Ok(()), |own| own.torque.defined(&self.space, state, time))
    }

    /// True if there are states in which something is not [`defined`](Motion::defined).
    pub(crate) fn may_be_undefined(&self) -> bool {
        self.kicked.is_some() || self.method().map_or(true, |method| method.may_be_undefined())
    }

    /// The programs that move many states side by side, where there are any.
    pub(crate) fn lanes(&self) -> Option<&Compiled> {
        self.space.compiled.as_deref()
    }

    /// The tangents of steps, of which about `steps` are going to be made. Learned maps, functions of the user's and systems too large for
    /// programs have none.
    ///
    /// # Errors
    /// Fails if a derivative of a coefficient is not finite.
    pub(crate) fn tangents(
        &self,
        backend: Backend,
        steps: f64,
    ) -> Result<Option<Tangents>, StepError> {
        match (self.origin, &self.space.compiled) {
            (Some(origin), Some(compiled)) => Tangents::new(compiled, origin, backend, steps),
            _ => Ok(None),
        }
    }

    /// The parts of the step of this number, which end at breaks: when each begins, and its size.
    pub(crate) fn parts(&self, number: u64) -> Vec<[f64; 2]> {
        self.parts_of([self.grid.time(number), self.grid.step])
    }

    /// The parts of a step of another size from a time.
    pub(crate) fn parts_of(&self, step: [f64; 2]) -> Vec<[f64; 2]> {
        self.breaks.parts(step)
    }

    /// The programs of parts of this size.
    fn of_part(&self, size: f64) -> Result<Option<Arc<Compiled>>, StepError> {
        let own = self.space.compiled.as_ref();
        own.map(|own| self.of_size(own, size)).transpose()
    }

    /// Makes one part of a step, whatever was made before.
    ///
    /// # Errors
    /// Returns the reason for which there is no step.
    pub(crate) fn part(
        &self,
        state: &mut Numbers,
        [time, size]: [f64; 2],
    ) -> Result<(), StepError> {
        self.alone(self.of_part(size)?.as_ref(), state, [time, size])
    }

    /// The values of inputs that a part of a step reads.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub(crate) fn read(&self, [time, size]: [f64; 2]) -> Result<Vec<Read>, StepError> {
        let compiled = self.of_part(size)?;
        Ok(compiled.map_or_else(Vec::new, |own| Carried::read(&own, time)))
    }

    /// Makes one part of a step, whatever was made before, with tangents; false where its programs do not find it.
    ///
    /// # Errors
    /// Returns the reason for which there is no step.
    pub(crate) fn carry_part(
        &self,
        carried: &mut Carried<'_>,
        [time, size]: [f64; 2],
    ) -> Result<bool, StepError> {
        let Some(compiled) = self.of_part(size)? else { return Ok(false) };
        if carried.part(&compiled, time)? {
            return Ok(true);
        }
        let mut next = carried.state.clone();
        self.alone(Some(&compiled), &mut next, [time, size])?;
        carried.refused(&compiled, time, next)
    }

    /// Makes `count` steps of a state with tangents that `first` steps from the start of the grid have reached; the number of those made
    /// before one that has no derivative. `changes` are those of the values of inputs that a step reads.
    ///
    /// # Errors
    /// As [`Motion::advance`].
    pub(crate) fn carry(
        &self,
        carried: &mut Carried<'_>,
        [first, count]: [u64; 2],
        changes: Option<&Reading<'_>>,
    ) -> Result<u64, (u64, StepError)> {
        let Some(compiled) = &self.space.compiled else { return Ok(0) };
        let mut done = 0;
        while done < count {
            let (number, failed) = (first + done, move |error| (done, error));
            let next = self.breaks.next(self.grid, number);
            let whole = next.map_or(count - done, |next| (count - done).min(next - number));
            let time = self.grid.time(number);
            if let Some(changes) = changes.filter(|_| whole > 0) {
                carried.reading(&changes(&Carried::read(compiled, time)));
            }
            let made = carried.advance(compiled, time, whole).map_err(failed)?;
            done += made;
            if made > 0 {
                continue;
            }
            for part in self.parts(number) {
                if whole == 0 {
                    compiled.forget(&mut carried.state);
                }
                if let Some(changes) = changes {
                    carried.reading(&changes(&self.read(part).map_err(failed)?));
                }
                if !self.carry_part(carried, part).map_err(failed)? {
                    return Ok(done);
                }
            }
            if whole == 0 {
                compiled.forget(&mut carried.state);
            }
            done += 1;
        }
        Ok(done)
    }

    /// Takes these values of the parameters, and what its programs read for them, where it has any. Steps made before are
    /// forgotten.
    pub(crate) fn vary(&mut self, parameters: &[f64], folded: Option<Folded>) {
        self.parameters.clear();
        self.parameters.extend_from_slice(parameters);
        if !self.method.get_mut().is_some_and(|method| method.forgets()) {
            self.method = OnceLock::new();
        }
        if let Some(kicked) = &mut self.kicked {
            kicked.torque.vary(parameters);
        }
        // These are of other values.
        self.map = OnceLock::new();
        self.others.get_mut().unwrap_or_else(PoisonError::into_inner).clear();
        if let (Some(compiled), Some(folded)) = (&mut self.space.compiled, folded) {
            Arc::make_mut(compiled).with(folded);
        }
    }
}

/// Makes steps one by one with `step`, which is given the number of steps before it, and leaves a state that it cannot move as it is.
///
/// # Errors
/// As [`Motion::advance`].
fn one_by_one(
    first: u64,
    count: u64,
    mut step: impl FnMut(u64) -> Result<Solves, StepError>,
) -> Result<Solves, (u64, StepError)> {
    let mut total: Solves = None;
    for made in 0..count {
        let solved = step(first + made).map_err(|error| (made, error))?;
        total = both(total, solved);
    }
    Ok(total)
}

/// The solves of steps and of those after them.
fn both(total: Solves, solved: Solves) -> Solves {
    match (total, solved) {
        (Some(total), Some(solved)) => Some(total.with(solved)),
        (total, solved) => total.or(solved),
    }
}
