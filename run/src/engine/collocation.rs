//! Steps by collocation, for Hamiltonians that are no polynomials: the gradient is interpreted.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coadjoint::collocation::{Collocation, Energy, Undefined};
use coadjoint::groups::{DirectProduct, Exponential, MatrixGroup};
use coadjoint::{LieGroup, Phase, StepError};
use coadjoint_codegen::cancel;
use coadjoint_codegen::smooth::Smooth;
use nalgebra::DVector;

use super::compiled::{Folded, Numbers, Solves};
use super::linear::{Differentiable, Linear};
use super::motion::{Motion, Varied, advise, one_by_one};
use super::response::Response;
use super::space::{Elements, Space};
use crate::error::kept;

/// The steps of this size of a smooth system, for these values of the parameters that it keeps.
///
/// # Errors
/// Where the size makes no sense, or an expression in the parameters is not finite.
pub(crate) fn collocated<'a>(
    smooth: &'a Smooth,
    group: &Arc<Group>,
    size: f64,
    parameters: &[f64],
) -> Result<Box<dyn Varied + 'a>, StepError> {
    let symbols: Arc<[f64]> = smooth.symbols_at(parameters).into();
    if let Some(value) = symbols.iter().copied().find(|value| !value.is_finite()) {
        return Err(StepError::InvalidParameter { name: "of the Hamiltonian", value });
    }
    let energy = Interpreted { smooth, symbols, parameters: parameters.into() };
    let group = group.clone();
    Ok(match smooth.nodes() {
        1 => Box::new(Collocated::<1>::new(group, energy, size)?),
        2 => Box::new(Collocated::<2>::new(group, energy, size)?),
        3 => Box::new(Collocated::<3>::new(group, energy, size)?),
        4 => Box::new(Collocated::<4>::new(group, energy, size)?),
        5 => Box::new(Collocated::<5>::new(group, energy, size)?),
        6 => Box::new(Collocated::<6>::new(group, energy, size)?),
        7 => Box::new(Collocated::<7>::new(group, energy, size)?),
        _ => Box::new(Collocated::<8>::new(group, energy, size)?),
    })
}

/// The energy by its programs.
#[derive(Clone, Debug)]
struct Interpreted<'a> {
    smooth: &'a Smooth,
    symbols: Arc<[f64]>,
    parameters: Arc<[f64]>,
}

impl Energy<DVector<f64>> for Interpreted<'_> {
    fn value(&self, time: f64, mu: &DVector<f64>) -> f64 {
        self.smooth.energy(&self.symbols, time, mu.as_slice())
    }

    fn gradient(&self, time: f64, mu: &DVector<f64>) -> DVector<f64> {
        cancel::check();
        DVector::from_vec(self.smooth.gradient(&self.symbols, time, mu.as_slice()))
    }

    fn undefined(&self, time: f64, mu: &DVector<f64>) -> Option<Undefined> {
        let (number, argument) = self.smooth.undefined(&self.symbols, time, mu.as_slice())?;
        Some(Undefined { expression: kept(&self.smooth.expressions[number]), argument })
    }
}

/// The group of all steps by collocation.
pub type Group = DirectProduct<MatrixGroup>;

/// Steps of one size at `M` nodes.
struct Collocated<'a, const M: usize> {
    elements: Elements<Group>,
    step: Mutex<Collocation<Group, Interpreted<'a>, M>>,
    /// The second derivatives, once they were asked for.
    response: OnceLock<Response<'a>>,
}

impl<'a, const M: usize> Collocated<'a, M> {
    fn new(group: Arc<Group>, energy: Interpreted<'a>, size: f64) -> Result<Self, StepError> {
        let step = Mutex::new(Collocation::new((*group).clone(), energy, size)?);
        let elements = Elements { group, compiled: None };
        Ok(Self { elements, step, response: OnceLock::new() })
    }

    /// One step of another size from this time, which knows no steps before it.
    fn alone(
        step: &Collocation<Group, Interpreted<'a>, M>,
        phase: &mut Phase<Group>,
        time: f64,
        size: f64,
    ) -> Result<(), StepError> {
        let (group, energy) = (step.group().clone(), step.energy().clone());
        let mut step = Collocation::<_, _, M>::new(group, energy, size)?;
        step.advance(phase, time).map(|_| ())
    }
}

