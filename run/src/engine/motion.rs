//! Steps of one size, whatever makes them.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coadjoint::steps::{Piece, Splitting, compose};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::integrator::Kicks;

use super::compiled::{Compiled, Folded, Numbers, Solved, Solves};
use super::kick::{KickSlope, Torque};
use super::linear::Linear;
use super::method::{Flow, Method, Slope, advise};
use super::space::{Space, Tables};
use crate::grid::Grid;

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

/// Moves states by steps of one size: by programs where there are any, else by its [`Method`], which also makes the steps that
/// programs refuse.
pub(crate) struct Motion<'a> {
    space: Space,
    grid: Grid,
    /// The values of the parameters that are kept.
    parameters: Vec<f64>,
    method: Box<dyn Method<'a> + 'a>,
    kicked: Option<Kicked<'a>>,
    /// The step without programs, once one was needed.
    map: OnceLock<Map<'a>>,
    /// The programs of the step of another size that was made last.
    other: Mutex<Option<Arc<Compiled>>>,
    /// The derivatives of flows and kicks, once they were asked for.
    slopes: OnceLock<(Vec<Slope<'a>>, Option<KickSlope<'a>>)>,
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
        method: Box<dyn Method<'a> + 'a>,
        kicks: Option<&'a Kicks>,
    ) -> Result<Self, StepError> {
        let kicked = kicks.map(|kicks| {
            let torque = Torque::new(&kicks.kick, &space.group, &parameters)?;
            Ok::<_, StepError>(Kicked { kicks, torque })
        });
        let kicked = kicked.transpose()?;
        let (map, other, slopes) = Default::default();
        let motion = Self { space, grid, parameters, method, kicked, map, other, slopes };
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

    /// The step of this size by a method.
    fn map<'m>(&self, method: &dyn Method<'m>, size: f64) -> Result<Map<'m>, StepError> {
        let flow = |length| method.flow(&self.space.group, length, &self.parameters);
        let flows: Result<_, _> = lengths(self.kicks(), size).into_iter().map(flow).collect();
        Ok(Map { size, flows: flows? })
    }

    /// The step without programs.
    fn whole(&self) -> Result<&Map<'a>, StepError> {
        if let Some(map) = self.map.get() {
            return Ok(map);
        }
        let made = self.map(&*self.method, self.grid.step)?;
        Ok(self.map.get_or_init(|| made))
    }

    /// A step of this size without programs. The error of one that cannot be made names a size that works.
    fn rescue(&self, state: &mut Numbers, time: f64, size: f64) -> Result<Solves, StepError> {
        let (kicked, phase) = (self.kicked.as_ref(), self.space.phase(state));
        let step = |phase: &mut Phase<Tables>, size: f64| match size == self.grid.step {
            true => self.whole()?.step(kicked, phase, time),
            false => self.map(&*self.method, size)?.step(kicked, phase, time),
        };
        let mut next = phase.clone();
        let solves = step(&mut next, size).map_err(|error| {
            advise(error, size, |shorter| step(&mut phase.clone(), shorter).is_ok())
        })?;
        *state = self.space.state(&next);
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
        if let Some(compiled) = &self.space.compiled {
            let rescue = |state: &mut Numbers, number| {
                self.rescue(state, self.grid.time(number), self.grid.step)
            };
            let made = compiled.advance(state, self.grid.start, [first, count], rescue)?;
            // A bound, which may be far below what rounding leaves.
            return Ok(Some(Solved { residual: made.residual.max(f64::EPSILON), ..made }));
        }
        one_by_one(first, count, |number| {
            let (time, mut phase) = (self.grid.time(number), self.space.phase(state));
            if let Some(solved) = self.method.go_on(&mut phase, time) {
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
        let other = self.space.compiled.as_ref().map(|own| {
            // A thread that panicked has left whole programs, if any.
            let mut other = self.other.lock().unwrap_or_else(PoisonError::into_inner);
            let found = other.as_ref().unwrap_or(own).anew(size, &self.parameters)?;
            Ok::<_, StepError>(other.insert(found).clone())
        });
        self.alone(other.transpose()?.as_ref(), &mut next, [time, size])?;
        Ok(next)
    }

    /// Makes one step from this time, whatever steps were made before.
    ///
    /// # Errors
    /// Returns the reason for which there is none.
    pub(crate) fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError> {
        self.alone(self.space.compiled.as_ref(), state, [time, self.grid.step])
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
        self.method.ratio(compiled, longest, &self.parameters, momenta)
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
        let comoving = self.method.comoving()?;
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
        self.method.defined(time, &|| self.space.phase(state), &state.mu)?;
        self.kicked.as_ref().map_or(Ok(()), |own| own.torque.defined(&self.space, state, time))
    }

    /// True if there are states in which something is not [`defined`](Motion::defined).
    pub(crate) fn may_be_undefined(&self) -> bool {
        self.kicked.is_some() || self.method.may_be_undefined()
    }

    /// The programs that move many states side by side, where there are any.
    pub(crate) fn lanes(&self) -> Option<&Compiled> {
        self.space.compiled.as_deref()
    }

    /// q, the number of parameters that derivatives are taken in; none where the derivatives of steps are not known, as those of
    /// a velocity or a torque.
    pub(crate) fn differentiable(&self) -> Option<usize> {
        self.method.is_differentiable().then_some(self.parameters.len())
    }

    /// The derivative of the next step of a state that `first` steps from the start of the grid have reached.
    ///
    /// # Errors
    /// Fails if there is no step.
    pub(crate) fn linear(&self, state: &Numbers, first: u64) -> Result<Linear, StepError> {
        let (group, size) = (&self.space.group, self.grid.step);
        let (flows, kick) = match self.slopes.get() {
            Some(slopes) => slopes,
            None => {
                let lengths = lengths(self.kicks(), size);
                let flows = self.method.slopes(group, &lengths, &self.parameters)?;
                let kick =
                    self.kicks().map(|own| KickSlope::new(&own.kick, group, &self.parameters));
                let made = (flows, kick.transpose()?);
                self.slopes.get_or_init(|| made)
            }
        };
        let (mut phase, time) = (self.space.phase(state), self.grid.time(first));
        let mut total = Linear::identity(phase.momentum.len(), self.parameters.len());
        let (Some(kicks), Some(kick)) = (self.kicks(), kick) else {
            return flows.first().map_or(Ok(total), |flow| flow(&mut phase, time));
        };
        compose(kicks.splitting, &mut phase, [time, size], |piece, phase, time, length| {
            let next = match piece {
                Piece::Kick => kick.linear(phase, [time, length])?,
                Piece::Flow(number) => flows[number](phase, time)?,
            };
            total = total.then(&next);
            Ok(())
        })?;
        Ok(total)
    }

    /// Takes these values of the parameters, and what its programs read for them, where it has any. Steps made before are
    /// forgotten.
    pub(crate) fn vary(&mut self, parameters: &[f64], folded: Option<Folded>) {
        self.parameters.clear();
        self.parameters.extend_from_slice(parameters);
        self.method.vary(parameters);
        if let Some(kicked) = &mut self.kicked {
            kicked.torque.vary(parameters);
        }
        // These are of other values.
        (self.map, self.slopes) = Default::default();
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
        total = match (total, solved) {
            (Some(total), Some(solved)) => Some(total.with(solved)),
            (total, solved) => total.or(solved),
        };
    }
    Ok(total)
}
