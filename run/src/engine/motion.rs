//! Steps of one size, whatever makes them.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coadjoint::groups::Chart;
use coadjoint::{Phase, StepError};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::in_other_frame;
use coadjoint_codegen::integrator::{Integrator, Kicks};
use coadjoint_codegen::potential::Force;
use coadjoint_codegen::step::{Convergence, Converging};

use super::compiled::{Compiled, Folded, Numbers, STEEP, Solved, Solves};
use super::kick::{Map, Torque, longest_flow, map};
use super::linear::{Differentiable, Linear};
use super::space::{Elements, Restore, Space};
use super::tangent::Tangent;
use crate::grid::Grid;

/// Moves states by steps of one size.
pub(crate) trait Motion: Send + Sync {
    /// The group that the states belong to.
    fn space(&self) -> &dyn Space;

    /// The times between steps.
    fn grid(&self) -> Grid;

    /// Makes `count` steps of a state that `first` steps from the start of the [grid](Motion::grid) have reached. The state
    /// that comes of them does not depend on how many are made at a time.
    ///
    /// # Errors
    /// Returns the number of steps made and the error of the next one; the state is then the one before it.
    fn advance(
        &self,
        state: &mut Numbers,
        first: u64,
        count: u64,
    ) -> Result<Solves, (u64, StepError)>;

    /// The state after one step of another size from this time.
    ///
    /// # Errors
    /// Fails if there is none.
    fn beside(&self, state: &Numbers, time: f64, size: f64) -> Result<Numbers, StepError>;

    /// Makes one step from this time, whatever steps were made before.
    ///
    /// # Errors
    /// Returns the reason for which there is none.
    fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError>;

    /// The ratio of the last two terms of the series at each momentum, where it may be worth a warning; else 0.
    fn ratios(&self, momenta: &[&[f64]]) -> Vec<f64> {
        vec![0.0; momenta.len()]
    }

    /// The ratio at one momentum.
    fn ratio(&self, mu: &[f64]) -> f64 {
        self.ratios(&[mu]).into_iter().fold(0.0, f64::max)
    }

    /// The steps with their derivatives, if these are known.
    fn differentiable(&self) -> Option<&dyn Differentiable> {
        None
    }

    /// Advice beside that of an error, for a step from this time that this state refused.
    fn advice(&self, _: &Numbers, _time: f64, _: &StepError) -> Option<&'static str> {
        None
    }

    /// Checks that the Hamiltonian and the torque of kicks are defined in a state of this time.
    ///
    /// # Errors
    /// The expression in them that is not.
    fn defined(&self, state: &Numbers, time: f64) -> Result<(), StepError>;

    /// The programs that move many states side by side, where there are any.
    fn lanes(&self) -> Option<&Compiled> {
        None
    }
}

/// A motion whose parameters may take other values.
pub(crate) trait Varied: Motion {
    /// Takes these values, and what its programs read for them, where it has any.
    fn vary(&mut self, parameters: &[f64], folded: Option<Folded>);
}

/// Makes steps one by one with `step`, which leaves a state that it cannot move as it is.
///
/// # Errors
/// As [`Motion::advance`].
pub(crate) fn one_by_one(
    count: u64,
    mut step: impl FnMut() -> Result<Solves, StepError>,
) -> Result<Solves, (u64, StepError)> {
    let mut total: Solves = None;
    for made in 0..count {
        let solved = step().map_err(|error| (made, error))?;
        total = match (total, solved) {
            (Some(total), Some(solved)) => Some(total.with(solved)),
            (total, solved) => total.or(solved),
        };
    }
    Ok(total)
}

/// Halves of a refused step that are tried.
const MOST_HALVINGS: u32 = 24;

/// The error with the longest of h/2, h/4, … with which `works` says that the step can be made; as it is where there is
/// none, and where the length of the step is not to blame.
#[cold]
pub(crate) fn advise(error: StepError, h: f64, mut works: impl FnMut(f64) -> bool) -> StepError {
    if !error.asks_for_smaller_step() {
        return error;
    }
    let mut shorter = h;
    for _ in 0..MOST_HALVINGS {
        shorter *= 0.5;
        if works(shorter) {
            return error.with_usable_step(shorter);
        }
    }
    error
}