impl<const M: usize> Motion for Collocated<'_, M> {
    fn space(&self) -> &dyn Space {
        &self.elements
    }

    fn advance(
        &self,
        state: &mut Numbers,
        first: u64,
        count: u64,
    ) -> Result<Solves, (u64, StepError)> {
        // A thread that panicked has left whole steps, if any.
        let mut step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        let mut number = first;
        one_by_one(count, || {
            let mut phase = self.elements.phase(state);
            let time = number as f64 * step.step();
            number += 1;
            let report = step.advance(&mut phase, time).map_err(|error| {
                let works =
                    |size| Self::alone(&step, &mut self.elements.phase(state), time, size).is_ok();
                advise(error, step.step(), works)
            })?;
            *state = self.elements.state(&phase);
            Ok(Some((report.iterations, report.residual)))
        })
    }

    fn beside(&self, state: &Numbers, time: f64, size: f64) -> Result<Numbers, StepError> {
        let step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        let mut phase = self.elements.phase(state);
        Self::alone(&step, &mut phase, time, size)?;
        Ok(self.elements.state(&phase))
    }

    fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError> {
        let size = self.step.lock().unwrap_or_else(PoisonError::into_inner).step();
        *state = self.beside(state, time, size)?;
        Ok(())
    }

    fn memory(&self, mu: &[f64]) -> Vec<f64> {
        let step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        step.memory(&DVector::from_column_slice(mu)).collect()
    }

    fn recall(&self, mu: &[f64], memory: &[f64]) -> bool {
        let mut step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        step.recall(&DVector::from_column_slice(mu), memory)
    }

    /// There is no series.
    fn ratio(&self, _: &[f64]) -> f64 {
        0.0
    }

    /// Of a function of the user's there is no Hessian.
    fn differentiable(&self) -> Option<&dyn Differentiable> {
        let step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        step.energy().smooth.given.is_none().then_some(self)
    }

    fn defined(&self, state: &Numbers) -> Result<(), StepError> {
        let step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        let found = step.energy().undefined(0.0, &DVector::from_column_slice(&state.mu));
        found.map_or(Ok(()), |Undefined { expression, argument }| {
            Err(StepError::Undefined { expression, argument, time: 0.0, at: None })
        })
    }
}

impl<const M: usize> Varied for Collocated<'_, M> {
    /// The steps made before are forgotten.
    fn vary(&mut self, parameters: &[f64], _: Option<Folded>) {
        let step = self.step.get_mut().unwrap_or_else(PoisonError::into_inner);
        let (group, size) = (step.group().clone(), step.step());
        let mut energy = step.energy().clone();
        energy.symbols = energy.smooth.symbols_at(parameters).into();
        energy.parameters = parameters.into();
        self.response = OnceLock::new();
        if let Ok(varied) = Collocation::new(group, energy, size) {
            *step = varied;
        }
    }
}

impl<const M: usize> Differentiable for Collocated<'_, M> {
    fn parameters(&self) -> usize {
        let step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        step.energy().parameters.len()
    }

    fn linear(&self, state: &Numbers, first: u64) -> Result<Linear, StepError> {
        let step = self.step.lock().unwrap_or_else(PoisonError::into_inner);
        let (group, place) = (step.group(), (Exponential, step.group()));
        let response = self.response.get_or_init(|| {
            let Interpreted { smooth, symbols, parameters } = step.energy().clone();
            Response::new(smooth, symbols, &parameters)
        });
        let mu = DVector::from_column_slice(&state.mu);
        let solution = step.solution(&mu, first as f64 * step.step())?;
        let [hessian, mixed] = response.of(group, &solution, step.step())?;
        let of_momentum = Linear::response(place, &solution.x, &mu, [&hessian, &mixed])?;
        // In the chart of tables, which is exp.
        let after = group.middle_transport(&solution.x, &mu).1;
        Ok(Linear::of_motion(place, &solution.x, &after, &of_momentum))
    }
}
