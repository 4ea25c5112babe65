//! The derivatives of steps of a series: of their flows, kicks and frames.

use coadjoint::groups::{Chart, Exponential};
use coadjoint::solve::solve;
use coadjoint::steps::{Piece, Splitting, compose};
use coadjoint::{GeneratingFunction, Phase, StepError};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::integrator::{FoldTable, Integrator, Kick, Kicks};
use coadjoint_codegen::lie::RationalMatrix;
use coadjoint_program::Argument;
use nalgebra::{DMatrix, DVector};
use num_traits::ToPrimitive;

use super::compiled::refusal;
use super::interpreter::Interpreter;
use super::kick::Torque;
use super::linear::{Linear, columns};
use super::space::Group;

/// The parts of a step of one size, with what their derivatives need.
pub(crate) struct Tangent<'a, G, C> {
    flows: Vec<Flow<'a, G, C>>,
    /// For steps with kicks: their composition with flows, the size of a step, and the derivatives of kicks.
    kicks: Option<(Splitting, f64, KickSlope<'a, G>)>,
    /// p, v ↦ S_pp v.
    hessian: Program,
    /// For each motion of a comoving frame μ, v ↦ ∂y/∂μ v.
    frame: Vec<Program>,
}

/// A flow and, since its programs are linear in their coefficients, its derivative in each parameter.
struct Flow<'a, G, C> {
    function: Interpreter<'a, G, C>,
    by_parameters: Vec<Interpreter<'a, G, C>>,
}

/// The derivatives of kicks.
pub(super) struct KickSlope<'a, G> {
    torque: Torque<'a, G>,
    /// Entries of g, their change ↦ the change of the torque.
    by_element: Program,
    /// Entries of g, the change of the coefficients ↦ the change of the torque.
    by_coefficients: Program,
    /// The matrices of the algebra's basis.
    generators: Vec<DMatrix<f64>>,
    /// The derivatives of the coefficients in each parameter.
    slopes: Vec<Vec<f64>>,
}

/// The derivative of a program in all of its inputs.
fn push_forward(program: &Program) -> Program {
    let inputs: Vec<Argument> = (0..program.inputs()).map(Argument::Input).collect();
    program.push_forward(&inputs)
}

/// A matrix of `dim` rows with these columns, of which there may be none.
fn matrix(dim: usize, columns: impl Iterator<Item = DVector<f64>>) -> DMatrix<f64> {
    let entries: Vec<f64> = columns.flat_map(|column| column.as_slice().to_vec()).collect();
    DMatrix::from_column_slice(dim, entries.len() / dim, &entries)
}

