//! Steps by collocation, for Hamiltonians that are no polynomials: by programs where there are any, else, and where these refuse a
//! step, by the runtime's.

use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use coadjoint::collocation::{Collocation, Energy, Undefined};
use coadjoint::groups::{DirectProduct, Exponential, MatrixGroup};
use coadjoint::steps::{Piece, Splitting, compose};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::cancel;
use coadjoint_codegen::integrator::Kicks;
use coadjoint_codegen::smooth::Smooth;
use coadjoint_codegen::step;
use nalgebra::DVector;

use super::compiled::{Compiled, Folded, Numbers, Solved, Solves};
use super::kick::Torque;
use super::linear::{Differentiable, Linear};
use super::motion::{Motion, Varied, advise, one_by_one};
use super::response::Response;
use super::space::{Elements, Space};
use super::tangent::{KickSlope, moved};
use crate::error::kept;
use crate::grid::Grid;

/// The steps of this grid of a smooth system, for these values of the parameters that it keeps.
///
/// # Errors
/// Fails if the size makes no sense, or an expression in the parameters is not finite.
pub(crate) fn collocated<'a>(
    smooth: &'a Smooth,
    elements: Elements<Group>,
    grid: Grid,
    parameters: &[f64],
) -> Result<Box<dyn Varied + 'a>, StepError> {
    let symbols = smooth.symbols_at(parameters);
    if let Some(value) = symbols.into_iter().find(|value| !value.is_finite()) {
        return Err(StepError::InvalidParameter { name: "of the Hamiltonian", value });
    }
    Ok(match smooth.nodes() {
        1 => Box::new(Collocated::<1>::new(elements, smooth, grid, parameters)?),
        2 => Box::new(Collocated::<2>::new(elements, smooth, grid, parameters)?),
        3 => Box::new(Collocated::<3>::new(elements, smooth, grid, parameters)?),
        4 => Box::new(Collocated::<4>::new(elements, smooth, grid, parameters)?),
        5 => Box::new(Collocated::<5>::new(elements, smooth, grid, parameters)?),
        6 => Box::new(Collocated::<6>::new(elements, smooth, grid, parameters)?),
        7 => Box::new(Collocated::<7>::new(elements, smooth, grid, parameters)?),
        _ => Box::new(Collocated::<8>::new(elements, smooth, grid, parameters)?),
    })
}

/// The energy by its programs.
#[derive(Clone, Debug)]
pub(super) struct Interpreted<'a>(Arc<step::Energy<'a>>);

impl<'a> Interpreted<'a> {
    pub(super) fn new(energy: step::Energy<'a>) -> Self {
        Self(Arc::new(energy))
    }
}

impl Energy<DVector<f64>> for Interpreted<'_> {
    fn value(&self, time: f64, mu: &DVector<f64>) -> f64 {
        self.0.value(time, mu.as_slice())
    }

    fn gradient(&self, time: f64, mu: &DVector<f64>) -> DVector<f64> {
        cancel::check();
        DVector::from_vec(self.0.gradient(time, mu.as_slice()))
    }

    fn reach(&self, from: (f64, &DVector<f64>), to: (f64, &DVector<f64>)) -> Option<f64> {
        let [from, to] = [from, to].map(|(time, mu)| (time, mu.as_slice()));
        self.0.reach(from, to)
    }

    fn unit(&self, i: usize) -> f64 {
        self.0.unit(i)
    }

    fn undefined(&self, time: f64, mu: &DVector<f64>) -> Option<Undefined> {
        let (expression, argument) = self.0.undefined(time, mu.as_slice())?;
        Some(Undefined { expression: kept(expression), argument })
    }
}

/// The group of all steps by collocation.
pub(crate) type Group = DirectProduct<MatrixGroup>;

/// The kicks between the flows of a step.
#[derive(Debug)]
struct Kicked<'a> {
    splitting: Splitting,
    torque: Torque<'a, Group>,
}

impl<'a> Kicked<'a> {
    /// The kicks of a system, for these values of the parameters that it keeps.
    fn new(
        smooth: &'a Smooth,
        group: &Group,
        parameters: &[f64],
    ) -> Result<Option<Self>, StepError> {
        let Some(Kicks { kick, splitting, .. }) = &smooth.kicks else { return Ok(None) };
        let torque = Torque::new(kick, group.clone(), parameters)?;
        Ok(Some(Self { splitting: *splitting, torque }))
    }
}

