//! A potential run by the interpreter, its kicks between flows, and their derivatives.

use std::sync::Arc;

use coadjoint::{LieGroup, Phase, Scalar, StepError};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::integrator::{FoldTable, Kick};
use coadjoint_codegen::lie::RationalMatrix;
use coadjoint_codegen::potential::Force;
use coadjoint_program::Argument;
use nalgebra::{DMatrix, DVector};
use num_traits::ToPrimitive;

use super::compiled::{Numbers, refusal};
use super::linear::{Linear, matrix, push_forward};
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

    /// The changes g ξ of the entries of g, for each of these matrices ξ.
    pub(super) fn moved(&self, g: &Element, generators: &[DMatrix<f64>]) -> Vec<Vec<f64>> {
        let (entries, size) = (entries_of(&self.group, g), self.group.matrix_size());
        let element = DMatrix::from_row_slice(size, size, &entries);
        // Row by row.
        let moved =
            |generator: &DMatrix<f64>| (&element * generator).transpose().as_slice().to_vec();
        generators.iter().map(moved).collect()
    }

    /// A derivative of the torque of a potential at g, by its program, along this change.
    pub(super) fn along(&self, program: &Program, g: &Element, change: &[f64]) -> DVector<f64> {
        let inputs = [&entries_of(&self.group, g)[..], change].concat();
        DVector::from_vec(program.run(&inputs, &self.slots))
    }
}

/// The derivatives of kicks.
pub(super) struct KickSlope<'a> {
    torque: Torque<'a>,
    /// Entries of g, their change ↦ the change of the torque.
    by_element: Program,
    /// Entries of g, the change of the coefficients ↦ the change of the torque.
    by_coefficients: Program,
    /// The matrices of the algebra's basis.
    generators: Vec<DMatrix<f64>>,
    /// The derivatives of the coefficients in each parameter.
    slopes: Vec<Vec<f64>>,
}

impl<'a> KickSlope<'a> {
    /// For these values of the parameters.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub(super) fn new(
        kick: &'a Kick,
        group: &Arc<Tables>,
        parameters: &[f64],
    ) -> Result<Self, StepError> {
        let torque = Torque::new(kick, group, parameters)?;
        let generator = |matrix: &RationalMatrix| {
            DMatrix::from_fn(matrix.rows(), matrix.columns(), |i, j| {
                matrix.get(i, j).to_f64().unwrap_or(f64::NAN)
            })
        };
        let generators = kick.potential.algebra.matrices().iter().map(generator).collect();
        let coefficients = 0..kick.coefficients.slots().len();
        let coefficients: Vec<Argument> = coefficients.map(Argument::Slot).collect();
        let by_coefficients = kick.torque.push_forward(&coefficients);
        let symbols = &kick.potential.symbols;
        let values: Vec<f64> = symbols.iter().map(|one| one.expr.evaluate(parameters)).collect();
        let table = FoldTable::of_kick(kick);
        let slope = |number: usize| {
            let mut change = vec![0.0; parameters.len()];
            change[number] = 1.0;
            let change = symbols.iter().map(|symbol| symbol.expr.slope(parameters, &change));
            let change: Vec<f64> = change.collect();
            let slope = table.slope(1.0, &values, &change);
            slope.map_err(|error| refusal(error, 1.0, &change))
        };
        let slopes = (0..parameters.len()).map(slope).collect::<Result<_, _>>()?;
        let by_element = push_forward(&kick.torque);
        Ok(Self { torque, by_element, by_coefficients, generators, slopes })
    }

    /// Makes a kick at this time, of this length; its derivative.
    ///
    /// # Errors
    /// Fails if the torque is not defined.
    pub(super) fn linear(
        &self,
        phase: &mut Phase<Tables>,
        [time, length]: [f64; 2],
    ) -> Result<Linear, StepError> {
        let (g, dim) = (&phase.group_element, phase.momentum.len());
        let moved = self.torque.moved(g, &self.generators);
        let by_element = moved.iter().map(|change| self.torque.along(&self.by_element, g, change));
        let by_element = matrix(dim, by_element);
        let slopes = self.slopes.iter();
        let by_parameters =
            slopes.map(|change| self.torque.along(&self.by_coefficients, g, change));
        let by_parameters = matrix(dim, by_parameters);
        let torque = self.torque.torque(g, time)?;
        phase.momentum += torque * length;
        Ok(Linear::of_kick(&(by_element * length), &(by_parameters * length)))
    }
}
