//! A potential run by the interpreter, and its kicks between flows.

use std::sync::Arc;

use coadjoint::{LieGroup, Phase, Scalar, StepError};
use coadjoint_codegen::integrator::{FoldTable, Kick};
use coadjoint_codegen::potential::Force;
use nalgebra::DVector;

use super::compiled::{Numbers, refusal};
use super::space::{Space, Tables, entries_of};
use crate::error::kept;

/// The elements of the groups known at run time.
type Element = <Tables as LieGroup>::Element;

/// The body torque −g⁻¹dV(g) of a potential, on a run-time group.
#[derive(Debug)]
pub(crate) struct Torque<'a> {
    kick: &'a Kick,
    group: Arc<Tables>,
    slots: Vec<f64>,
}

impl<'a> Torque<'a> {
    /// Folds the coefficients for these values of the parameters that are kept.
    pub(crate) fn new(
        kick: &'a Kick,
        group: &Arc<Tables>,
        parameters: &[f64],
    ) -> Result<Self, StepError> {
        let symbols = kick.potential.symbols.iter();
        let symbols: Vec<f64> = symbols.map(|symbol| symbol.expr.evaluate(parameters)).collect();
        // No coefficient holds the step size.
        let slots = FoldTable::of_kick(kick).fold(1.0, &symbols);
        let slots = slots.map_err(|error| refusal(error, 1.0, &symbols))?;
        Ok(Self { kick, group: group.clone(), slots })
    }

    /// Changes the values; kicks are refused if a coefficient is not finite for them.
    pub(super) fn vary(&mut self, parameters: &[f64]) {
        let varied = Self::new(self.kick, &self.group, parameters).map(|new| new.slots);
        self.slots = varied.unwrap_or_else(|_| vec![f64::NAN; self.slots.len()]);
    }

    /// The torque at g, for messages at this time.
    ///
    /// # Errors
    /// Fails if an expression in it is not defined.
    pub(crate) fn torque(&self, g: &Element, time: f64) -> Result<DVector<f64>, StepError> {
        let entries = entries_of(&self.group, g);
        let torque = DVector::from_vec(self.kick.torque.run(&entries, &self.slots));
        let Force::Smooth(programs) = &self.kick.potential.force else { return Ok(torque) };
        if torque.iter().all(|entry| entry.is_finite()) {
            return Ok(torque);
        }
        let undefined = programs.undefined(&entries, &self.slots);
        Err(undefined.map_or(StepError::NonFiniteState, |(expression, argument)| {
            StepError::Undefined { expression: kept(expression), argument, time, at: None }
        }))
    }

    /// Checks that it is defined in a state of this time.
    ///
    /// # Errors
    /// As [`Torque::torque`].
    pub(super) fn defined(
        &self,
        space: &Space,
        state: &Numbers,
        time: f64,
    ) -> Result<(), StepError> {
        // A polynomial is defined everywhere.
        if matches!(self.kick.potential.force, Force::Polynomial(_)) {
            return Ok(());
        }
        self.torque(&space.phase(state).group_element, time).map(drop)
    }

    /// A kick of this length.
    ///
    /// # Errors
    /// As [`Torque::torque`].
    pub(crate) fn kick(
        &self,
        state: &mut Phase<Tables>,
        time: f64,
        length: f64,
    ) -> Result<(), StepError> {
        let torque = self.torque(&state.group_element, time)?;
        state.momentum =
            torque.zip_map(&state.momentum, |torque, mu| torque.times_plus(length, mu));
        Ok(())
    }
}
