//! Half a step of damping before and after each step, whatever makes these.

use std::sync::Arc;

use coadjoint::collocation::Damping;
use coadjoint::{Phase, StepError};
use coadjoint_codegen::step::Origin;
use nalgebra::DVector;

use super::collocation::Interpreted;
use super::compiled::Numbers;
use super::kick::Torque;
use super::method::advise;
use super::space::{Space, Tables};

/// Moves a state by a step of damping from this time, of this length.
type Damp<'a> =
    Box<dyn Fn(&mut Phase<Tables>, f64, f64) -> Result<(), StepError> + Send + Sync + 'a>;

/// Damping by the double bracket before and after each step.
pub(super) struct Damped<'a> {
    /// The diagonal of Γ.
    rates: &'a [f64],
    origin: &'a Origin,
    damp: Result<Damp<'a>, StepError>,
}

impl<'a> Damped<'a> {
    /// The damping of this system, for these values of the parameters that are kept.
    pub(super) fn new(
        rates: &'a [f64],
        origin: &'a Origin,
        group: &Arc<Tables>,
        parameters: &[f64],
    ) -> Self {
        Self { rates, origin, damp: damp(rates, origin, group, parameters) }
    }

    /// Takes other values of the parameters.
    pub(super) fn vary(&mut self, group: &Arc<Tables>, parameters: &[f64]) {
        self.damp = damp(self.rates, self.origin, group, parameters);
    }

    /// `step` from this time, of this size, between halves of damping.
    pub(super) fn around<T>(
        &self,
        space: &Space,
        state: &mut Numbers,
        [time, size]: [f64; 2],
        step: impl FnOnce(&mut Numbers) -> Result<T, StepError>,
    ) -> Result<T, StepError> {
        let mut next = state.clone();
        self.half(space, &mut next, time, size)?;
        let made = step(&mut next)?;
        self.half(space, &mut next, time + size, size)?;
        *state = next;
        Ok(made)
    }

    /// Half of the damping of a step of this size.
    fn half(
        &self,
        space: &Space,
        state: &mut Numbers,
        time: f64,
        size: f64,
    ) -> Result<(), StepError> {
        let damp = self.damp.as_ref().map_err(|error| *error)?;
        let mut phase = space.phase(state);
        damp(&mut phase, time, 0.5 * size).map_err(|error| {
            advise(error, size, |size| damp(&mut phase.clone(), time, 0.5 * size).is_ok())
        })?;
        *state = space.state(&phase);
        Ok(())
    }
}

/// The damping of this Hamiltonian and of the potential of kicks: the mean slope of H is that in the middle where it is quadratic.
fn damp<'a>(
    rates: &[f64],
    origin: &'a Origin,
    group: &Arc<Tables>,
    parameters: &[f64],
) -> Result<Damp<'a>, StepError> {
    let energy = Interpreted::new(origin.energy(parameters));
    let rates = DVector::from_column_slice(rates);
    // A torque without potential has no energy that could fall.
    let kick = origin.kicks().map(|kicks| &kicks.kick);
    let kick = kick.filter(|kick| kick.potential.alone().is_none());
    let torque = kick.map(|kick| Torque::new(kick, group, parameters)).transpose()?;
    let group = (**group).clone();
    if origin.series().is_some_and(|series| series.problem.is_quadratic()) {
        return Ok(damp_by(Damping::<_, _, 1>::new(group, energy, rates)?, torque));
    }
    Ok(damp_by(Damping::<_, _, 8>::new(group, energy, rates)?, torque))
}

/// The damping beside the torque of a potential, if there is one.
fn damp_by<'a, const M: usize>(
    damping: Damping<Tables, Interpreted<'a>, M>,
    torque: Option<Torque<'a>>,
) -> Damp<'a> {
    Box::new(move |phase, time, length| {
        let Some(torque) = &torque else { return damping.advance(phase, time, length).map(drop) };
        let mu = phase.momentum.clone();
        damping.advance_beside(phase, time, length, |g| torque.torque(g, &mu, time)).map(drop)
    })
}