/// The equations of a motion: a flow, kicks where there are any, and the values of the parameters that are kept.
#[derive(Clone, Debug)]
pub(crate) struct Equations<'a> {
    /// The flow and the kicks.
    pub integrator: &'a Integrator,
    /// The values of the parameters.
    pub parameters: Vec<f64>,
}

impl Equations<'_> {
    /// True if steps depend on the time.
    fn moves(&self) -> bool {
        self.integrator.kicks.as_ref().is_some_and(Kicks::moves)
    }
}

/// The steps of a system: by programs where there are any, else by the generic solver, which also makes the steps that
/// programs refuse.
pub(super) struct Steps<'a, G: Restore, C> {
    elements: Elements<G>,
    equations: Equations<'a>,
    grid: Grid,
    /// The step of the generic solver, once one was needed.
    generic: OnceLock<Map<'a, G>>,
    /// Maps of half the step, of a quarter, …, as far as advice has needed them.
    shorter: Mutex<Vec<Option<Map<'a, G>>>>,
    /// The programs of ratios, once one was asked for, where there are no other programs.
    convergence: OnceLock<Convergence>,
    /// Their coefficients for the longest flow of a step.
    converging: OnceLock<Option<Converging>>,
    /// The derivative of a step, once one was asked for.
    tangent: OnceLock<Tangent<'a, G, C>>,
    /// This system in the comoving frame, once advice was asked for, where there is one and the choice is left.
    comoving: OnceLock<Option<Integrator>>,
}

impl<'a, G: Restore + 'a, C: Chart<G> + Send + Sync + 'a> Steps<'a, G, C> {
    pub(super) fn new(elements: Elements<G>, equations: Equations<'a>, grid: Grid) -> Self {
        let (generic, shorter, convergence, converging) = Default::default();
        let (tangent, comoving) = Default::default();
        Self {
            elements,
            equations,
            grid,
            generic,
            shorter,
            convergence,
            converging,
            tangent,
            comoving,
        }
    }

    fn map(&self, size: f64) -> Result<Map<'a, G>, StepError> {
        let Equations { integrator, parameters } = &self.equations;
        map::<G, C>(integrator, &self.elements.group, size, parameters)
    }

    /// The error of the next step of a state, with a step size that works there.
    fn advise(&self, error: StepError, phase: &Phase<G>, time: f64) -> StepError {
        // A thread that panicked has left whole steps, if any.
        let mut shorter = self.shorter.lock().unwrap_or_else(PoisonError::into_inner);
        let mut place = 0;
        advise(error, self.grid.step, |size| {
            if shorter.len() == place {
                shorter.push(self.map(size).ok());
            }
            place += 1;
            let step = shorter.get(place - 1).and_then(Option::as_ref);
            step.is_some_and(|step| step(&mut phase.clone(), time).is_ok())
        })
    }

    /// A step by the generic solver. The error of one that cannot be made names a size that works.
    fn rescue(&self, state: &mut Numbers, number: u64) -> Result<Solves, StepError> {
        let time = self.grid.time(number);
        let step = match self.generic.get() {
            Some(step) => step,
            None => {
                let made = self.map(self.grid.step)?;
                self.generic.get_or_init(|| made)
            }
        };
        let mut phase = self.elements.phase(state);
        let solved = step(&mut phase, time).map_err(|error| self.advise(error, &phase, time))?;
        *state = self.elements.state(&phase);
        Ok(solved)
    }
}