/// Steps of one size at `M` nodes.
struct Collocated<'a, const M: usize> {
    elements: Elements<Group>,
    smooth: &'a Smooth,
    /// The values of the parameters that are kept.
    parameters: Vec<f64>,
    grid: Grid,
    step: Mutex<Collocation<Group, Interpreted<'a>, M>>,
    kicks: Option<Kicked<'a>>,
    /// The second derivatives, and those of kicks, once they were asked for.
    response: OnceLock<(Response<'a>, Option<KickSlope<'a, Group>>)>,
}

impl<'a, const M: usize> Collocated<'a, M> {
    fn new(
        elements: Elements<Group>,
        smooth: &'a Smooth,
        grid: Grid,
        parameters: &[f64],
    ) -> Result<Self, StepError> {
        let group = &*elements.group;
        let kicks = Kicked::new(smooth, group, parameters)?;
        let energy = Interpreted::new(step::Energy::smooth(smooth, parameters));
        let step = Mutex::new(Collocation::new(group.clone(), energy, grid.step)?);
        let (parameters, response) = (parameters.to_vec(), OnceLock::new());
        Ok(Self { elements, smooth, parameters, grid, step, kicks, response })
    }

    fn step(&self) -> MutexGuard<'_, Collocation<Group, Interpreted<'a>, M>> {
        // A thread that panicked has left whole steps, if any.
        self.step.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// One step from this time, which knows no steps before it, by the runtime. The error of one that cannot be made names a size
    /// that works.
    fn rescue(&self, state: &mut Numbers, time: f64, size: f64) -> Result<Solves, StepError> {
        let step = self.step();
        let mut phase = self.elements.phase(state);
        let made = self.alone(&step, &mut phase, time, size);
        let solves = made.map_err(|error| {
            let works =
                |size| self.alone(&step, &mut self.elements.phase(state), time, size).is_ok();
            advise(error, size, works)
        })?;
        *state = self.elements.state(&phase);
        Ok(solves)
    }

    /// One step of another size from this time, which knows no steps before it.
    fn alone(
        &self,
        step: &Collocation<Group, Interpreted<'a>, M>,
        phase: &mut Phase<Group>,
        time: f64,
        size: f64,
    ) -> Result<Solves, StepError> {
        let flow = |phase: &mut Phase<Group>, time, size| {
            let (group, energy) = (step.group().clone(), step.energy().clone());
            Collocation::<_, _, M>::new(group, energy, size)?.advance(phase, time)
        };
        let Some(Kicked { splitting, torque }) = &self.kicks else {
            let report = flow(phase, time, size)?;
            return Ok(Some(Solved::one(report.iterations, report.residual)));
        };
        compose(*splitting, phase, [time, size], |piece, phase, time, length| match piece {
            Piece::Kick => torque.kick(phase, time, length),
            Piece::Flow(_) => flow(phase, time, length).map(drop),
        })?;
        Ok(None)
    }
}

impl<const M: usize> Motion for Collocated<'_, M> {
    fn space(&self) -> &dyn Space {
        &self.elements
    }

    fn grid(&self) -> Grid {
        self.grid
    }

    fn advance(
        &self,
        state: &mut Numbers,
        first: u64,
        count: u64,
    ) -> Result<Solves, (u64, StepError)> {
        let Grid { start, step: size } = self.grid;
        if let Some(compiled) = &self.elements.compiled {
            let rescue =
                |state: &mut Numbers, number| self.rescue(state, self.grid.time(number), size);
            return Ok(Some(compiled.advance(state, start, [first, count], rescue)?));
        }
        // Steps of a system too large for programs begin anew: so their bits do not depend on how a run is cut.
        let remembers = self.kicks.is_none() && self.smooth.given.is_some();
        let mut number = first;
        one_by_one(count, || {
            let time = self.grid.time(number);
            number += 1;
            if remembers {
                let mut phase = self.elements.phase(state);
                if let Ok(report) = self.step().advance(&mut phase, time) {
                    *state = self.elements.state(&phase);
                    return Ok(Some(Solved::one(report.iterations, report.residual)));
                }
            }
            self.rescue(state, time, size)
        })
    }

    fn beside(&self, state: &Numbers, time: f64, size: f64) -> Result<Numbers, StepError> {
        let mut state = state.clone();
        if let Some(compiled) = &self.elements.compiled {
            let other = compiled.anew(size, &self.parameters)?;
            if other.one_at(&mut state, time) {
                return Ok(state);
            }
        }
        self.rescue(&mut state, time, size)?;
        Ok(state)
    }

    fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError> {
        let made = self.elements.compiled.as_ref().is_some_and(|own| own.one_at(state, time));
        if made {
            return Ok(());
        }
        self.rescue(state, time, self.grid.step).map(drop)
    }

    fn lanes(&self) -> Option<&Compiled> {
        self.elements.compiled.as_deref()
    }

    /// Of a function of the user's there is no Hessian, and of torques without potential no derivatives are known.
    fn differentiable(&self) -> Option<&dyn Differentiable> {
        let Smooth { given, kicks, .. } = self.smooth;
        let torque = kicks.as_ref().and_then(Kicks::torque);
        (given.is_none() && torque.is_none()).then_some(self)
    }

    fn defined(&self, state: &Numbers, time: f64) -> Result<(), StepError> {
        let (step, mu) = (self.step(), DVector::from_column_slice(&state.mu));
        let energy = step.energy();
        // A function of the user's says by its value alone that there is none.
        let lost = || self.smooth.given.is_some() && !energy.value(time, &mu).is_finite();
        let nothing = || Undefined { expression: "H", argument: f64::NAN };
        let found = energy.undefined(time, &mu).or_else(|| lost().then(nothing));
        if let Some(Undefined { expression, argument }) = found {
            return Err(StepError::Undefined { expression, argument, time, at: None });
        }
        let kicks = self.kicks.as_ref();
        kicks.map_or(Ok(()), |kicks| kicks.torque.defined(&self.elements.phase(state), time))
    }
}

impl<const M: usize> Varied for Collocated<'_, M> {
    /// The steps made before are forgotten.
    fn vary(&mut self, parameters: &[f64], folded: Option<Folded>) {
        if let (Some(compiled), Some(folded)) = (&mut self.elements.compiled, folded) {
            Arc::make_mut(compiled).with(folded);
        }
        let step = self.step.get_mut().unwrap_or_else(PoisonError::into_inner);
        let (group, size) = (step.group().clone(), step.step());
        let energy = Interpreted::new(step::Energy::smooth(self.smooth, parameters));
        self.parameters = parameters.to_vec();
        self.response = OnceLock::new();
        if let Some(kicks) = &mut self.kicks {
            kicks.torque.vary(parameters);
        }
        if let Ok(varied) = Collocation::new(group, energy, size) {
            *step = varied;
        }
    }
}

impl<const M: usize> Differentiable for Collocated<'_, M> {
    fn parameters(&self) -> usize {
        self.parameters.len()
    }

    fn linear(&self, state: &Numbers, first: u64) -> Result<Linear, StepError> {
        let step = self.step();
        let (group, place) = (step.group(), (Exponential, step.group()));
        let Self { smooth, parameters, .. } = self;
        let (response, slope) = match self.response.get() {
            Some(made) => made,
            None => {
                let kick = smooth.kicks.as_ref().map(|kicks| &kicks.kick);
                let slope = kick.map(|kick| KickSlope::new(kick, group, parameters)).transpose()?;
                let made = (Response::new(smooth, parameters), slope);
                self.response.get_or_init(|| made)
            }
        };
        let mut phase = self.elements.phase(state);
        let (time, size) = (self.grid.time(first), self.grid.step);
        let flow = |step: &Collocation<_, _, M>, phase: &mut Phase<Group>, time| {
            let solution = step.solution(&phase.momentum, time)?;
            let [hessian, mixed] = response.of(group, &solution, step.step())?;
            let (x, mu) = (&solution.x, &phase.momentum);
            let of_momentum = Linear::response(place, x, mu, [&hessian, &mixed])?;
            // In the chart of tables, which is exp.
            Ok(moved(place, x, phase, &of_momentum))
        };
        let (Some(kicks), Some(slope)) = (&self.kicks, slope) else {
            return flow(&step, &mut phase, time);
        };
        let mut total = Linear::identity(phase.momentum.len(), parameters.len());
        compose(kicks.splitting, &mut phase, [time, size], |piece, phase, time, length| {
            let next = match piece {
                Piece::Kick => slope.linear(phase, [time, length])?,
                Piece::Flow(_) => {
                    let energy = step.energy().clone();
                    flow(&Collocation::new(group.clone(), energy, length)?, phase, time)?
                }
            };
            total = total.then(&next);
            Ok(())
        })?;
        Ok(total)
    }
}