impl<'a, G: Group + 'a, C: Chart<G>> Tangent<'a, G, C> {
    /// For a step of this size; arguments as those of [`map`](super::kick::map).
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub(crate) fn new(
        integrator: &'a Integrator,
        group: &G,
        size: f64,
        parameters: &[f64],
    ) -> Result<Self, StepError> {
        let problem = &integrator.problem;
        let values = problem.symbols_at(parameters);
        let flow = |part: f64| -> Result<Flow<'a, G, C>, StepError> {
            let step = size * part;
            let function = Interpreter::new(integrator, group.clone(), step, parameters)?;
            let by_parameter = |number: usize| {
                let mut change = vec![0.0; parameters.len()];
                change[number] = 1.0;
                let slope = |symbol: &coadjoint_codegen::problem::Symbol| {
                    symbol.expr.slope(parameters, &change)
                };
                let change: Vec<f64> = problem.symbols.iter().map(slope).collect();
                let slots = integrator.fold_table().slope(step, &values, &change);
                let slots = slots.map_err(|error| refusal(error, step, &change))?;
                Ok(Interpreter::folded(integrator, group.clone(), slots))
            };
            let by_parameters: Result<_, StepError> =
                (0..parameters.len()).map(by_parameter).collect();
            Ok(Flow { function, by_parameters: by_parameters? })
        };
        let kicks = integrator.kicks.as_ref();
        let parts = kicks.map_or_else(|| vec![1.0], |kicks| kicks.splitting.flows().collect());
        let flows: Result<Vec<_>, StepError> = parts.into_iter().map(flow).collect();
        let slope = |kicks: &'a Kicks| {
            let slope = KickSlope::new(&kicks.kick, group, parameters)?;
            Ok::<_, StepError>((kicks.splitting, size, slope))
        };
        let kicks = kicks.map(slope).transpose()?;
        let hessian = push_forward(&integrator.gradient);
        let frame = integrator.frame.iter().map(push_forward).collect();
        Ok(Self { flows: flows?, kicks, hessian, frame })
    }

    /// The derivative of the step from a state of this time.
    ///
    /// # Errors
    /// Fails if there is no step.
    pub(crate) fn linear(&self, mut phase: Phase<G>, time: f64) -> Result<Linear, StepError> {
        let parameters = self.flows.first().map_or(0, |flow| flow.by_parameters.len());
        let mut total = Linear::identity(phase.momentum.len(), parameters);
        let Some((splitting, size, kick)) = &self.kicks else {
            return self.flows.first().map_or(Ok(total), |flow| self.flow(flow, &mut phase));
        };
        compose(*splitting, &mut phase, [time, *size], |piece, phase, time, length| {
            let next = match piece {
                Piece::Kick => kick.linear(phase, [time, length])?,
                Piece::Flow(number) => self.flow(&self.flows[number], phase)?,
            };
            total = total.then(&next);
            Ok(())
        })?;
        Ok(total)
    }

    /// The derivative of a flow, with the motion of the frame after it.
    fn flow(&self, flow: &Flow<'a, G, C>, phase: &mut Phase<G>) -> Result<Linear, StepError> {
        let Flow { function, by_parameters } = flow;
        let (place, dim) = ((C::default(), &function.group), phase.momentum.len());
        let along = |program: &Program, at: &DVector<f64>, direction: &DVector<f64>| {
            let inputs = [at.as_slice(), direction.as_slice()].concat();
            DVector::from_vec(program.run(&inputs, &function.slots))
        };
        let mu = &phase.momentum;
        let x = solve(function, mu)?.x;
        let p = place.0.pull_back(place.1, &x, mu);
        let hessian = columns(dim, |unit| along(&self.hessian, &p, unit));
        let mixed = matrix(dim, by_parameters.iter().map(|slope| slope.gradient(&p)));
        let response = Linear::response(place, &x, mu, [&hessian, &mixed])?;
        let mut linear = moved(place, &x, phase, &response);
        for (number, program) in self.frame.iter().enumerate() {
            let mu = &phase.momentum;
            let Some(y) = function.frame(number, mu) else { break };
            let slopes = by_parameters.iter().filter_map(|slope| slope.frame(number, mu));
            let response = [columns(dim, |unit| along(program, mu, unit)), matrix(dim, slopes)];
            linear = linear.then(&moved((Exponential, place.1), &y, phase, &response));
        }
        Ok(linear)
    }
}

/// Moves a state by τ(x); the derivative of that.
pub(super) fn moved<G: Group, C: Chart<G>>(
    (chart, group): (C, &G),
    x: &DVector<f64>,
    phase: &mut Phase<G>,
    response: &[DMatrix<f64>; 2],
) -> Linear {
    let (increment, after) = chart.transport(group, x, &phase.momentum);
    let linear = Linear::of_motion((chart, group), x, &after, response);
    phase.group_element = group.compose(&phase.group_element, &increment);
    phase.momentum = after;
    linear
}

impl<'a, G: Group> KickSlope<'a, G> {
    /// For these values of the parameters.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub(super) fn new(kick: &'a Kick, group: &G, parameters: &[f64]) -> Result<Self, StepError> {
        let torque = Torque::new(kick, group.clone(), parameters)?;
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
        phase: &mut Phase<G>,
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
        let torque = self.torque.torque(g, &phase.momentum, time)?;
        phase.momentum += torque * length;
        Ok(Linear::of_kick(&(by_element * length), &(by_parameters * length)))
    }
}