impl<'a, G: Restore + 'a, C: Chart<G> + Send + Sync + 'a> Motion for Steps<'a, G, C> {
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
        let Some(compiled) = &self.elements.compiled else {
            let mut numbers = first..;
            return one_by_one(count, || self.rescue(state, numbers.next().unwrap_or(first)));
        };
        let rescue = |state: &mut Numbers, number| self.rescue(state, number);
        let made = compiled.advance(state, self.grid.start, [first, count], rescue)?;
        // A bound, which may be far below what rounding leaves.
        Ok(Some(Solved { residual: made.residual.max(f64::EPSILON), ..made }))
    }

    fn beside(&self, state: &Numbers, time: f64, size: f64) -> Result<Numbers, StepError> {
        let mut phase = self.elements.phase(state);
        self.map(size)?(&mut phase, time)?;
        Ok(self.elements.state(&phase))
    }

    fn one_at(&self, state: &mut Numbers, time: f64) -> Result<(), StepError> {
        if self.equations.moves() {
            *state = self.beside(state, time, self.grid.step)?;
            return Ok(());
        }
        self.advance(state, 0, 1).map(drop).map_err(|(_, error)| error)
    }

    fn ratios(&self, momenta: &[&[f64]]) -> Vec<f64> {
        let Equations { integrator, parameters } = &self.equations;
        let compiled = self.elements.compiled.as_ref();
        let quiet = |compiled: &Arc<Compiled>| momenta.iter().all(|mu| compiled.is_quiet(mu));
        if integrator.largest_rate.is_none() && compiled.is_some_and(quiet) {
            return vec![0.0; momenta.len()];
        }
        let fold = || {
            let longest = self.grid.step * integrator.kicks.as_ref().map_or(1.0, longest_flow);
            Convergence::fold(integrator, longest, parameters, STEEP).ok()
        };
        let convergence = match compiled {
            Some(compiled) => compiled.convergence(integrator),
            None => self.convergence.get_or_init(|| Convergence::new(integrator)),
        };
        let folded = self.converging.get_or_init(fold).as_ref();
        folded.map_or_else(|| vec![0.0; momenta.len()], |own| convergence.ratios(own, momenta))
    }

    fn advice(&self, state: &Numbers, time: f64, error: &StepError) -> Option<&'static str> {
        let Equations { integrator, parameters } = &self.equations;
        let make = || {
            let problem = in_other_frame(&integrator.problem)?;
            let limit = TermLimit::of_open_method();
            let made = problem.comoving.is_some().then(|| Integrator::build(problem, limit).ok());
            match &integrator.kicks {
                Some(Kicks { kick, splitting, .. }) => {
                    made.flatten()?.with_kicks(kick.clone(), *splitting)
                }
                None => made.flatten(),
            }
        };
        let works = |comoving: &Integrator| {
            let map = map::<G, C>(comoving, &self.elements.group, self.grid.step, parameters);
            map.is_ok_and(|step| step(&mut self.elements.phase(state), time).is_ok())
        };
        let comoving = error.asks_for_smaller_step().then(|| self.comoving.get_or_init(make));
        let advice =
            "; this step can be made in the comoving frame: [integrator] frame = \"comoving\"";
        comoving?.as_ref().filter(|comoving| works(comoving)).map(|_| advice)
    }

    /// Of torques without potential no derivatives are known.
    fn differentiable(&self) -> Option<&dyn Differentiable> {
        let kicks = self.equations.integrator.kicks.as_ref();
        kicks.and_then(Kicks::torque).is_none().then_some(self)
    }

    fn defined(&self, state: &Numbers, time: f64) -> Result<(), StepError> {
        let Equations { integrator, parameters } = &self.equations;
        // A polynomial is defined everywhere.
        let Some(kicks) = &integrator.kicks else { return Ok(()) };
        if matches!(kicks.kick.potential.force, Force::Polynomial(_)) {
            return Ok(());
        }
        let torque = Torque::new(&kicks.kick, (*self.elements.group).clone(), parameters)?;
        torque.defined(&self.elements.phase(state), time)
    }

    fn lanes(&self) -> Option<&Compiled> {
        self.elements.compiled.as_deref()
    }
}

impl<'a, G: Restore + 'a, C: Chart<G> + Send + Sync + 'a> Differentiable for Steps<'a, G, C> {
    fn parameters(&self) -> usize {
        self.equations.parameters.len()
    }

    fn linear(&self, state: &Numbers, first: u64) -> Result<Linear, StepError> {
        let tangent = match self.tangent.get() {
            Some(tangent) => tangent,
            None => {
                let Equations { integrator, parameters } = &self.equations;
                let group: &G = &self.elements.group;
                let made = Tangent::new(integrator, group, self.grid.step, parameters)?;
                self.tangent.get_or_init(|| made)
            }
        };
        tangent.linear(self.elements.phase(state), self.grid.time(first))
    }
}

impl<'a, G: Restore + 'a, C: Chart<G> + Send + Sync + 'a> Varied for Steps<'a, G, C> {
    fn vary(&mut self, parameters: &[f64], folded: Option<Folded>) {
        self.equations.parameters.clear();
        self.equations.parameters.extend_from_slice(parameters);
        // These are of other values.
        (self.generic, self.converging, self.shorter, self.tangent) = Default::default();
        if let (Some(compiled), Some(folded)) = (&mut self.elements.compiled, folded) {
            Arc::make_mut(compiled).with(folded);
        }
    }
}
