//! A potential run by the interpreter, and its kicks between flows: what programs refuse, and what has none.

use coadjoint::groups::Chart;
use coadjoint::steps::{Flows, advance};
use coadjoint::{Phase, Scalar, StepError};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::integrator::{FoldTable, Integrator, Kick, Kicks};
use coadjoint_codegen::potential::Force;
use nalgebra::{DMatrix, DVector};

use super::compiled::{Solved, Solves, refusal};
use super::interpreter::Interpreter;
use super::space::{Group, entries_of};
use crate::error::kept;

/// Makes a step of a state from this time.
pub(crate) type Map<'a, G> =
    Box<dyn Fn(&mut Phase<G>, f64) -> Result<Solves, StepError> + Send + Sync + 'a>;

/// The step of this size by the generic solver: a flow, or flows and kicks. It serves where programs refuse a step, and
/// where a system has none.
pub(crate) fn map<'a, G: Group + 'a, C: Chart<G> + Send + Sync + 'a>(
    integrator: &'a Integrator,
    group: &G,
    size: f64,
    parameters: &[f64],
) -> Result<Map<'a, G>, StepError> {
    let flow = |part| Interpreter::<G, C>::new(integrator, group.clone(), part, parameters);
    let Some(Kicks { kick, splitting, .. }) = &integrator.kicks else {
        let step = flow(size)?;
        return Ok(Box::new(move |phase, _| {
            let report = advance(&step, phase)?;
            Ok(Some(Solved::one(report.iterations, report.residual)))
        }));
    };
    let torque = Torque::new(kick, group.clone(), parameters)?;
    let flows = Flows::new(*splitting, size, flow)?;
    Ok(Box::new(move |phase, time| {
        let kick = |state: &mut _, time, length| torque.kick(state, time, length);
        flows.advance(phase, time, kick).map(|()| None)
    }))
}

/// The longest flow of a step, as a share of it.
pub(crate) fn longest_flow(kicks: &Kicks) -> f64 {
    let longer = |longest: f64, part: f64| if part.abs() > longest.abs() { part } else { longest };
    kicks.splitting.flows().fold(0.0, longer)
}

/// The body torque −g⁻¹dV(g) of a potential, or one without, on a run-time group.
#[derive(Debug)]
pub(crate) struct Torque<'a, G> {
    kick: &'a Kick,
    group: G,
    slots: Vec<f64>,
}

impl<'a, G: Group> Torque<'a, G> {
    /// Folds the coefficients for these values of the parameters that are kept.
    pub(crate) fn new(kick: &'a Kick, group: G, parameters: &[f64]) -> Result<Self, StepError> {
        let symbols = kick.potential.symbols.iter();
        let symbols: Vec<f64> = symbols.map(|symbol| symbol.expr.evaluate(parameters)).collect();
        // No coefficient holds the step size.
        let slots = FoldTable::of_kick(kick).fold(1.0, &symbols);
        let slots = slots.map_err(|error| refusal(error, 1.0, &symbols))?;
        Ok(Self { kick, group, slots })
    }

    /// Changes the values; kicks are refused if a coefficient is not finite for them.
    pub(super) fn vary(&mut self, parameters: &[f64]) {
        let varied = Self::new(self.kick, self.group.clone(), parameters).map(|new| new.slots);
        self.slots = varied.unwrap_or_else(|_| vec![f64::NAN; self.slots.len()]);
    }

    /// The torque in a state at this time.
    ///
    /// # Errors
    /// Fails if an expression in it is not defined.
    pub(crate) fn torque(
        &self,
        g: &G::Element,
        mu: &DVector<f64>,
        time: f64,
    ) -> Result<DVector<f64>, StepError> {
        let entries = entries_of(&self.group, g);
        let Force::Smooth(programs) = &self.kick.potential.force else {
            return Ok(DVector::from_vec(self.kick.torque.run(&entries, &self.slots)));
        };
        let inputs = programs.inputs(&entries, mu.as_slice(), time);
        let torque = DVector::from_vec(self.kick.torque.run(&inputs, &self.slots));
        if torque.iter().all(|entry| entry.is_finite()) {
            return Ok(torque);
        }
        let undefined = programs.undefined(&inputs, &self.slots);
        Err(undefined.map_or(StepError::NonFiniteState, |(expression, argument)| {
            StepError::Undefined { expression: kept(expression), argument, time, at: None }
        }))
    }

    /// Checks that it is defined in a state of this time.
    ///
    /// # Errors
    /// As [`Torque::torque`].
    pub(super) fn defined(&self, state: &Phase<G>, time: f64) -> Result<(), StepError> {
        self.torque(&state.group_element, &state.momentum, time).map(drop)
    }

    /// A kick of this length; where the torque depends on μ, that of its value in the middle.
    ///
    /// # Errors
    /// As [`Torque::torque`].
    pub(crate) fn kick(
        &self,
        state: &mut Phase<G>,
        time: f64,
        length: f64,
    ) -> Result<(), StepError> {
        let Phase { group_element, momentum } = state;
        let kicked = |torque: &DVector<f64>, length| {
            torque.zip_map(momentum, |torque, mu| torque.times_plus(length, mu))
        };
        let mut torque = self.torque(group_element, momentum, time)?;
        if self.kick.potential.alone().is_some_and(|torque| torque.of_momentum) {
            torque = self.torque(group_element, &kicked(&torque, 0.5 * length), time)?;
        }
        *momentum = kicked(&torque, length);
        Ok(())
    }

    /// The changes g ξ of the entries of g, for each of these matrices ξ.
    pub(super) fn moved(&self, g: &G::Element, generators: &[DMatrix<f64>]) -> Vec<Vec<f64>> {
        let (entries, size) = (entries_of(&self.group, g), self.group.matrix_size());
        let element = DMatrix::from_row_slice(size, size, &entries);
        // Row by row.
        let moved =
            |generator: &DMatrix<f64>| (&element * generator).transpose().as_slice().to_vec();
        generators.iter().map(moved).collect()
    }

    /// A derivative of the torque of a potential at g, by its program, along this change.
    pub(super) fn along(&self, program: &Program, g: &G::Element, change: &[f64]) -> DVector<f64> {
        let inputs = [&entries_of(&self.group, g)[..], change].concat();
        DVector::from_vec(program.run(&inputs, &self.slots))
    }
}
