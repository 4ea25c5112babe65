//! The runs of systems whose Hamiltonian is no polynomial: by collocation, its gradient interpreted.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use coadjoint::collocation::{Collocation, Energy, Undefined};
use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::problem::values;
use coadjoint_codegen::smooth::Smooth;
use coadjoint_codegen::step::Invariants;
use nalgebra::DVector;

use super::estimate::{ENDED, estimate};
use super::march::Subject;
use super::recorder::{Outcome, Watched};
use super::setup::{Schedule, Setup};
use super::sink::Sink;
use crate::engine::{Elements, Motion, Numbers, Solves, Space, advise, one_by_one, product_group};
use crate::error::RunError;

/// Runs a smooth system, which is called `file` in messages, from the start to the end.
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run_smooth(
    file: &Path,
    smooth: &Smooth,
    setup: &Setup,
    sink: &mut dyn Sink,
) -> Result<Outcome, RunError> {
    if setup.momentum.len() != smooth.algebra.dim() {
        return Err(RunError::Option("the momentum does not fit the group".to_owned()));
    }
    let symbols = values(&smooth.symbols);
    let named = symbols.iter().zip(&smooth.symbols);
    if let Some((value, symbol)) = named.clone().find(|(value, _)| !value.is_finite()) {
        let text = &symbol.text;
        return Err(RunError::Option(format!("{text} is {value} in the Hamiltonian")));
    }
    let energy = Interpreted { smooth, symbols: &symbols };
    let momentum = DVector::from_column_slice(&setup.momentum);
    if let Some(Undefined { expression, argument }) = energy.undefined(0.0, &momentum) {
        let error = StepError::Undefined { expression, argument, time: 0.0, at: None };
        return Err(RunError::Run { time: 0.0, step: 0, what: error.to_string() });
    }
    let invariants = Invariants::of_smooth(smooth, symbols.clone());
    let watched = Watched {
        algebra: &smooth.algebra,
        coordinates: &smooth.coordinates,
        invariants: &invariants,
        attitude: true,
    };
    let group = product_group(file, &smooth.algebra)?;
    let steps = |size: f64| energy.steps(group.clone(), size);
    let Schedule { step, steps: count, .. } = setup.schedule;
    let motion = steps(step).map_err(|source| RunError::Step { time: 0.0, source })?;
    let start = setup.start(file, motion.space())?;
    let subject = Subject { setup, watched, warnings: Vec::new() };
    let (mut outcome, end) = subject.run(motion.as_ref(), &start, sink)?;
    let order = 2 * smooth.nodes() as u32;
    let other = |size| steps(step * size);
    let found = match outcome.time == setup.schedule.end {
        true => estimate(motion.as_ref(), other, [&start, &end], count, order),
        false => Err(ENDED),
    };
    outcome.estimated(found, sink);
    Ok(outcome)
}

/// The energy by its programs.
#[derive(Clone, Copy, Debug)]
struct Interpreted<'a> {
    smooth: &'a Smooth,
    symbols: &'a [f64],
}

impl<'a> Interpreted<'a> {
    /// Steps of this size.
    ///
    /// # Errors
    /// Where the size makes no sense.
    fn steps(self, group: Group, size: f64) -> Result<Box<dyn Motion + 'a>, StepError> {
        Ok(match self.smooth.nodes() {
            1 => Box::new(Collocated::<1>::new(group, self, size)?),
            2 => Box::new(Collocated::<2>::new(group, self, size)?),
            3 => Box::new(Collocated::<3>::new(group, self, size)?),
            4 => Box::new(Collocated::<4>::new(group, self, size)?),
            5 => Box::new(Collocated::<5>::new(group, self, size)?),
            6 => Box::new(Collocated::<6>::new(group, self, size)?),
            7 => Box::new(Collocated::<7>::new(group, self, size)?),
            _ => Box::new(Collocated::<8>::new(group, self, size)?),
        })
    }
}

impl Energy<DVector<f64>> for Interpreted<'_> {
    fn value(&self, time: f64, mu: &DVector<f64>) -> f64 {
        self.smooth.energy(self.symbols, time, mu.as_slice())
    }

    fn gradient(&self, time: f64, mu: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.smooth.gradient(self.symbols, time, mu.as_slice()))
    }

    fn undefined(&self, time: f64, mu: &DVector<f64>) -> Option<Undefined> {
        let (number, argument) = self.smooth.undefined(self.symbols, time, mu.as_slice())?;
        // The run ends here, and errors hold texts that stay.
        let expression = self.smooth.expressions[number].clone().leak();
        Some(Undefined { expression, argument })
    }
}

/// The group of all runs.
type Group = DirectProduct<MatrixGroup>;

/// Steps of one size at `M` nodes.
struct Collocated<'a, const M: usize> {
    elements: Elements<Group>,
    step: Mutex<Collocation<Group, Interpreted<'a>, M>>,
}

impl<'a, const M: usize> Collocated<'a, M> {
    fn new(group: Group, energy: Interpreted<'a>, size: f64) -> Result<Self, StepError> {
        let elements = Elements { group: group.clone().into(), compiled: None };
        let step = Mutex::new(Collocation::new(group, energy, size)?);
        Ok(Self { elements, step })
    }

    /// One step of another size from this time, which knows no steps before it.
    fn alone(
        step: &Collocation<Group, Interpreted<'a>, M>,
        phase: &mut Phase<Group>,
        time: f64,
        size: f64,
    ) -> Result<(), StepError> {
        let mut step = Collocation::<_, _, M>::new(step.group().clone(), *step.energy(), size)?;
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

    /// There is no series.
    fn ratio(&self, _: &[f64]) -> f64 {
        0.0
    }
}
