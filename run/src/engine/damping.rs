//! Half a step of damping before and after each step, whatever makes these.

use std::sync::Arc;

use coadjoint::collocation::Damping;
use coadjoint::{Phase, StepError};
use coadjoint_codegen::step::Origin;
use nalgebra::DVector;

use super::collocation::{Group, Interpreted};
use super::compiled::{Folded, Numbers, Solves};
use super::kick::Torque;
use super::motion::{Motion, Varied, advise, one_by_one};
use super::space::{Space, entries_of, phase_of};
use crate::grid::Grid;

/// Moves a state by a step of damping from this time, of this length.
type Damp<'a> =
    Box<dyn Fn(&mut Phase<Group>, f64, f64) -> Result<(), StepError> + Send + Sync + 'a>;

/// Damping by the double bracket.
#[derive(Clone, Debug)]
pub(crate) struct Damper {
    /// The diagonal of Γ.
    pub rates: Vec<f64>,
    /// The group.
    pub group: Arc<Group>,
}

/// Steps between halves of damping.
pub(crate) struct Damped<'a> {
    motion: Box<dyn Varied + 'a>,
    damper: &'a Damper,
    origin: &'a Origin,
    damp: Result<Damp<'a>, StepError>,
}

impl<'a> Damped<'a> {
    /// These steps of this system between halves of damping, for these values of the parameters that are kept.
    pub(crate) fn new(
        motion: Box<dyn Varied + 'a>,
        damper: &'a Damper,
        origin: &'a Origin,
        parameters: &[f64],
    ) -> Self {
        let damp = damp(damper, origin, parameters);
        Self { motion, damper, origin, damp }
    }

    /// `step` from this time, of this size, between halves of damping.
    fn around<T>(
        &self,
        state: &mut Numbers,
        [time, size]: [f64; 2],
        step: impl FnOnce(&mut Numbers) -> Result<T, StepError>,
    ) -> Result<T, StepError> {
        let mut next = state.clone();
        self.half(&mut next, time, size)?;
        let made = step(&mut next)?;
        self.half(&mut next, time + size, size)?;
        *state = next;
        Ok(made)
    }

    /// Half of the damping of a step of this size.
    fn half(&self, state: &mut Numbers, time: f64, size: f64) -> Result<(), StepError> {
        let damp = self.damp.as_ref().map_err(|error| *error)?;
        let (group, space) = (&*self.damper.group, self.motion.space());
        let mut phase = phase_of(group, &space.matrix(&state.g), &state.mu);
        damp(&mut phase, time, 0.5 * size).map_err(|error| {
            advise(error, size, |size| damp(&mut phase.clone(), time, 0.5 * size).is_ok())
        })?;
        let g = space.numbers(&entries_of(group, &phase.group_element));
        *state = Numbers { g, mu: phase.momentum.as_slice().to_vec() };
        Ok(())
    }
}

/// The damping of this Hamiltonian and of the potential of kicks: the mean slope of H is that in the middle where it is quadratic.
fn damp<'a>(
    damper: &Damper,
    origin: &'a Origin,
    parameters: &[f64],
) -> Result<Damp<'a>, StepError> {
    let (group, energy) = ((*damper.group).clone(), Interpreted::new(origin.energy(parameters)));
    let rates = DVector::from_column_slice(&damper.rates);
    // A torque without potential has no energy that could fall.
    let kick = origin.kicks().map(|kicks| &kicks.kick);
    let kick = kick.filter(|kick| kick.potential.alone().is_none());
    let torque = kick.map(|kick| Torque::new(kick, group.clone(), parameters)).transpose()?;
    if origin.series().is_some_and(|series| series.problem.is_quadratic()) {
        return Ok(damp_by(Damping::<_, _, 1>::new(group, energy, rates)?, torque));
    }
    Ok(damp_by(Damping::<_, _, 8>::new(group, energy, rates)?, torque))
}

/// The damping beside the torque of a potential, if there is one.
fn damp_by<'a, const M: usize>(
    damping: Damping<Group, Interpreted<'a>, M>,
    torque: Option<Torque<'a, Group>>,
) -> Damp<'a> {
    Box::new(move |phase, time, length| {
        let Some(torque) = &torque else { return damping.advance(phase, time, length).map(drop) };
        let mu = phase.momentum.clone();
        damping.advance_beside(phase, time, length, |g| torque.torque(g, &mu, time)).map(drop)
    })
}

impl Motion for Damped<'_> {
    fn space(&self) -> &dyn Space {
        self.motion.space()
    }

    fn grid(&self) -> Grid {
        self.motion.grid()
    }

    fn advance(
        &self,
        state: &mut Numbers,
        first: u64,
        count: u64,
    ) -> Result<Solves, (u64, StepError)> {
        let mut number = first;
        one_by_one(count, || {
            let place = [self.grid().time(number), self.grid().step];
            let solved = self.around(state, place, |state| {
                self.motion.advance(state, number, 1).map_err(|(_, error)| error)
            });
            number += 1;
            solved
        })
    }

    fn beside(&self, state: &Numbers, time: f64, size: f64) -> Result<Numbers, StepError> {
        let mut next = state.clone();
        self.around(&mut next, [time, size], |state| {
            *state = self.motion.beside(state, time, size)?;
            Ok(())
        })?;
        Ok(next)
    }

    fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError> {
        self.around(state, [time, self.grid().step], |state| self.motion.one_at(state, time))
    }

    fn ratios(&self, momenta: &[&[f64]]) -> Vec<f64> {
        self.motion.ratios(momenta)
    }

    fn defined(&self, state: &Numbers, time: f64) -> Result<(), StepError> {
        self.motion.defined(state, time)
    }
}

impl Varied for Damped<'_> {
    fn vary(&mut self, parameters: &[f64], folded: Option<Folded>) {
        self.motion.vary(parameters, folded);
        self.damp = damp(self.damper, self.origin, parameters);
    }
}
